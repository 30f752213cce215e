# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Exact touching: clear where that is proved, tagged where a common point is shown, and never
believed of a mesh.
"""

from __future__ import annotations

import copy
from dataclasses import replace

import numpy as np
import pytest
import trimesh

from experiments.truth import check, check_many, label
from ofg import Body, Motion, Pose, Query

# an integer quaternion: the rotation is rational and none of its entries is simple
TURN = (
    4,
    -7,
    4,
    8,
)
CUBE = Body.convex([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], "cube")
LONG = Body.convex(CUBE.vertices * [2, 1, 1] - [1, 0, 0], "long")
PLATE = Body.convex((CUBE.vertices - 0.5) * [10, 1, 10], "plate")
BLOCK = Body.convex(CUBE.vertices - 0.5, "block")


def turned(offset, turn) -> Pose:
    """The pose whose position is the offset carried by the rational rotation, where doubles hold
    it.
    """
    w, x, y, z = turn
    n = np.array(
        [
            [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
        ]
    )
    return n @ np.array(offset)


@pytest.mark.parametrize("other", (CUBE, LONG), ids=("equal", "longer"))
@pytest.mark.parametrize(
    "offset", ([0, 1, 0], [1, 1, 0], [1, 1, 1]), ids=("face", "edge", "corner")
)
@pytest.mark.parametrize("turn", ((1, 0, 0, 0), TURN), ids=("as they are", "turned"))
def test_cubes_that_touch_are_clear_and_tagged(other, offset, turn):
    squared = sum(c * c for c in turn)
    # side |q|^2, so that turned vertices are whole numbers
    unit = Body.convex(CUBE.vertices * squared, "cube")
    first = Body.convex(other.vertices * squared, other.name)
    query = Query("overlap", first, unit, Pose(turn), Pose(turn, turned(offset, turn)))
    truth = label(query)
    assert (truth.label, truth.start, truth.end, truth.touching) == (
        "clear",
        "clear",
        "clear",
        True,
    )
    for doubles in (True, False):
        assert check_many([(query, truth), (query.swapped(), label(query.swapped()))], doubles)[
            0
        ].ok


def test_a_tag_is_refused_without_its_witness_and_a_witness_without_its_tag():
    query = Query("overlap", CUBE, CUBE, Pose(), Pose(position=[1, 0, 0]))
    truth = label(query)
    plain = {key: value for key, value in truth.certificate.items() if key != "touching"}
    assert not check(query, replace(truth, certificate=plain)).ok
    assert not check(query, replace(truth, touching=False)).ok
    assert check(query, replace(truth, touching=False, certificate=plain)).ok
    assert not check(query, replace(truth, label="uncertain", certificate=plain)).ok
    moved = copy.deepcopy(dict(truth.certificate))
    moved["touching"]["a"]["vertices"][0] = (moved["touching"]["a"]["vertices"][0] + 1) % 8
    assert not check(query, replace(truth, certificate=moved)).ok
    apart = Query("overlap", CUBE, CUBE, Pose(), Pose(position=[1 + 2.0**-52, 0, 0]))
    assert label(apart).label == "clear" and not label(apart).touching
    assert not check(apart, replace(truth, gap=0.0)).ok, "the witness of another pose"


def test_touching_without_a_common_point_is_plain_clear():
    """Face planes in common, the faces side by side: the plane has no gap, and nothing is
    shared.
    """
    query = Query("overlap", CUBE, CUBE, Pose(), Pose(position=[1, 3, 0]))
    truth = label(query)
    assert truth.label == "clear" and not truth.touching and truth.gap > 0


def mesh_cube(shift=0):
    """A cube as a mesh; `shift` rolls its vertices, so that another one is the first."""
    box = trimesh.creation.box((2, 2, 2))
    order = np.roll(np.arange(8), shift)
    return Body.mesh(box.vertices[order], np.argsort(order)[box.faces], "mesh cube")


@pytest.mark.parametrize("first", range(8))
def test_two_mesh_cubes_that_overlap_by_half_are_never_clear(first):
    """Their faces are triangles without interior: with >= in place of > planes through coplanar
    faces call them clear.
    """
    query = Query("overlap", mesh_cube(first), mesh_cube(first), Pose(), Pose(position=[1, 0, 0]))
    assert label(query).label == "hit"
    tree = [[[0.0, "W", 1.0, 0.0, 0.0]], None]
    faces = len(query.a.faces)
    # Every triangle of A against every one of B, with the plane that would part them if touching
    # were enough.
    planes = [[_weak_plane(query, i, j) for j in range(faces)] for i in range(faces)]
    if all(p is not None for row in planes for p in row):
        rows = [
            [[], ["b", list(range(1, faces)), [[[[0.0, "W", *p]], None] for p in row]]]
            for row in planes
        ]
        tree = [[], ["a", list(range(1, faces)), rows]]
    forged = replace(
        label(query),
        label="clear",
        start="clear",
        end="clear",
        gap=0.0,
        certificate={"clear": {"tree": tree}},
    )
    assert not check(query, forged).ok


def _weak_plane(query, i, j):
    a, b = (
        query.a.vertices[query.a.faces[i]],
        query.b.vertices[query.b.faces[j]] + query.pose_b.position,
    )
    edges = [x[k] - x[k - 1] for x in (a, b) for k in range(3)]
    normals = [np.cross(u, v) for u in edges for v in edges]
    for n in [*normals, *(-n for n in normals), *np.eye(3), *-np.eye(3)]:
        if n.any() and (a @ n).max() <= (b @ n).min():
            return n.tolist()
    return None


def test_touching_meshes_stay_uncertain():
    truth = label(Query("overlap", mesh_cube(), mesh_cube(), Pose(), Pose(position=[2, 0, 0])))
    assert truth.label == "uncertain" and not truth.touching


def resting(displacement, gap=0.0, motion_b=Motion(), **turn):
    question = "motion" if turn or motion_b.angle else "translation"
    return Query(
        question,
        BLOCK,
        PLATE,
        Pose(position=[0, 1 + gap, 0]),
        Pose(),
        Motion(displacement, **turn),
        motion_b,
    )


@pytest.mark.parametrize(
    "displacement", ([0, 1, 0], [1, 0, 0], [1, 1, 0], [3.7, 0, -2.2], [20, 0, 0])
)
def test_sweeps_that_start_in_touch_and_recede_or_slide_are_clear(displacement):
    for query in (resting(displacement), resting(displacement).swapped()):
        truth = label(query)
        assert (truth.label, truth.start, truth.end, truth.touching) == (
            "clear",
            "clear",
            "clear",
            True,
        )
        assert check_many([(query, truth)], doubles=False)[0].ok


def test_a_sweep_that_starts_in_touch_and_goes_in_hits_at_once():
    truth = label(resting([0, -1, 0]))
    assert (truth.label, truth.start, truth.end, truth.touching) == ("hit", "clear", "hit", False)
    assert truth.t_lo == 0 < truth.t_hi <= 1e-12


def test_a_sweep_that_grazes_in_passing_is_clear_and_tagged():
    """Past an edge, touching it for a part of the step; and edge over edge at one moment."""
    slide = Query("translation", CUBE, CUBE, Pose(position=[-3, 1, 0]), Pose(), Motion([6, 0, 0]))
    truth = label(slide)
    assert (truth.label, truth.touching) == ("clear", True)
    # its lowest edge is at y = -1
    diamond = Body.convex(CUBE.vertices @ [[1, -1, 0], [1, 1, 0], [0, 0, 1]], "diamond")
    over = Query("translation", diamond, CUBE, Pose(position=[-4, 2, 0]), Pose(), Motion([8, 0, 0]))
    truth = label(over)
    assert (truth.label, truth.touching) == ("clear", True)


def test_bodies_that_turn_away_from_touching_are_clear():
    """A cube stands on its edge beside another, and both turn away from the common edge."""
    query = resting([0, 1, 0], axis=[0, 0, 1], angle=0.5)
    truth = label(query)
    assert (truth.label, truth.start, truth.touching) == ("clear", "clear", True)
    both = resting([0, 2, 0], axis=[0, 0, 1], angle=0.5, motion_b=Motion([0, 0, 0], [1, 0, 0], 0.1))
    truth = label(both)
    assert (truth.label, truth.start, truth.touching) == ("clear", "clear", True)


def test_unions_touch_by_their_pieces():
    steps = Body.union([Body.convex(CUBE.vertices + [i, i, 0]) for i in range(3)], "steps")
    query = Query("overlap", steps, steps, Pose(), Pose(position=[1, 0, 0]))
    truth = label(query)
    assert (truth.label, truth.touching) == ("clear", True)
    assert label(replace(query, pose_b=Pose(position=[1 - 2.0**-40, 0, 0]))).label == "hit"


def test_gaps_of_one_unit_of_rounding_are_told_apart():
    for k, expected in ((1, "clear"), (0, "clear"), (-1, "hit")):
        truth = label(
            Query("overlap", CUBE, CUBE, Pose(), Pose(position=[1 + k * 2.0**-52, 0.25, 0.5]))
        )
        assert (truth.label, truth.touching) == (expected, k == 0)
