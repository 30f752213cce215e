# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Verified OFG answers about the solids as they are given, wherever doubles end."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

import ofg
from ofg import Body, BodyError, PairCache, Pose, Query, _core
from ofg.verification import prepare_verified, solid_of

from .conftest import CUBE, rows_of_poses

SMALLEST_STEP = 2.0**-52


def hull_of(rng, n, shape=(1, 1, 1)):
    return Body.convex(rng.normal(size=(n, 3)) * shape, "hull")


def asked(a, b, pa, pb, **options):
    return ofg.verified_many(a, b, pa, pb, **options).hit


def product(p, q):
    (w, x, y, z), (a, b, c, d) = p, q
    return np.array(
        [
            w * a - x * b - y * c - z * d,
            w * b + x * a + y * d - z * c,
            w * c - x * d + y * a + z * b,
            w * d + x * c - y * b + z * a,
        ]
    )


@st.composite
def pairs(draw):
    """Two hulls near one another: round, flat, long, on a grid; poses of whole numbers, so that
    what is done to them exactly is exact.
    """
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    thin = [10.0 ** -draw(st.sampled_from([0, 0, 0, 3, 8])) for _ in range(2)]
    made = []
    for i in range(2):
        v = rng.normal(size=(draw(st.integers(5, 30)), 3)) * [1, 1, thin[i]]
        if draw(st.booleans()):
            v = np.round(v * 4) / 4 if thin[i] == 1 else v
        try:
            made.append(Body.convex(v))
        except BodyError:
            made.append(Body.convex(CUBE / 2))
    q = rng.integers(-3, 4, (2, 4)).astype(float)
    q[np.abs(q).sum(axis=1) == 0] = [1, 0, 0, 0]
    p = rng.integers(-3000, 3000, (2, 3)) / 1024
    return (*made, Pose(q[0], p[0]), Pose(q[1], p[1]))


@settings(max_examples=300, deadline=None)
@given(pairs(), st.integers(-150, 150))
def test_exchanged_carried_and_scaled_by_powers_of_two_nothing_changes(pair, power):
    a, b, pa, pb = pair
    hit = ofg.verified(a, b, pa, pb).hit
    assert ofg.verified(b, a, pb, pa).hit == hit
    scale = 2.0**power
    grown = [Body.convex(x.vertices * scale) for x in (a, b)]
    if all(np.array_equal(g.vertices, x.vertices * scale) for g, x in zip(grown, (a, b))):
        moved = [Pose(p.quaternion, p.position * scale) for p in (pa, pb)]
        assert ofg.verified(*grown, *moved).hit == hit
    # half turns about x, then about z, and quaternions of another length: exact in doubles
    for turn, way in (((0, 1, 0, 0), (1, -1, -1)), ((0, 0, 0, 1), (-1, -1, 1))):
        carried = [
            Pose(
                product(np.array(turn, float), p.quaternion) * 2.0 ** (power / 2 // 1),
                p.position * way + 2.0**20,
            )
            for p in (pa, pb)
        ]
        assert ofg.verified(a, b, *carried).hit == hit


@pytest.mark.parametrize("far", [0.0, 1e6, 2.0**40])
@pytest.mark.parametrize("size", [1e-60, 2.0**-30, 1.0, 1e6, 1e59])
def test_cubes_part_where_they_touch_and_not_a_step_of_a_double_before(far, size):
    """No tolerance on either side of touching, at any size and place."""
    cube = Body.convex(CUBE * size)
    far *= size
    if far > 1e60:
        return
    for axis in range(3):
        for sign in (1.0, -1.0):
            touching = far + sign * 2 * size
            for x in (
                touching,
                np.nextafter(touching, far),
                np.nextafter(touching, np.inf * sign),
                far + sign * size * 1.999,
            ):
                at, origin = np.full(3, far), np.full(3, far)
                at[axis] = x
                hit = abs(Fraction(x) - Fraction(far)) < 2 * Fraction(size)
                assert ofg.verified(cube, cube, Pose(position=at), Pose(position=origin)).hit == hit


def test_a_step_of_a_double_counts_where_a_rotation_is_not_exact():
    """Cubes turned together by a quaternion whose matrix doubles do not hold: in its thirtieths
    their faces lie in whole numbers, so that they touch exactly.
    """
    big, q = Body.convex(CUBE * 30), np.array([1.0, 2.0, 3.0, 4.0])
    thirtieths = np.array([[-20, 4, 22], [20, -10, 20], [10, 28, 4]])
    for column in thirtieths.T:
        for sign in (1.0, -1.0):
            away = sign * 2.0 * column
            assert not ofg.verified(big, big, Pose(q, away), Pose(q)).hit
            nearer, farther = np.nextafter(away, 0), np.nextafter(away, 2 * away)
            assert ofg.verified(big, big, Pose(q, nearer), Pose(q)).hit
            assert not ofg.verified(big, big, Pose(q, farther), Pose(q)).hit


@pytest.mark.parametrize("ratio", [1e-6, 1e-3, 1.0, 1e3, 1e6])
@pytest.mark.parametrize("gap", [1e-2, 1e-9, 1e-13, 1e-15])
def test_a_corner_at_a_face_of_another_size(ratio, gap):
    """An octahedron's corner over the middle of a cube's face, or in it: the numbers are exact."""
    tip = np.vstack([np.eye(3), -np.eye(3)]) * ratio
    cube, octahedron = Body.convex(CUBE), Body.convex(tip)
    for side in (1, -1):
        z = 1 + ratio + side * gap * (1 + ratio)
        over = Fraction(z) - Fraction(ratio) - 1
        assert ofg.verified(octahedron, cube, Pose(position=(0.25, 0.125, z))).hit == (over < 0)


@pytest.mark.parametrize("thickness", [1e-3, 1e-9, 1e-13])
def test_needles_and_plates(thickness):
    plate = Body.convex(CUBE * [1, 1, thickness])
    needle = Body.convex(CUBE * [thickness, thickness, 1])
    turned = Pose((1, 1, 0, 0), (0, 0, 0))  # a quarter turn about x, exactly
    for body in (plate, needle):
        for gap, hit in ((0.5, False), (SMALLEST_STEP, False), (-SMALLEST_STEP, True)):
            # thickness + thickness, less or more a share of itself
            z = 2 * thickness * (1 + gap) if body is plate else 2 * (1 + gap)
            assert ofg.verified(body, body, Pose(position=(0.3 * thickness, 0, z))).hit == hit
    assert ofg.verified(plate, needle).hit and ofg.verified(needle, plate, turned).hit
    assert not ofg.verified(plate, needle, Pose(position=(1.5, 0, 0))).hit


def test_coplanar_and_doubled_vertices_and_grids():
    """Solids whose faces are grids of vertices, on a grid of positions: most of them touch."""
    box = trimesh.creation.box().subdivide().subdivide()
    raw = Body.unchecked("convex", box.vertices, box.faces, (), "gridded")
    doubled = Body.unchecked(
        "convex", np.vstack([box.vertices, box.vertices]), box.faces, (), "doubled"
    )
    plain = Body.convex(CUBE / 2)
    rng = np.random.default_rng(1)
    steps = rng.integers(-5, 6, (300, 3)) / 4
    want = (np.abs(steps) < 1).all(axis=1)
    for one in (raw, doubled, plain):
        for other in (raw, plain):
            pb = np.column_stack([np.tile([2.0, 0, 0, 0], (300, 1)), steps])
            assert np.array_equal(asked(one, other, Pose(), pb), want)


def test_a_body_inside_another_and_at_its_place():
    rng = np.random.default_rng(2)
    ball = Body.from_trimesh(trimesh.creation.icosphere(3))
    for small in (hull_of(rng, 8, 0.05), hull_of(rng, 40, 0.1)):
        for _ in range(50):
            at = Pose(rng.normal(size=4), rng.uniform(-0.3, 0.3, 3))
            assert ofg.verified(ball, small, Pose(), at) and ofg.verified(small, ball, at)
    assert ofg.verified(ball, ball)


def test_flat_bodies_and_open_surfaces_are_refused(cube):
    flat = Body.unchecked("convex", CUBE * [1, 1, 0], cube.faces, (), "flat")
    sheet = Body.unchecked("mesh", CUBE * [1, 1, 0], cube.faces, (), "a flat surface")
    unclosed = Body.unchecked("mesh", CUBE, cube.faces[1:], (), "an open surface")
    for wrong in (flat, sheet, unclosed):
        with pytest.raises(BodyError, match=wrong.name):
            ofg.verified(wrong, cube)
        with pytest.raises(BodyError, match=wrong.name):
            ofg.verified(cube, wrong)
    nearly = Body.unchecked("convex", CUBE * [1, 1, 2.0**-1000], cube.faces, (), "nearly flat")
    assert ofg.verified(nearly, cube).hit  # its interior is small, and there


def test_what_is_of_another_type_is_refused(cube):
    with pytest.raises(TypeError, match="pose_a"):
        ofg.verified(cube, cube, (1, 0, 0))
    with pytest.raises(TypeError, match="cache"):
        ofg.verified(cube, cube, cache={})
    with pytest.raises(TypeError, match="b must be"):
        ofg.verified(cube, "cube")
    with pytest.raises(ValueError, match="threads"):
        ofg.verified_many(cube, cube, Pose(), Pose(), cache=PairCache(), threads=2)
    with pytest.raises(ValueError, match="1e\\+60"):
        ofg.verified(Body.convex(CUBE * 1e61), cube)
    with pytest.raises(ValueError, match="overlap"):
        prepare_verified(Query("translation", cube, cube))


def test_faces_that_do_not_bound_the_hull_are_not_trusted(cube):
    """Inward, open, or nobody's: an inscribed ball by them would be a false alarm."""
    rng = np.random.default_rng(3)
    n = 400
    pa, pb = rows_of_poses(rng, n, 0), rows_of_poses(rng, n, 2.2)
    want = asked(cube, cube, pa, pb)
    assert 50 < want.sum() < 350
    for faces in (cube.faces[:, ::-1], cube.faces[:4], cube.faces[[0] * 12], cube.faces[::-1]):
        odd = Body.unchecked("convex", cube.vertices, faces, (), "odd")
        assert np.array_equal(asked(odd, cube, pa, pb), want)
        assert np.array_equal(asked(odd, odd, pa, pb), want)


@pytest.mark.parametrize("seed", range(4))
def test_a_cache_changes_no_answer(hulls, seed):
    """Poses that go on from one another, poses that do not, and other bodies in between."""
    rng = np.random.default_rng(seed)
    a, b = hulls[rng.integers(20)], hulls[rng.integers(20)]
    ball = Body.from_trimesh(trimesh.creation.icosphere(3))
    cache = PairCache()
    for x, y in ((a, b), (b, a), (a, ball), (ball, ball), (a, b)):
        n = 300
        pa, pb = rows_of_poses(rng, n, 0), rows_of_poses(rng, n, 0)
        for rows in (pa, pb):
            slow = np.cumsum(rng.normal(size=(n, 7)) * 0.03, axis=0)
            rows[:] = np.where(np.arange(n)[:, None] % 40 < 30, rows[0] + slow, rows)
        pb[:, 4:] += (0.5 * (x.radius + y.radius), 0, 0)
        plain = ofg.verified_many(x, y, pa, pb)
        kept = ofg.verified_many(x, y, pa, pb, cache=cache)
        assert np.array_equal(plain.hit, kept.hit)
        one = [
            ofg.verified(x, y, Pose(p[:4], p[4:]), Pose(q[:4], q[4:]), cache).hit
            for p, q in zip(pa[:50], pb[:50])
        ]
        assert np.array_equal(one, plain.hit[:50])


def test_a_cache_saves_work_where_poses_go_on_from_one_another(cube):
    n = 500
    pb = np.tile([1.0, 0.3, 0.2, 0.1, 0, 0.3, 0.4], (n, 1))
    pb[:, 1], pb[:, 4] = np.linspace(0.3, 0.5, n), np.linspace(2.05, 2.95, n)
    kept = ofg.verified_many(cube, cube, Pose(), pb, cache=PairCache())
    plain = [ofg.verified(cube, cube, Pose(), Pose(p[:4], p[4:])) for p in pb]
    assert np.array_equal(kept.hit, [x.hit for x in plain]) and 20 < kept.hit.sum() < n - 20
    assert kept.count("distances").sum() < sum(x.counts["distances"] for x in plain) / 4


def test_instruction_sets_threads_and_the_missing_selection_give_equal_hits(hulls):
    rng = np.random.default_rng(5)
    ball = Body.from_trimesh(trimesh.creation.icosphere(3))
    widest = _core.widest_isa()
    try:
        for a, b in [(hulls[0], hulls[1]), (hulls[4], hulls[17]), (ball, hulls[9]), (ball, ball)]:
            n = 500
            pa, pb = rows_of_poses(rng, n, 0), rows_of_poses(rng, n, 0)
            way = rng.normal(size=(n, 3))
            way *= (
                (a.radius + b.radius) * rng.uniform(0.3, 1.05, n) / np.linalg.norm(way, axis=1)
            )[:, None]
            pb[:, 4:] = way
            hits = []
            for isa in range(widest + 1):
                assert _core.set_isa(isa)
                hits.append(asked(a, b, pa, pb))
                hits.append(_core.verified_many(*map(solid_of, (a, b)), pa, pb, None, False, 1)[0])
            hits.append(asked(a, b, pa, pb, threads=3))
            assert all(np.array_equal(h, hits[0]) for h in hits) and 0 < hits[0].sum() < n
    finally:
        _core.set_isa(widest)


def test_what_an_answer_says(cube):
    over = ofg.verified(cube, cube, Pose((1, 0.2, 0.3, 0.1), (2.05, 0.4, 0.3)))
    deep = ofg.verified(cube, cube, Pose(position=(1.5, 0, 0)))
    far = ofg.verified(cube, cube, Pose(position=(9, 0, 0)))
    exact = ofg.verified(cube, cube, Pose(position=(2, 0, 0)))
    assert over.hit and over.found == "start" and min(over.faces) >= 0
    normals = cube.to_trimesh().face_normals
    assert normals[over.faces[1]] @ (1, 0, 0) > 0.9  # B's face in front of A
    assert deep.found == "inside" and deep.faces == (-1, -1) and deep.pieces == (0, 0)
    assert not far and far.counts["spheres"] == 1 and far.counts["distances"] == 0
    assert not exact and exact.counts["steps"] == 2 and over.counts["steps"] == 1
    assert all(np.isnan(x.time) and x.estimate == "none" for x in (over, deep, far, exact))


def test_unions_are_asked_piece_by_piece(cube):
    arm = Body.convex(CUBE * [3, 0.5, 0.5] + [0, -3, 0])
    el = Body.union([cube, arm])
    for at, hit, pieces in (
        ((0, 0, 0), True, (0, 0)),
        ((0, -3, 0), True, (1, 0)),
        ((3, 0, 0), False, None),
        ((0, 2, 0), False, None),
        ((3.99, -3, 0), True, (1, 0)),
    ):
        answer = ofg.verified(el, cube, Pose(), Pose(position=at))
        assert answer.hit == hit and ofg.verified(cube, el, Pose(position=at)).hit == hit
        assert pieces is None or answer.pieces == pieces


def test_prepare_asks_again_and_again(cube):
    for selection in (True, False):
        ask = prepare_verified(
            Query("overlap", cube, cube, Pose(), Pose(position=(1.9, 1, 1))), selection=selection
        )
        assert ask()[0] is True and ask()[0] is True
        query = Query("overlap", cube, cube, Pose(), Pose(position=(2.1, 1, 1)))
        assert prepare_verified(query, selection=selection)()[0] is False
        assert prepare_verified(replace(query, pose_b=Pose()), selection=selection)()[0] is True
