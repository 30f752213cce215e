# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""What an answer says that it found: the moment, and the faces where bodies cross."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import ofg
from ofg import Body, Motion, Pose
from tests.ofg.conftest import CUBE, rows_of_motions, rows_of_poses

CODES = ("nothing", "start", "end", "edge-face", "face-edge", "edge-edge", "inside", "within")


def test_codes_are_stable():
    assert ofg.FOUND == CODES


@pytest.mark.parametrize("repairs", ["arcs", "arcs+earliest", "all-but-edge-edge", "all"])
def test_end_is_the_end_of_the_step(hulls, repairs):
    """Faces that met at the end of a part that arcs cut the step into were said to meet at the end
    of the step."""
    rng = np.random.default_rng(4)
    seen = set()
    for a, b in zip(hulls, hulls[5:]):
        pa, pb = rows_of_poses(rng, 60, 3), rows_of_poses(rng, 60, 0)
        m = rows_of_motions(rng, 60, 4, 4)
        got = ofg.sweep_many(a, b, pa, pb, m, repairs=repairs, arc_tolerance=1e-2)
        for i in np.flatnonzero(got.hit):
            found, time = ofg.FOUND[got.found[i]], got.time[i]
            seen.add(found)
            if found == "end":
                assert time == 1 or np.isnan(time)
                end = Motion(*np.split(m[i, :6], 2), m[i, 6]).pose_at(
                    Pose(*np.split(pa[i], [4])), 1
                )
                assert ofg.discrete(a, b, end, Pose(*np.split(pb[i], [4])), k=10**6)
            if found == "within":
                assert 0 < time < 1 or np.isnan(time)
    assert "within" in seen or "all" in repairs


def test_a_moment_within_the_step_where_no_chord_meets():
    """Two crossed bars: their edges meet. Without that repair only the faces at the end of a part
    of the step do."""
    x, y = Body.convex(CUBE * (5, 0.3, 0.3), "x"), Body.convex(CUBE * (0.3, 5, 0.3), "y")
    turned = Pose((np.cos(np.pi / 8), np.sin(np.pi / 8), 0, 0), (0, 0, 2))
    motion = Motion((0, 0, -4), (1, 0, 0), 0.2)
    options = dict(repairs="arcs+earliest", arc_tolerance=1e-4, k=12)
    answer = ofg.rotational_sweep(x, y, motion, turned, **options)
    assert answer.found == "within" and 0.2 < answer.time < 0.6 and min(answer.faces) >= 0
    assert answer.estimate == "none"


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32 - 1), st.sampled_from(["containment", "adaptive-k+containment", "all"]))
def test_bodies_that_cross_name_the_faces_that_meet(hulls, seed, repairs):
    """With containment, crossing bodies were "inside" and their faces -1."""
    rng = np.random.default_rng(seed)
    a, b = (hulls[i] for i in rng.integers(0, 20, 2))
    pa, pb = rows_of_poses(rng, 20, 0), rows_of_poses(rng, 20, 0.6)
    crossing = ofg.brute_force_many(a, b, pa, pb).hit
    for k in (1, 8, 10**6):
        got = ofg.discrete_many(a, b, pa, pb, k=k, repairs=repairs)
        solid = ofg.discrete_many(a, b, pa, pb, k=10**6, containment=True)
        named = (got.faces >= 0).all(axis=1)
        assert np.array_equal(named, got.found == CODES.index("start"))
        assert not (named & ~crossing).any()
        assert np.array_equal(solid.found == CODES.index("inside"), solid.hit & ~crossing)
        if k == 10**6:
            assert np.array_equal(named, crossing)
        if (
            repairs != "containment"
        ):  # all faces that can meet were asked, where nothing else says "hit"
            assert np.array_equal(got.hit, solid.hit)
        assert got.hit[solid.found == CODES.index("inside")].all()


def test_sweeps_name_them_too(cube):
    small = Body.convex(CUBE * 0.2, "small")
    still, push = Pose(), (0.01, 0, 0)
    for repairs in ("containment", "all"):
        crossing = ofg.translational_sweep(
            cube, cube, push, Pose(position=(0.3, 0.2, 0.1)), repairs=repairs, k=12
        )
        assert crossing.found == "start" and min(crossing.faces) >= 0 and crossing.time == 0
        inside = ofg.translational_sweep(small, cube, push, still, repairs=repairs, k=12)
        assert inside.found == "inside" and inside.faces == (-1, -1) and inside.time == 0


def test_a_hit_is_one_whatever_is_asked_first(hulls):
    """Surfaces, then containment: a hit where either says so."""
    rng = np.random.default_rng(8)
    for a, b in zip(hulls, hulls[4:]):
        pa, pb = rows_of_poses(rng, 100, 0), rows_of_poses(rng, 100, 0.7)
        faces = ofg.discrete_many(a, b, pa, pb, k=4).hit
        both = ofg.discrete_many(a, b, pa, pb, k=4, containment=True)
        inside = both.found == CODES.index("inside")
        assert np.array_equal(both.hit, faces | inside) and not (faces & inside).any()
