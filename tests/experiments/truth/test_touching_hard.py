# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Bodies that touch and that no rounded search parts: thin, unlike in size, far away."""

from __future__ import annotations

import numpy as np
import pytest

from experiments.truth import check, label
from ofg import Body, Motion, Pose, Query

CORNERS = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
CUBE = Body.convex(CORNERS, "cube")
NEEDLE = Body.convex(CORNERS * [2.0**-20, 2.0**-20, 1], "needle")
SLIVER = Body.convex(CORNERS * [2.0**20, 2.0**20, 1], "sliver")
FAR = Body.convex(CORNERS + [2.0**30, -(2.0**29), 0], "far")
TINY = Body.convex(CORNERS * 2.0**-40, "tiny")
TURN = Pose((1, 2, 2, 4))  # |q|^2 = 25


def touching(a: Body, b: Body, displacement=(0, 0, 0), motion_b=(0, 0, 0)) -> Query:
    """The highest corner of B turned, set into the lowest face of A from below."""
    matrix = np.rint(TURN.rotation * 25)
    turned = Body.convex(b.vertices * 25, b.name)
    placed = turned.vertices @ matrix.T / 25
    top = placed[np.argmax(placed[:, 2])]
    low = a.vertices[:4].min(axis=0) * [0.5, 0.5, 1] + a.vertices.max(axis=0) * [0.5, 0.5, 0]
    question = "translation" if np.any(displacement) or np.any(motion_b) else "overlap"
    motions = Motion(np.add(displacement, motion_b)), Motion(motion_b)
    return Query(question, a, turned, Pose(), Pose(TURN.quaternion, low - top), *motions)


@pytest.mark.parametrize("a", (CUBE, NEEDLE, SLIVER, FAR, TINY), ids=lambda body: body.name)
@pytest.mark.parametrize("b", (CUBE, NEEDLE, TINY), ids=lambda body: body.name)
@pytest.mark.parametrize("way", ((0, 0, 0), (2.0**30, 2.0**20, 0), (1, 0, 2.0**20)))
def test_a_corner_on_a_face_is_clear_and_tagged(a, b, way):
    query = touching(a, b, way)
    for asked in (query, query.swapped()):
        truth = label(asked)
        assert (truth.label, truth.touching, truth.reason) == ("clear", True, "")
        assert check(asked, truth).ok


def test_bodies_that_touch_and_move_alike_stay_in_touch():
    truth = label(touching(CUBE, CUBE, motion_b=(3, 1, 4)))
    assert (truth.label, truth.touching, truth.reason) == ("clear", True, "")


def test_bodies_a_hair_apart_that_move_in_at_once_are_a_hit_from_a_clear_start():
    """Apart by 1e-20 of their size: no time passes before they meet, and the start is clear."""
    bar = Body.convex(CORNERS * [104, 104, 425984.0], "bar")
    points = [(-400, 500, -400), (200, 600, -400), (500, 300, 0), (-500, 0, -300)]
    points += [(200, -200, -500), (-600, 600, 400), (200, -300, -200), (-600, -600, 300)]
    rock = Body.convex(points, "rock")
    poses = Pose((-1, 3, -4, 0), (2.0**-66, 0, 0)), Pose((-2, 4, 1, -2), (-396, -108, 456))
    query = Query("translation", bar, rock, *poses, Motion((20, 49, -5)), Motion((16, 42, -26)))
    truth = label(query)
    assert (truth.label, truth.start, truth.t_lo) == ("hit", "clear", 0)
    assert truth.t_hi < 1e-12 and check(query, truth).ok


def corner(base, *sides) -> np.ndarray:
    """A point and those that are reached from it along each axis."""
    return np.array([base, *(np.add(base, s) for s in np.diag(sides))], float)


TURNING = {  # (A, its turn, its motion), (B, its turn), all at the origin and in exact touch
    "a corner on a face": (
        (corner((0, 0, 0), 336, 192, 240), (1, -1, 0, 0)),
        (CORNERS * [48, 336, 336] + [116, -56, 88], (-1, 0, -2, -1)),
        Motion(axis=(0.371, 0.342, -1.244), angle=0.108),
    ),
    "while it recedes": (
        (CORNERS * [8320, 1040, 5200], (2, -1, -2, 2)),
        (corner((-6816, -240, -832), 6240, 6240, 6240), (0, -1, 0, -2)),
        Motion((-6941, -1095, -19438), (0.454, 0.916, -0.568), 0.307, (8320, 1040, 0)),
    ),
    "about an edge": (
        (CORNERS * [234, 156, 624], (-1, -2, -2, -2)),
        (corner((652, 208, -224), 78, 312, 234), (-1, 2, 1, 0)),
        Motion((-89, 60, 78), (-0.096, -1.103, -2.26), 0.385, (0, 0, 624)),
    ),
}


@pytest.mark.parametrize("case", TURNING)
def test_bodies_that_touch_and_turn_away_are_clear_from_both_sides(case):
    """Their labels were uncertain from one side: rounding decided which plane was tried."""
    (a, turn_a), (b, turn_b), motion = TURNING[case]
    poses = Pose(turn_a), Pose(turn_b)
    query = Query("motion", Body.convex(a, "a"), Body.convex(b, "b"), *poses, motion)
    for asked in (query, query.swapped()):
        truth = label(asked)
        assert (truth.label, truth.touching, truth.reason) == ("clear", True, "")
        assert check(asked, truth).ok
