# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Labels: proved, checked, and unchanged by what must not change them."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

from experiments.truth import check, label
from ofg import Body, Motion, Pose, Query

from .draw import composite_query, convex_query, moved_together, reversed_in_time, scaled

QUESTIONS = ("overlap", "translation", "motion")
CUBE = Body.from_trimesh(trimesh.creation.box((2, 2, 2)), "cube")


def cubes(question, offset, motion=Motion()):
    return Query(question, CUBE, CUBE, Pose(), Pose(position=offset), motion)


@pytest.mark.parametrize("question", QUESTIONS)
def test_every_random_convex_query_is_settled_and_its_certificate_verifies(question):
    rng = np.random.default_rng(1)
    labels = []
    for _ in range(60):
        query = convex_query(rng, question)
        truth = label(query)
        assert truth.label != "uncertain", truth.reason
        assert check(query, truth).ok
        labels.append(truth.label)
        if truth.label == "hit" and question != "overlap":
            assert truth.t_hi - truth.t_lo <= 1e-12 * truth.t_hi
    assert {"hit", "clear"} == set(labels)


@pytest.mark.parametrize("question", QUESTIONS)
def test_common_motion_and_scaling_change_no_verdict(question):
    rng = np.random.default_rng(2)
    for i in range(25):
        query = convex_query(rng, question)
        truth = label(query)
        for other, f in (
            (moved_together(query, i % 3), 1.0),
            (scaled(query, 20), 2.0**20),
            (scaled(query, -30), 2.0**-30),
        ):
            again = label(other)
            assert (again.label, again.start, again.end) == (truth.label, truth.start, truth.end)
            if truth.label == "hit" and question != "overlap":
                assert again.t_lo <= truth.t_hi and truth.t_lo <= again.t_hi
            if truth.label == "clear" and question != "motion":
                assert np.isclose(again.gap, truth.gap * f, rtol=1e-6)


@pytest.mark.parametrize("question", QUESTIONS)
def test_swapping_the_bodies_changes_no_verdict(question):
    rng = np.random.default_rng(3)
    for _ in range(40):
        query = convex_query(rng, question)
        one, two = label(query), label(query.swapped())
        assert (one.label, one.start, one.end) == (two.label, two.start, two.end)
        if one.label == "hit" and question != "overlap":
            assert one.t_lo <= two.t_hi and two.t_lo <= one.t_hi


@pytest.mark.parametrize("question", ("translation", "motion"))
@pytest.mark.parametrize("draw", (convex_query, composite_query))
def test_running_backwards_exchanges_start_and_end(question, draw):
    rng = np.random.default_rng(6)
    for _ in range(15):
        query = draw(rng, question)
        one, two = label(query), label(reversed_in_time(query))
        assert (one.label, one.start, one.end) == (two.label, two.end, two.start)
        if one.label == "clear":
            assert np.isclose(one.gap, two.gap, rtol=0.1)


def test_cubes_face_to_face():
    assert label(cubes("overlap", [0, 0, 0])).label == "hit"
    assert label(cubes("overlap", [2 + 2.0**-48, 0, 0])).label == "clear"
    assert label(cubes("overlap", [2 - 2.0**-48, 0, 0])).label == "hit"
    touching = label(cubes("overlap", [2, 0, 0]))
    assert (touching.label, touching.touching, touching.gap) == ("clear", True, 0)
    sweep = label(cubes("translation", [3, 0, 0], Motion([8, 0, 0])))
    assert (sweep.label, sweep.start, sweep.end) == ("hit", "clear", "clear")
    assert sweep.t_lo <= 0.125 <= sweep.t_hi <= 0.125 * (1 + 1e-12)


def test_the_gap_of_a_clear_pair_is_a_bound_close_to_the_distance():
    truth = label(cubes("translation", [4, 3, 0], Motion([4, 0, 0])))
    assert truth.label == "clear" and 1 - 1e-6 < truth.gap <= 1
    turning = label(cubes("motion", [4, 0, 0], Motion([0, 0, 0], [0, 0, 1], 6.25)))
    assert turning.label == "clear" and 0.95 * (3 - 2**0.5) < turning.gap <= 3 - 2**0.5 + 1e-9


@pytest.mark.parametrize("question", QUESTIONS)
def test_unions_and_meshes_are_settled(question):
    rng = np.random.default_rng(4)
    kinds, labels = set(), set()
    for _ in range(40):
        query = composite_query(rng, question)
        truth = label(query)
        assert truth.label != "uncertain", truth.reason
        kinds.add((query.a.kind, query.b.kind))
        labels.add(truth.label)
    assert len(kinds) > 6 and labels == {"hit", "clear"}


def test_the_time_of_a_translation_is_an_exact_rational():
    from fractions import Fraction

    wall = Body.convex(CUBE.vertices * [0.25, 4, 4])
    query = Query(
        "translation", CUBE, wall, Pose(), Pose([1, 0, 0, 0], [3, 0.25, 0.5]), Motion([7, 0, 0])
    )
    assert Fraction(label(query).certificate["exact"]["time"]) == Fraction(7, 28)
    rng = np.random.default_rng(14)
    hits = [
        t
        for t in (label(convex_query(rng, "translation")) for _ in range(60))
        if t.label == "hit" and t.start == "clear"
    ]
    times = [Fraction(t.certificate["exact"]["time"]) for t in hits if "exact" in t.certificate]
    assert len(times) == len(hits) > 20
    assert all(t.t_lo <= time <= t.t_hi for t, time in zip(hits, times))
