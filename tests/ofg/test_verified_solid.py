# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Verified OFG of closed surfaces and unions: answers that follow from one another, and known
ones.
"""

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

import ofg
from ofg import Body, Pose, Query, _core
from ofg.verification import prepare_verified

from .conftest import CUBE, rows_of_poses
from .test_verified import asked, product


def bumpy(rng, subdivisions):
    m = trimesh.creation.icosphere(subdivisions=subdivisions)
    waves = np.sin(3 * m.vertices @ rng.normal(size=(3, 4)) + rng.uniform(0, 6, 4)).sum(axis=1)
    return Body.mesh(m.vertices * (1 + 0.08 * waves)[:, None], m.faces, "bumpy")


def ring(sections=12, sides=6):
    m = trimesh.creation.torus(1, 0.25, sections, sides)
    return Body.mesh(m.vertices, m.faces, "ring")


def shell(outer=1.0, inner=0.8):
    """A cube with a cubical cavity."""
    cube = trimesh.creation.box(extents=(2, 2, 2))
    v = np.vstack([cube.vertices * outer, cube.vertices * inner])
    return Body.mesh(v, np.vstack([cube.faces, cube.faces[:, ::-1] + 8]), "shell")


def as_mesh(body):
    return Body.mesh(body.vertices, body.faces, body.name)


def near_poses(rng, n, reach):
    pa, pb = rows_of_poses(rng, n, 0), rows_of_poses(rng, n, 0)
    way = rng.normal(size=(n, 3))
    pb[:, 4:] = way / np.linalg.norm(way, axis=1)[:, None] * rng.uniform(0, reach, (n, 1))
    return pa, pb


@st.composite
def pairs(draw):
    """Two bodies of any kind near one another; poses of whole numbers, so that what is done to
    them exactly is exact.
    """
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    kinds = (
        lambda: bumpy(rng, 1),
        ring,
        shell,
        lambda: Body.convex(rng.normal(size=(12, 3))),
        lambda: Body.union([Body.convex(rng.normal(size=(8, 3)) + at) for at in np.eye(3)]),
    )
    a, b = (kinds[draw(st.integers(0, len(kinds) - 1))]() for _ in range(2))
    q = rng.integers(-3, 4, (2, 4)).astype(float)
    q[np.abs(q).sum(axis=1) == 0] = [1, 0, 0, 0]
    p = rng.integers(-1500, 1500, (2, 3)) / 1024
    return a, b, Pose(q[0], p[0]), Pose(q[1], p[1])


def scaled(body, scale):
    pieces = tuple(scaled(p, scale) for p in body.pieces) if body.kind == "union" else ()
    return Body.unchecked(body.kind, body.vertices * scale, body.faces, pieces, body.name)


@settings(max_examples=150, deadline=None)
@given(pairs(), st.integers(-100, 100))
def test_exchanged_carried_and_scaled_by_powers_of_two_nothing_changes(pair, power):
    a, b, pa, pb = pair
    hit = ofg.verified(a, b, pa, pb).hit
    assert ofg.verified(b, a, pb, pa).hit == hit
    scale = 2.0**power
    moved = [Pose(p.quaternion, p.position * scale) for p in (pa, pb)]
    assert ofg.verified(scaled(a, scale), scaled(b, scale), *moved).hit == hit
    turn, way = np.array([0.0, 1, 0, 0]), np.array([1, -1, -1])  # half a turn about x is exact
    carried = [
        Pose(product(turn, p.quaternion) * 2.0 ** (power // 2), p.position * way + 2.0**20)
        for p in (pa, pb)
    ]
    assert ofg.verified(a, b, *carried).hit == hit


def test_a_convex_surface_answers_as_its_hull():
    rng = np.random.default_rng(1)
    for faces in (8, 20, 60):
        a, b = (Body.convex(rng.normal(size=(faces, 3))) for _ in range(2))
        pa, pb = near_poses(rng, 300, a.radius + b.radius)
        want = asked(a, b, pa, pb)
        assert 30 < want.sum() < 290
        for one, other in ((as_mesh(a), as_mesh(b)), (as_mesh(a), b), (a, as_mesh(b))):
            assert np.array_equal(asked(one, other, pa, pb), want)


def test_a_union_answers_as_its_pieces_and_as_the_surfaces_of_them():
    rng = np.random.default_rng(2)
    made = [
        Body.union([Body.convex(rng.normal(size=(9, 3)) * 0.4 + 2 * p) for p in rng.random((n, 3))])
        for n in (2, 9, 40)
    ]
    for a in made:
        for b in made:
            pa, pb = near_poses(rng, 60, a.radius + b.radius)
            want = np.any([asked(p, q, pa, pb) for p in a.pieces for q in b.pieces], axis=0)
            assert np.array_equal(asked(a, b, pa, pb), want)
            assert np.array_equal(asked(as_mesh(a), b, pa, pb), want)
            assert np.array_equal(asked(as_mesh(a), as_mesh(b), pa, pb), want)


@pytest.mark.parametrize("faces", [80, 1280])
def test_instruction_sets_and_threads_give_equal_hits(faces):
    rng = np.random.default_rng(faces)
    a, b = (bumpy(rng, {80: 1, 1280: 3}[faces]) for _ in range(2))
    pa, pb = near_poses(rng, 200, 2.6)
    widest = _core.widest_isa()
    try:
        hits = [asked(a, b, pa, pb, threads=2)]
        for isa in range(widest + 1):
            assert _core.set_isa(isa)
            hits.append(asked(a, b, pa, pb))
    finally:
        _core.set_isa(widest)
    assert all(np.array_equal(h, hits[0]) for h in hits) and 20 < hits[0].sum() < 190


def test_a_body_at_its_own_place_and_against_itself_moved_by_a_step():
    """Surfaces that coincide, and nearly: every face lies on another."""
    rng = np.random.default_rng(3)
    for body in (bumpy(rng, 1), bumpy(rng, 2), ring(), shell(), as_mesh(Body.convex(CUBE))):
        for q in ((1, 0, 0, 0), (1, 2, 3, 4)):
            at = Pose(q, (0.3, 0.1, 0.7))
            step = Pose(q, np.nextafter(at.position, 9))
            assert ofg.verified(body, body, at, at) and ofg.verified(body, body, at, step)


def test_what_is_inside_and_what_is_in_a_cavity():
    small, ball = Body.convex(CUBE * 0.1), bumpy(np.random.default_rng(4), 3)
    for inner in (small, as_mesh(small), Body.union([small, small])):
        for at, hit in (((0, 0, 0), False), ((0.5, -0.5, 0.2), False), ((0.9, 0, 0), True)):
            for one, other in ((inner, shell()), (shell(), inner)):
                pa, pb = (Pose(position=at if x is inner else (0, 0, 0)) for x in (one, other))
                assert ofg.verified(one, other, pa, pb).hit == hit
        answer = ofg.verified(ball, inner, Pose(), Pose((1, 2, 3, 4), (0.1, 0.2, 0)))
        assert answer.hit
    inside = ofg.verified(ball, as_mesh(small))
    assert inside.found == "inside" and inside.faces == (-1, -1)
    assert ofg.verified(shell(), shell(0.99, 0.9)).hit
    assert not ofg.verified(shell(), shell(0.7, 0.6)).hit


def test_linked_rings_are_apart_until_they_cross():
    quarter = (1, 1, 0, 0)
    assert not ofg.verified(ring(), ring(), Pose(), Pose(quarter, (1, 0, 0)))
    assert ofg.verified(ring(), ring(), Pose(), Pose(quarter, (0.2, 0, 0)))
    crossed = ofg.verified(ring(), ring(), Pose(), Pose((1, 0.1, 0, 0), (0.4, 0, 0)))
    assert crossed.found == "start" and min(crossed.faces) >= 0 and crossed.pieces == (-1, -1)


def test_two_cubes_as_surfaces_on_a_coarse_grid():
    """Overlap is a hit and a gap none, wherever faces, edges and vertices lie on one another."""
    box = as_mesh(Body.convex(CUBE))
    fine = trimesh.creation.box(extents=(2, 2, 2)).subdivide()
    gridded = Body.mesh(fine.vertices, fine.faces)
    steps = np.stack(np.meshgrid(*[np.arange(-5, 6) / 2] * 3), axis=-1).reshape(-1, 3)
    pb = np.column_stack([np.tile([1.0, 0, 0, 0], (len(steps), 1)), steps])
    size = np.abs(steps).max(axis=1)
    for a, b in ((box, box), (box, gridded), (gridded, gridded)):
        hit = asked(a, b, Pose(), pb)
        assert hit[size < 2].all() and not hit[size > 2].any()
    for a, b in ((box, Body.convex(CUBE)), (Body.convex(CUBE), gridded)):
        assert np.array_equal(asked(a, b, Pose(), pb), size < 2)  # there touching is clear


def test_faces_without_area_change_nothing():
    """A vertex on an edge, with a face of three points in line between the two sides of it."""
    v = np.vstack([CUBE, (CUBE[0] + CUBE[1]) / 2])
    cube = Body.convex(CUBE)
    faces = [f for f in cube.faces.tolist() if not {0, 1} <= set(f)]
    (p, q, r), (other_q, other_p, s) = (
        np.roll(f, -next(k for k in range(3) if {f[k], f[(k + 1) % 3]} == {0, 1}))
        for f in cube.faces.tolist()
        if {0, 1} <= set(f)
    )
    assert (p, q) == (other_p, other_q)
    faces += [[p, 8, r], [8, q, r], [q, p, s], [p, q, 8]]
    odd = Body.unchecked("mesh", v, np.array(faces), (), "odd")
    rng = np.random.default_rng(5)
    pa, pb = near_poses(rng, 200, 3)
    assert np.array_equal(asked(odd, odd, pa, pb), asked(cube, cube, pa, pb))


def test_prepare_takes_surfaces():
    ask = prepare_verified(Query("overlap", ring(), shell(), Pose(), Pose(position=(9, 0, 0))))
    assert ask()[0] is False
    assert prepare_verified(Query("overlap", ring(), shell()))()[0] is True
