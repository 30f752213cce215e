# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Verified sweeps: known times, what changes no answer, and what touches."""

import math

import numpy as np
import pytest

import ofg
from ofg import Body, BodyError, Impact, Motion, Pose, Query
from ofg.verified_motion import prepare_verified_sweep

from .conftest import CUBE, rows_of_motions, rows_of_poses

BRACKET = 1e-9
TINY_STEP = 2.0**-52


def holds(impact, time):
    return impact.hit and impact.proved and impact.time <= time <= impact.latest


def drawn(rng, hulls, n=40, angle=4.0, both=True):
    """Pairs of hulls and rows of poses and motions of which about half collide."""
    a, b = hulls[rng.integers(20)], hulls[rng.integers(20)]
    pa, pb = rows_of_poses(rng, n, 0), rows_of_poses(rng, n, 2.5)
    ma, mb = rows_of_motions(rng, n, 3, angle), rows_of_motions(rng, n, 1, angle * both)
    for rows in (ma, mb):
        rows[:, 6] *= rng.integers(0, 2, n)
    return a, b, pa, pb, ma, mb


def agree(x, y):
    """The same hits, and times that can be those of one contact."""
    assert np.array_equal(x.hit, y.hit)
    both = x.hit & x.proved & y.proved
    assert (x.time[both] <= y.latest[both]).all() and (y.time[both] <= x.latest[both]).all()


def test_known_times(cube):
    """Cubes face to face; a turning cube's edge at a wall; a rod that sweeps round to a ball."""
    there = Pose(position=(5, 0.3, 0.2))
    x = ofg.verified_sweep(cube, cube, there, Pose(), Motion((-6, 0, 0)))
    assert holds(x, 0.5) and x.latest - x.time <= BRACKET
    # the corner edge reaches sqrt(2) sin(pi / 4 + turned)
    wall = Body.convex(CUBE * [1, 50, 50])
    x = ofg.verified_sweep(
        cube, wall, Pose(position=(-2.25, 0, 0)), Pose(), Motion(axis=(0, 0, 1), angle=1.5)
    )
    turned = math.asin(1.25 / math.sqrt(2)) - math.pi / 4
    assert holds(x, turned / 1.5)
    rod = Body.convex(CUBE * [10, 1e-3, 1e-3])
    box = Body.convex(CUBE * [0.5, 0.5, 0.5])
    x = ofg.verified_sweep(
        rod, box, Pose(), Pose(position=(0, 5, 0)), Motion(axis=(0, 0, 1), angle=20 * math.pi)
    )
    # the rod's side meets the corner (0.5, 4.5): the corner's angle, less what the side is ahead
    far = math.hypot(0.5, 4.5)
    met = math.atan2(4.5, 0.5) - math.asin(1e-3 / far)
    assert holds(x, met / (20 * math.pi))


def test_both_turn_about_points_of_theirs(cube):
    """Two cubes on arms that swing towards each other like doors, and meet half way."""
    arm = Motion(axis=(0, 0, 1), angle=math.pi / 2, about=(-10, 0, 0))
    other = Motion(axis=(0, 0, 1), angle=-math.pi / 2, about=(-10, 0, 0))
    x = ofg.verified_sweep(cube, cube, Pose(), Pose(position=(0, 13, 0)), arm, other)
    # the corner (11, 1) comes to y = 6.5
    met = math.asin(6.5 / math.hypot(11, 1)) - math.atan2(1, 11)
    assert holds(x, met / (math.pi / 2))


@pytest.mark.parametrize("seed", range(6))
def test_exchanged_carried_and_scaled_by_powers_of_two_nothing_changes(hulls, seed):
    rng = np.random.default_rng(seed)
    a, b, pa, pb, ma, mb = drawn(rng, hulls, angle=0 if seed == 0 else 4)
    x = ofg.verified_sweep_many(a, b, pa, pb, ma, mb)
    assert 0 < x.hit.sum() < len(x) and x.proved.all()
    agree(x, ofg.verified_sweep_many(b, a, pb, pa, mb, ma))
    # one displacement more for both
    along = np.zeros((len(ma), 7))
    along[:, :3] = (3.0, -5.0, 7.0)
    agree(x, ofg.verified_sweep_many(a, b, pa, pb, ma + along, mb + along))
    for power in (-40, 40):
        scale = 2.0**power
        grown = [Body.convex(body.vertices * scale) for body in (a, b)]
        rows = [np.array(each) for each in (pa, pb, ma, mb)]
        rows[0][:, 4:] *= scale
        rows[1][:, 4:] *= scale
        rows[2][:, :3] *= scale
        rows[3][:, :3] *= scale
        if all(np.array_equal(g.vertices, o.vertices * scale) for g, o in zip(grown, (a, b))):
            y = ofg.verified_sweep_many(*grown, *rows)
            assert np.array_equal(x.hit, y.hit)
            assert np.array_equal(x.time, y.time, equal_nan=True)


@pytest.mark.parametrize("seed", range(3))
def test_backwards_in_time_the_same_sweeps_meet(hulls, seed):
    rng = np.random.default_rng(seed)
    a, b, pa, pb, ma, mb = drawn(rng, hulls)
    there, back = [], []
    for rows, moves in ((pa, ma), (pb, mb)):
        poses = [Pose(p[:4], p[4:]) for p in rows]
        motions = [Motion(m[:3], m[3:6], m[6]) for m in moves]
        there.append([m.pose_at(p, 1) for m, p in zip(motions, poses)])
        back.append([Motion(-m.displacement, m.axis, -m.angle) for m in motions])
    x = ofg.verified_sweep_many(a, b, pa, pb, ma, mb)
    y = ofg.verified_sweep_many(a, b, *there, *back)
    assert np.array_equal(x.hit, y.hit)


def test_two_motions_that_are_one_leave_the_bodies_as_they_are(cube):
    """Carried along by the same motion about the same point, nothing meets, and nothing is lost
    far from the origin.
    """
    for far in (0.0, 1e5):
        at = np.full(3, far)
        spin = Motion((1, 2, 3), (0.3, 0.2, 1), 9.0, (0, 0, 0))
        around = Motion((1, 2, 3), (0.3, 0.2, 1), 9.0, (-3, 0, 0))
        x = ofg.verified_sweep(
            cube, cube, Pose(position=at), Pose(position=at + (3, 0, 0)), spin, around
        )
        assert not x.hit and x.proved


@pytest.mark.parametrize("angle", [0.0, 1e-3, 0.3])
def test_bodies_that_touch_and_part_are_clear(cube, angle):
    motion = Motion((1, 0, 0), (0, 0, 1), angle)
    for turned in (Pose(position=(2, 0, 0)), Pose(position=(2, 2, 0)), Pose(position=(2, 2, 2))):
        x = ofg.verified_sweep(cube, cube, turned, Pose(), motion)
        assert not x.hit and x.proved
        y = ofg.verified_sweep(cube, cube, Pose(), turned, Motion(), motion)
        assert not y.hit and y.proved


def test_a_touch_on_the_way_is_none_and_a_step_of_a_double_is_one(cube):
    """Translations that graze a face, an edge and a corner exactly, and by the least more."""
    for z, hit in ((2.0, False), (2.0 - TINY_STEP, True), (2.0 + TINY_STEP, False)):
        for y in (0.0, 1.5):
            x = ofg.verified_sweep(
                cube, cube, Pose(position=(-8, y, z)), Pose(), Motion((16, 0, 0))
            )
            assert x.hit == hit and x.proved
            assert not hit or holds(x, 6 / 16)
    start = ofg.verified_sweep(cube, cube, Pose(position=(2, 0, 0)), Pose(), Motion((0, 1, 0)))
    assert not start.hit and start.proved  # slides along


@pytest.mark.parametrize("gap", [1e-3, 1e-9, 1e-12, 0.0])
def test_contact_at_the_end_of_the_step(cube, gap):
    for sign in (1, -1):
        way = 2 + sign * gap
        x = ofg.verified_sweep(cube, cube, Pose(position=(4, 0.5, 0)), Pose(), Motion((-way, 0, 0)))
        assert x.hit == (way > 2) and x.proved


def test_overlap_at_the_start_has_time_0(cube):
    for motion in (Motion(), Motion((9, 0, 0)), Motion((9, 0, 0), (1, 0, 0), 5)):
        for depth in (1.0, 1e-6, TINY_STEP):
            x = ofg.verified_sweep(cube, cube, Pose(position=(2 - depth, 0, 0)), Pose(), motion)
            assert (x.hit, x.time, x.latest, x.found, x.proved) == (True, 0, 0, "start", True)


def test_what_rounding_hides_is_a_hit_that_says_so(cube):
    """A cube that spins on another's face touches it all the time."""
    spin = Motion(axis=(0, 0, 1), angle=3)
    x = ofg.verified_sweep(cube, cube, Pose(position=(0, 0, 2)), Pose(), spin)
    assert x.hit and not x.proved and x.time == 0 and math.isnan(x.latest)


def test_a_hit_that_is_approached_slowly_is_flagged_and_holds_its_time(cube):
    slow = Motion((-2e-7, 0, 0), (1, 0, 0), 1e-7)
    x = ofg.verified_sweep(cube, cube, Pose(position=(2 + 1e-7, 0.3, 0.2)), Pose(), slow)
    assert x.hit and x.time <= 0.5 <= x.latest < 0.5 + 1e-4


def test_many_turns(cube):
    """What cannot be settled at a bounded cost is a hit that says so."""
    for turns in (1, 100, 100_000):
        spin = Motion(axis=(0.2, 0.1, 1), angle=2 * math.pi * turns)
        x = ofg.verified_sweep(cube, cube, Pose(position=(3, 0, 0)), Pose(), spin)
        y = ofg.verified_sweep(cube, cube, Pose(position=(2.3, 0, 0)), Pose(), spin)
        assert x.counts["steps"] < 5000
        assert not x.hit or (turns > 100 and not x.proved)
        assert y.hit and y.proved and y.time < 1 / turns


def test_unions_meet_by_their_first_pieces(cube):
    beam = Body.convex(CUBE * [0.2, 4, 0.2])
    cross = Body.union([cube, beam])
    for motion, time, pieces in (
        (Motion((-10, 0, 0)), 0.3, (0, 0)),
        (Motion((-10, 0, 0), (1, 0, 0), 1e-6), 0.3, (0, 0)),
    ):
        x = ofg.verified_sweep(cross, cross, Pose(position=(5, 0, 0)), Pose(), motion)
        assert holds(x, time) and x.pieces == pieces
    over = Pose(position=(5, 5.5, 0))
    x = ofg.verified_sweep(cross, cross, over, Pose(), Motion((-10, 0, 0)))
    assert holds(x, 0.46) and x.pieces == (1, 1)
    y = ofg.verified_sweep(cross, cross, Pose(), over, Motion((10, 0, 0)))
    assert holds(y, 0.46) and y.pieces == (1, 1)


def test_what_meets_is_named(cube):
    tip = Body.convex(np.vstack([np.eye(3), -np.eye(3)]))
    x = ofg.verified_sweep(tip, cube, Pose(position=(4, 0.3, 0.2)), Pose(), Motion((-4, 0, 0)))
    assert x.found == "edge-face"
    normals = cube.to_trimesh().face_normals
    assert normals[x.faces[1]] @ (1, 0, 0) > 0.9
    x = ofg.verified_sweep(cube, tip, Pose(position=(4, 0.3, 0.2)), Pose(), Motion((-4, 0, 0)))
    assert x.found == "face-edge"


def test_one_by_one_in_threads_and_prepared_answers_are_equal(hulls):
    rng = np.random.default_rng(3)
    a, b, pa, pb, ma, mb = drawn(rng, hulls, 30)
    many = ofg.verified_sweep_many(a, b, pa, pb, ma, mb)
    threaded = ofg.verified_sweep_many(a, b, pa, pb, ma, mb, threads=2)
    for i in range(30):
        poses = [Pose(p[i, :4], p[i, 4:]) for p in (pa, pb)]
        motions = [Motion(m[i, :3], m[i, 3:6], m[i, 6]) for m in (ma, mb)]
        one = ofg.verified_sweep(a, b, *poses, *motions)
        assert isinstance(one, Impact)
        assert repr(one) == repr(many[i]) == repr(threaded[i])
        ask = prepare_verified_sweep(Query("motion", a, b, *poses, *motions))
        for _ in range(2):
            hit, time = ask()
            assert hit == one.hit and (time == one.time or math.isnan(time))


def test_what_is_of_another_type_is_refused(cube):
    mesh = Body.mesh(cube.vertices, cube.faces, "a mesh")
    with pytest.raises(TypeError, match="motion_a"):
        ofg.verified_sweep(cube, cube, Pose(), Pose(), (1, 0, 0))
    with pytest.raises(TypeError, match="pose_b"):
        ofg.verified_sweep(cube, cube, Pose(), None, Motion())
    with pytest.raises(BodyError, match="a mesh"):
        ofg.verified_sweep(cube, mesh, Pose(), Pose(), Motion())
    with pytest.raises(ValueError, match="threads"):
        ofg.verified_sweep_many(cube, cube, Pose(), Pose(), Motion(), threads=0)
    with pytest.raises(ValueError, match="prepare_verified"):
        prepare_verified_sweep(Query("overlap", cube, cube))
