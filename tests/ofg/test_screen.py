# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""A screen settles "no" by a plane between the whole bodies: it may change what an answer costs,
and nothing else.
"""

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

import ofg
from ofg import Body, Motion, Pose, _core

from .conftest import CUBE, rows_of_motions, rows_of_poses

SAME = ("hit", "time", "found", "faces", "pieces")
# of the radius: a point's number rides in the last four bits of its product, in single precision
UNIT_OF_CHOICE = 2.0**-18


def assert_same(got, want):
    for field in SAME:
        assert np.array_equal(
            getattr(got, field), getattr(want, field), equal_nan=field == "time"
        ), field


def lumpy(rng, n):
    return Body.convex(rng.normal(size=(n, 3)) * rng.uniform(0.2, 2, 3), "lumpy")


@pytest.fixture(scope="module")
def shapes(hulls):
    """From 12 to 1,280 faces; a box whose sides are grids of coplanar vertices; a needle; a
    dumbbell, asked undivided.
    """
    rng = np.random.default_rng(1)
    box = trimesh.creation.box().subdivide().subdivide().subdivide()
    dumbbell = trimesh.util.concatenate(
        [trimesh.creation.icosphere(2).apply_translation([x, 0, 0]) for x in (-1.5, 1.5)]
    )
    return [
        Body.convex(CUBE, "cube"),
        Body.from_trimesh(trimesh.creation.icosphere(3), "ball"),
        Body.convex(box.vertices, "box"),
        Body.mesh(box.vertices, box.faces, "gridded box"),
        Body.convex(rng.normal(size=(60, 3)) * [10, 0.05, 0.05], "needle"),
        Body.mesh(dumbbell.vertices, dumbbell.faces, "dumbbell"),
        lumpy(rng, 40),
        lumpy(rng, 400),
        hulls[3],
    ]


@pytest.mark.parametrize("precision", ["double", "float"])
@pytest.mark.parametrize(
    "options",
    [{}, {"k": 3}, {"concave": "all-pairs"}, {"k": 10**6}, {"containment": True}],
    ids=str,
)
def test_a_screen_changes_no_answer(shapes, options, precision):
    rng = np.random.default_rng(2)
    options = {"precision": precision, "concave": "undivided", **options}
    settled = 0
    for a in shapes:
        for b in shapes[::3]:
            n = 20 if options.get("k") == 10**6 else 130
            pa, pb = rows_of_poses(rng, n, 0), rows_of_poses(rng, n, 0.7 * (a.radius + b.radius))
            want = ofg.discrete_many(a, b, pa, pb, **options)
            got = ofg.discrete_many(a, b, pa, pb, screen=True, **options)
            assert_same(got, want)
            settled += (got.count("distances") < want.count("distances")).sum()
            for i in range(0, n, 13):
                one = ofg.discrete(
                    a,
                    b,
                    Pose(pa[i, :4], pa[i, 4:]),
                    Pose(pb[i, :4], pb[i, 4:]),
                    screen=True,
                    **options,
                )
                assert one.hit == want.hit[i]
            m = rows_of_motions(rng, 20, 3 * a.radius, 0)
            assert_same(
                ofg.sweep_many(a, b, pa[:20], pb[:20], m, screen=True, **options),
                ofg.sweep_many(a, b, pa[:20], pb[:20], m, **options),
            )
    assert settled > 100  # it does what it is for


@pytest.mark.parametrize(
    "gap", [1e-1, 1e-4, 1e-6, 1e-9, 1e-13, 0.0, -1e-13, -1e-9, -1e-6, -1e-4, -1e-2]
)
def test_a_screen_changes_no_answer_near_touching(gap):
    """Faces, edges and corners of cubes that nearly touch, turned together at random and far from
    the origin.
    """
    cube = Body.convex(CUBE, "cube")
    rng = np.random.default_rng(3)
    pa, pb = rows_of_poses(rng, 200, 3.0), rows_of_poses(rng, 200, 0)
    pb[:, :4] = pa[:, :4]
    turn = np.array([Pose(p[:4]).rotation for p in pa])
    offsets = (
        rng.choice([-1.0, 1.0], (200, 3))
        * np.c_[np.full(200, 2 + gap), rng.choice([0, 0.5, 2 - 1e-7], (200, 2))]
    )
    pb[:, 4:] = pa[:, 4:] + np.einsum("nij,nj->ni", turn, offsets)
    for options in ({"k": 12}, {"k": 12, "containment": True}):
        assert_same(
            ofg.discrete_many(cube, cube, pa, pb, screen=True, **options),
            ofg.discrete_many(cube, cube, pa, pb, **options),
        )


@pytest.mark.parametrize("size", [1e-9, 1e9])
def test_bodies_of_very_different_size(size):
    rng = np.random.default_rng(4)
    ball = trimesh.creation.icosphere(2)
    a, b = Body.convex(ball.vertices * size, "other"), Body.from_trimesh(ball, "ball")
    pa, pb = rows_of_poses(rng, 200, 0), rows_of_poses(rng, 200, 0)
    direction = rng.normal(size=(200, 3))
    direction /= np.linalg.norm(direction, axis=1)[:, None]
    pb[:, 4:] = direction * (1 + size) * rng.uniform(0.9, 1.1, (200, 1))
    assert_same(ofg.discrete_many(a, b, pa, pb, screen=True), ofg.discrete_many(a, b, pa, pb))


def solid(body):
    return _core.Solid(body.vertices, body.faces.astype(np.int32), False, [], [])


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32 - 1), st.sampled_from([4, 9, 16, 17, 40, 300, 3000]), st.booleans())
def test_the_table_holds_the_support_function(seed, n, on_a_grid):
    """Along any axis no vertex lies farther than the one looked up: random ones, those along edges
    of cells, and between.
    """
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(n, 3)) * rng.uniform(0.01, 2, 3)
    if on_a_grid:
        points = np.round(points * 2) / 2
    points = np.unique(points, axis=0)
    if len(points) < 4 or np.linalg.matrix_rank(points - points[0], tol=1e-6) < 3:
        return
    body = Body.convex(points)
    axes = np.vstack(
        [rng.normal(size=(200, 3)), rng.integers(-4, 5, (200, 3)) / 4, np.eye(3), -np.eye(3)]
    )
    axes = axes[np.abs(axes).sum(axis=1) > 0]
    found = _core.least_points(solid(body), np.ascontiguousarray(axes))
    centre = body.vertices.mean(axis=0)
    unit = (body.vertices - centre) / np.linalg.norm(body.vertices - centre, axis=1).max()
    axes32 = axes.astype(np.float32).astype(float)
    excess = (found * axes32).sum(axis=1) - (axes32 @ unit.T).min(axis=1)
    assert (excess <= UNIT_OF_CHOICE * np.linalg.norm(axes32, axis=1)).all()
    # they are vertices
    assert np.abs(found[:, None, :] - unit[None]).max(axis=2).min(axis=1).max() < 1e-6


def test_axes_that_are_none_harm_nothing():
    ball = Body.from_trimesh(trimesh.creation.icosphere(3), "ball")
    odd = np.array([[0.0, 0, 0], [np.nan, 0, 1], [np.inf, 1, 0], [1e-45, 0, 0]])
    assert _core.least_points(solid(ball), odd).shape == (4, 3)


def test_a_screen_agrees_over_instruction_sets(shapes):
    rng = np.random.default_rng(5)
    widest = _core.widest_isa()
    try:
        for a, b in [(shapes[0], shapes[7]), (shapes[1], shapes[4]), (shapes[2], shapes[2])]:
            pa, pb = (
                rows_of_poses(rng, 300, 0),
                rows_of_poses(rng, 300, 0.7 * (a.radius + b.radius)),
            )
            answers = []
            for isa in range(widest + 1):
                assert _core.set_isa(isa)
                answers.append(ofg.discrete_many(a, b, pa, pb, screen=True))
            for other in answers[1:]:
                assert_same(other, answers[0])
                assert np.array_equal(other.counts, answers[0].counts)
    finally:
        _core.set_isa(widest)


def test_a_motion_that_turns_is_not_screened():
    """A plane between the start and the end says nothing about an arc: half a turn about the origin
    brings A through B.
    """
    bar = Body.convex(CUBE * [3, 0.1, 0.1] + [3, 0, 0], "bar")
    post = Body.convex(CUBE * 0.2 + [0, 3, 0], "post")
    for screen in (False, True):
        answer = ofg.rotational_sweep(
            bar, post, Motion(axis=(0, 0, 1), angle=np.pi), k=12, repairs="all", screen=screen
        )
        assert answer.hit
