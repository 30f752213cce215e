# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""OFG and brute force as methods of the harness."""

import math

import pytest

from baselines import brute_force as brute_force_file
from baselines import ofg as ofg_file
from ofg import Motion, Pose, Query


def ask(method, query):
    return method.prepare(query)()


def test_all_questions_are_answered(cube):
    apart, near = Pose(position=(-5, 0.1, 0.2)), Pose(position=(-1.5, 0.1, 0.2))
    for method in (
        ofg_file.METHODS[0](),
        ofg_file.METHODS[0](repairs="all"),
        brute_force_file.METHODS[0](),
    ):
        assert (
            ask(method, Query("overlap", cube, cube, near)).hit
            and not ask(method, Query("overlap", cube, cube, apart)).hit
        )
        sweep = ask(method, Query("translation", cube, cube, apart, motion=Motion((10, 0, 0))))
        assert sweep.hit and sweep.time == pytest.approx(0.3, abs=1e-12)
        turning = ask(
            method, Query("motion", cube, cube, apart, motion=Motion((10, 0, 0), angle=1.0))
        )
        assert turning.hit and 0 < turning.time < 0.3


def test_parameters_reach_the_core(cube):
    small = type(cube).convex(cube.vertices * 0.1)
    inside = Query("overlap", small, cube)
    method = ofg_file.METHODS[0]
    assert method().label.startswith("ofg k=8") and next(iter(method.parameters)) == "k"
    assert not ask(method(k="inf"), inside).hit and ask(method(repairs="containment"), inside).hit
    fast = Query(
        "translation", cube, cube, Pose(position=(-5, 0.1, 0.2)), motion=Motion((10, 0, 0))
    )
    assert (
        not ask(method(broad="start"), fast).hit
        and not ask(method(repairs="all-but-swept-spheres"), fast).hit
    )
    # what is given by name overrules the repairs
    assert ask(method(repairs="all", broad="start"), fast).hit is False
    assert math.isnan(ask(method(toi="none"), fast).time)


def test_what_a_method_declares_follows_its_parameters():
    method = ofg_file.METHODS[0]
    assert [
        (m.solid, m.configuration)
        for m in (
            method(),
            method(k=64, concave="all-pairs"),
            method(repairs="all"),
            method(adaptive_k=True),
        )
    ] == [(False, "article"), (False, "article"), (True, "best effort"), (False, "alternative")]


def test_a_prepared_query_may_be_asked_again(cube):
    query = Query(
        "translation", cube, cube, Pose(position=(-5, 0.1, 0.2)), motion=Motion((10, 0, 0))
    )
    prepared = ofg_file.METHODS[0]().prepare(query)
    assert prepared() == prepared()
