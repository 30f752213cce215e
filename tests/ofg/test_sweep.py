# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Sweeps: known head-on times by both estimates, the flaws of the article's method, and that its
repairs mend them.
"""

import numpy as np
import pytest

import ofg
from ofg import Body, Motion, Pose
from tests.ofg.conftest import CUBE, rows_of_motions, rows_of_poses

LEFT = Pose(position=(-5, 0.1, 0.2))


@pytest.mark.parametrize("toi, error", [("velocity", 1e-15), ("bisection", 2.0**-20)])
def test_head_on_time(cube, toi, error):
    """Two cubes of side 2 at a distance of 5 along x meet after 3 of the 10 travelled."""
    answer = ofg.translational_sweep(cube, cube, (10, 0, 0), LEFT, toi=toi)
    assert answer and answer.found == "edge-face" and answer.estimate == toi
    assert abs(answer.time - 0.3) <= error


@pytest.mark.parametrize("toi", ["velocity", "bisection"])
def test_time_on_the_real_motion_of_a_turning_body(toi):
    """A rod of half-length 2 turns by 90 degrees towards a wall at y = 1: its tip, at 2 sin(angle),
    is there at 30 degrees.
    """
    rod = Body.convex(
        np.array([[-1, 0, 0], [0, -0.05, -0.05], [0, -0.05, 0.05], [2, 0, 0]], float), "rod"
    )
    wall = Body.convex(CUBE * (5, 0.5, 5), "wall")
    answer = ofg.rotational_sweep(
        rod,
        wall,
        Motion(axis=(0, 0, 1), angle=np.pi / 2),
        pose_b=Pose(position=(0, 1.5, 0)),
        toi=toi,
        order="steps",
    )
    assert answer and abs(answer.time - 1 / 3) <= {"velocity": 1e-12, "bisection": 2.0**-20}[toi]


def test_no_estimate_where_the_start_or_the_end_hits(cube):
    inside = ofg.translational_sweep(cube, cube, (0.01, 0, 0), Pose(position=(-1.5, 0.1, 0.2)))
    assert inside and inside.found == "start" and inside.time == 0 and inside.estimate == "none"


def test_the_start_reading_of_step_1_rejects_a_fast_mover(cube):
    assert not ofg.translational_sweep(cube, cube, (10, 0, 0), LEFT, broad="start")
    assert ofg.translational_sweep(cube, cube, (10, 0, 0), LEFT, broad="swept")


def test_only_relative_motion_counts(hulls):
    """B moving one way is A moving the other way. Displacements are dyadic, so the relative
    displacement is exact.
    """
    rng = np.random.default_rng(1)
    pa, pb = rows_of_poses(rng, 200, 3), rows_of_poses(rng, 200, 0)
    motions = rows_of_motions(rng, 200, 6, 0)
    motions[:, :3] = np.round(motions[:, :3] * 64) / 64
    half, back = motions.copy(), motions.copy()
    half[:, :3] /= 2
    back[:, :3] /= -2
    for a, b in zip(hulls[:6], hulls[1:]):
        want, got = ofg.sweep_many(a, b, pa, pb, motions), ofg.sweep_many(a, b, pa, pb, half, back)
        assert np.array_equal(got.hit, want.hit) and np.array_equal(
            got.time, want.time, equal_nan=True
        )


def test_b_may_turn_too(cube):
    """Turning B about its own centre by an angle is, seen from B, turning A about B's centre by the
    opposite angle.
    """
    pose, spin = Pose(position=(2.2, 0, 0)), Motion(axis=(0, 0, 1), angle=1.0)
    one = ofg.rotational_sweep(cube, cube, Motion(), pose_a=pose, motion_b=spin, repairs="all")
    other = ofg.rotational_sweep(cube, cube, spin, pose_b=pose, repairs="all")
    assert one and other and one.time == pytest.approx(other.time, abs=1e-9)


def test_operations_are_as_the_article_claims(hulls):
    """At most 3k virtual edges, each against k faces, then k^2 pairs of faces at the start and as
    many at the end.
    """
    rng = np.random.default_rng(4)
    for k in (1, 4, 8):
        for a, b in zip(hulls, hulls[1:]):
            r = ofg.sweep_many(
                a,
                b,
                rows_of_poses(rng, 50, 2),
                rows_of_poses(rng, 50, 0),
                rows_of_motions(rng, 50, 4, 1),
                k=k,
            )
            assert (r.count("edge_faces") <= 3 * k * k).all() and (
                r.count("face_pairs") <= 2 * k * k
            ).all()
            assert (
                set(r.count("distances")) <= {0, len(a.faces) + len(b.faces)}
                and (r.count("spheres") == 1).all()
            )


def test_the_article_misses_edge_against_edge():
    """Two crossed bars: no vertex of either passes a face of the other."""
    long_x, long_y = Body.convex(CUBE * (5, 0.1, 0.1)), Body.convex(CUBE * (0.1, 5, 0.1))
    turned = Pose((np.cos(np.pi / 8), np.sin(np.pi / 8), 0, 0), (0, 0, 2))
    move = (0, 0, -4)
    assert not ofg.translational_sweep(long_x, long_y, move, turned, k=12)
    answer = ofg.translational_sweep(long_x, long_y, move, turned, k=12, edge_edge=True)
    assert answer and answer.found == "edge-edge"
    reach = 0.1 + 0.1 * np.sqrt(2)
    assert answer.time == pytest.approx((2 - reach) / 4, abs=1e-12)


def test_the_article_misses_vertices_of_b(cube):
    """A broad plate falls on a spike: the vertex that meets the plate is B's."""
    plate = Body.convex(CUBE * (9, 9, 0.1))
    spike = Body.convex(
        np.array([[0, 0, 0], [0.1, 0, -1], [-0.1, 0.1, -1], [-0.1, -0.1, -1]], float)
    )
    start, move = Pose(position=(0.5, 0.25, 3)), (0, 0, -8)
    assert not ofg.translational_sweep(plate, spike, move, start, k=12)
    answer = ofg.translational_sweep(
        plate, spike, move, start, k=12, both_vertices=True, earliest=True
    )
    assert (
        answer and answer.found == "face-edge" and answer.time == pytest.approx(2.9 / 8, abs=1e-12)
    )


def test_a_full_turn_needs_arcs(cube):
    """Start and end pose are the same, so every chord is a point."""
    blade = Body.convex(CUBE * (3, 0.1, 0.1))
    turn = Motion(axis=(0, 0, 1), angle=2 * np.pi)
    pose = Pose(position=(0, 3, 0.02))
    assert not ofg.rotational_sweep(blade, cube, turn, pose_b=pose, k=12, repairs="all-but-arcs")
    answer = ofg.rotational_sweep(blade, cube, turn, pose_b=pose, k=12, repairs="all")
    edge, tip = np.deg2rad(90) - answer.time * 2 * np.pi, np.hypot(3, 0.1)
    assert answer and 0 < edge < np.pi / 2 and tip > 2


def test_with_all_repairs_sweeps_find_all_that_brute_force_finds_at_any_time(hulls):
    """The truth here is dense sampling of the motion by all pairs of faces: whatever it finds, the
    repaired sweep must find, and no later.
    """
    rng = np.random.default_rng(7)
    hits = 0
    for a, b in zip(hulls[:5], hulls[7:]):
        pa, pb, m = (
            rows_of_poses(rng, 40, 2.5),
            rows_of_poses(rng, 40, 0),
            rows_of_motions(rng, 40, 5, 3),
        )
        got = ofg.sweep_many(a, b, pa, pb, m, repairs="all", arc_tolerance=1e-5)
        times = np.linspace(0, 1, 201)
        for i in range(40):
            motion = Motion(m[i, :3], m[i, 3:6], m[i, 6])
            start = Pose(pa[i, :4], pa[i, 4:])
            sampled = ofg.discrete_many(
                a,
                b,
                [motion.pose_at(start, t) for t in times],
                Pose(pb[i, :4], pb[i, 4:]),
                k=10**6,
                containment=True,
            )
            if sampled.hit.any():
                hits += 1
                assert got.hit[i] and got.time[i] <= times[np.argmax(sampled.hit)] + 1e-9
    assert hits > 20


@pytest.mark.parametrize("precision", ["double", "float"])
@pytest.mark.parametrize("tip", [1e-11, 1e-19])
def test_a_face_too_small_to_be_seen_stops_nothing(precision, tip):
    """Seen from a vertex such a face is a point: all three products are 0, which was taken for
    inside, anywhere in its plane.
    """
    turns = np.exp(2j * np.pi * np.arange(3) / 3)
    ring = np.stack([np.zeros(3), turns.real, turns.imag], axis=1)
    v = np.concatenate([0.5 * ring + [0.5, 0, 0], tip * ring + [-0.433, 0, 0]])
    sides = [
        f
        for i in range(3)
        for f in ((i, (i + 1) % 3, 3 + i), ((i + 1) % 3, 3 + (i + 1) % 3, 3 + i))
    ]
    spike = Body.mesh(v, np.array([(0, 2, 1), (3, 4, 5), *sides])[:, ::-1], "spike")
    small = Body.convex(CUBE * 0.05, "cube")
    start = Pose(position=(-0.5, 0.4, 0.1))
    for order in ("ends", "steps"):
        assert not ofg.translational_sweep(
            small, spike, (0.2, 0, 0), start, k=99, order=order, precision=precision
        )
        assert not ofg.article(
            ofg.Query("translation", small, spike, start, motion=Motion((0.2, 0, 0))),
            k=99,
            broad="swept",
            precision=precision,
        )
