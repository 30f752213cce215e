# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Discrete OFG: invariances first, then what the article claims about its operations, then known
pairs.
"""

import numpy as np
import pytest
import trimesh

import ofg
from ofg import Body, Pose
from tests.ofg.conftest import CUBE, rows_of_poses

ALL = 10**6


def test_swapping_the_bodies_changes_nothing_at_full_k(hulls):
    rng = np.random.default_rng(1)
    for a, b in zip(hulls, hulls[1:]):
        pa, pb = rows_of_poses(rng, 100, 0), rows_of_poses(rng, 100, 1)
        assert np.array_equal(
            ofg.discrete_many(a, b, pa, pb, k=ALL).hit, ofg.discrete_many(b, a, pb, pa, k=ALL).hit
        )


@pytest.mark.parametrize("k", [4, ALL])
def test_moving_both_bodies_together_changes_nothing(hulls, k):
    """By half turns about an axis and shifts by powers of two, which are exact in floating point,
    so equality is exact.
    """
    rng = np.random.default_rng(2)
    grid = 2.0**-10
    shift = np.array([64.0, -32.0, 128.0])
    for a, b in zip(hulls[:8], hulls[1:]):
        pa, pb = rows_of_poses(rng, 100, 0), rows_of_poses(rng, 100, 1)
        pb[:, 4:] = np.round(pb[:, 4:] / grid) * grid
        want = ofg.discrete_many(a, b, pa, pb, k=k)
        moved = [
            np.column_stack([-p[:, 3], -p[:, 2], p[:, 1], p[:, 0], p[:, 4:] * [-1, -1, 1] + shift])
            for p in (pa, pb)
        ]
        got = ofg.discrete_many(a, b, *moved, k=k)
        assert np.array_equal(got.hit, want.hit) and np.array_equal(got.counts, want.counts)


@pytest.mark.parametrize("scale", [2.0**-30, 2.0**20])
def test_scaling_by_a_power_of_two_changes_nothing(hulls, scale):
    rng = np.random.default_rng(3)
    for a, b in zip(hulls[:8], hulls[1:]):
        sa, sb = (Body.mesh(x.vertices * scale, x.faces) for x in (a, b))
        a, b = (Body.mesh(x.vertices, x.faces) for x in (a, b))  # the same faces in the same order
        pa, pb = rows_of_poses(rng, 100, 0), rows_of_poses(rng, 100, 1)
        want = ofg.discrete_many(a, b, pa, pb, concave="undivided")
        got = ofg.discrete_many(
            sa,
            sb,
            pa * np.r_[1, 1, 1, 1, [scale] * 3],
            pb * np.r_[1, 1, 1, 1, [scale] * 3],
            concave="undivided",
        )
        assert (
            np.array_equal(got.hit, want.hit)
            and np.array_equal(got.faces, want.faces)
            and np.array_equal(got.counts, want.counts)
        )


def test_operations_are_as_the_article_claims(hulls):
    """Steps 2 and 4 look at every face once, n + m; step 8 at no more than k^2 pairs; two spheres
    are compared at most.
    """
    rng = np.random.default_rng(4)
    for k in (1, 4, 8):
        for a, b in zip(hulls, hulls[1:]):
            r = ofg.discrete_many(a, b, rows_of_poses(rng, 50, 0), rows_of_poses(rng, 50, 1.5), k=k)
            n, m = len(a.faces), len(b.faces)
            assert (r.count("spheres") <= 2).all()
            assert set(r.count("distances")) <= {0, n + m}
            assert (r.count("distances") == np.where(r.count("spheres") == 2, n + m, 0)).all()
            assert (r.count("face_pairs") <= k * k).all() and (
                r.count("full_tests") <= r.count("face_pairs")
            ).all()


def test_threads_and_repetition_change_nothing(hulls):
    rng = np.random.default_rng(5)
    pa, pb = rows_of_poses(rng, 501, 0), rows_of_poses(rng, 501, 1)
    want = ofg.discrete_many(hulls[3], hulls[9], pa, pb)
    for threads in (2, 5, None):
        got = ofg.discrete_many(hulls[3], hulls[9], pa, pb, threads=threads)
        for field in ("hit", "found", "faces", "pieces", "counts"):
            assert np.array_equal(getattr(got, field), getattr(want, field))


def test_the_faces_that_met_do_meet(cube):
    answer = ofg.discrete(cube, cube, pose_b=Pose(position=(1.5, 0.25, 0.125)))
    assert answer and answer.found == "start" and answer.pieces == (0, 0)
    a, b = (cube.vertices[cube.faces[f]] for f in answer.faces)
    assert ofg._core.triangles_meet(np.concatenate([a, b + (1.5, 0.25, 0.125)]).reshape(1, 18))[0]


@pytest.mark.parametrize("gap, hit", [(1e-12, False), (1e-3, False), (-1e-12, True), (-1e-3, True)])
def test_cubes_at_a_gap(cube, gap, hit):
    assert ofg.discrete(cube, cube, pose_b=Pose(position=(2 + gap, 0.3, 0.2)), k=12).hit is hit


def test_a_body_inside_another_is_seen_by_containment_alone(cube):
    small = Body.convex(CUBE * 0.25)
    assert not ofg.discrete(small, cube, k=12)
    answer = ofg.discrete(small, cube, containment=True)
    assert answer and answer.found == "inside" and answer.faces == (-1, -1)
    assert ofg.discrete(cube, small, containment=True)


def test_the_article_misses_deep_hulls(ball):
    """The opposing patches pass through each other: the selections, nearest to the other's centre,
    do not meet although the balls do.
    """
    deep = Pose(position=(0.2, 0.01, 0.02))
    assert not ofg.discrete(ball, ball, pose_b=deep, k=4)
    assert ofg.discrete(ball, ball, pose_b=deep, k=320) and ofg.discrete(
        ball, ball, pose_b=deep, k=4, containment=True
    )


def test_float_agrees_away_from_contact(hulls):
    rng = np.random.default_rng(6)
    pa, pb = rows_of_poses(rng, 500, 0), rows_of_poses(rng, 500, 1)
    for a, b in zip(hulls[:6], hulls[1:]):
        fine, coarse = (
            ofg.discrete_many(a, b, pa, pb, k=ALL, precision=p).hit for p in ("double", "float")
        )
        assert (fine != coarse).sum() <= 1


def test_far_from_the_origin_nothing_is_lost(cube):
    for far in (1e3, 1e9):
        a, b = Pose(position=(far, far, far)), Pose(position=(far + 2.5, far, far))
        assert not ofg.discrete(cube, cube, a, b) and ofg.discrete(
            cube, cube, a, Pose(position=(far + 1.5, far, far))
        )


@pytest.mark.parametrize("repairs", ["none", "all"])
def test_numbers_that_overflow_crash_nothing(ball, cube, repairs):
    """The fuzzer found an empty selection, and with it reads past the faces, where distances are
    NaN. The binding refuses such numbers; the fuzzer of the core asks it about them without one.
    """
    options = ofg.options.core_options(repairs=repairs)
    for far in (1e160, 1e300):
        here = np.array([[1, 0, 0, 0, far, -far, far]])
        motion = np.array([[far, far, 0, 0, 0, 1, 0, 0, 0, 0]])
        for a, b in ((ball, cube), (cube, ball)):
            for there in (here, np.array([[1.0, 0, 0, 0, 0, 0, 0]])):
                for moving in (False, True):
                    bodies = [ofg.algorithm.solid(x) for x in (a, b)]
                    with pytest.raises(ValueError, match="out of range"):
                        ofg._core.ask_many(
                            *bodies,
                            here,
                            there,
                            motion,
                            motion * 0 + 1,
                            options,
                            0,
                            moving,
                            False,
                            1,
                        )


def test_a_face_with_a_doubled_corner_is_still_selected():
    """Its distance was 0/0 by the region of the doubled corner, which dropped every face of such a
    mesh from the selection.
    """
    cube = Body.convex(CUBE)
    vertices = np.concatenate([CUBE[cube.faces[0]][:1], CUBE])
    a = ofg._core.Solid(vertices, np.array([[0, cube.faces[0][0] + 1, 7]], np.int32), True, [], [])
    b = ofg.algorithm.solid(cube)
    options = ofg.options.core_options(
        nearest="point-triangle", concave="undivided", adaptive_k=True
    )
    here, rest = np.array([[1.0, 0, 0, 0, 0, 0, 0]]), np.zeros((1, 10))
    hit, *_ = ofg._core.ask_many(a, b, here, here, rest, rest, options, 0, False, False, 1)
    assert hit[0]


def with_slivers(rng, mesh):
    """Each edge gets a vertex on it, off by rounding, and the gap to the face across is closed by a
    face of next to no area.
    """
    vertices, faces, seen = list(mesh.vertices), [], set()
    for a, b, c in mesh.faces:
        edge = frozenset((a, b))
        if edge in seen:
            faces.append((a, b, c))
            continue
        seen.add(edge)
        share, middle = rng.uniform(0.2, 0.8), len(vertices)
        vertices.append(
            vertices[a] * (1 - share) + vertices[b] * share + rng.normal(size=3) * 1e-16
        )
        faces += [(a, middle, c), (middle, b, c), (a, b, middle)]
    return Body.mesh(np.array(vertices), np.array(faces), "slivers")


def test_the_plane_of_a_sliver_is_no_wall():
    """Once the plane of a face was taken for a wall if the other body was in front of it. A
    sliver's normal is rounding, so bodies deep in each other were "apart"; now the points on both
    sides of it are tried.
    """
    rng = np.random.default_rng(1)
    ball = trimesh.creation.icosphere(1)
    for _ in range(5):
        a, b = (
            with_slivers(rng, ball.copy().apply_scale(rng.uniform(0.3, 1, 3))) for _ in range(2)
        )
        pa, pb = rows_of_poses(rng, 200, 0), rows_of_poses(rng, 200, 1.2)
        want = ofg.brute_force_many(a, b, pa, pb).hit
        assert want.sum() > 20
        assert np.array_equal(ofg.discrete_many(a, b, pa, pb, k=ALL, concave="undivided").hit, want)
