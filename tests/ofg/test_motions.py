# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Two bodies that both move, each about a point of its own: what may not change an answer, and the
bounds that sweeps rest on."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import ofg
from ofg import Body, Motion, Pose, Query, _core
from tests.ofg.conftest import CUBE, rows_of_motions, rows_of_poses

ALL = 10**6
seeds = st.integers(0, 2**32 - 1)


def hull(rng, size=1.0):
    """A random hull of whole-numbered vertices, away from its frame's origin."""
    while True:
        points = rng.integers(-6, 7, (int(rng.integers(6, 14)), 3)) + rng.integers(-4, 5, 3)
        try:
            return Body.convex(points * size / 4.0)
        except ofg.BodyError:
            continue


def motion(rng, length=4.0, angle=3.0, reach=3.0):
    return Motion(
        np.round(rng.uniform(-length, length, 3) * 64) / 64,
        rng.normal(size=3),
        rng.uniform(-angle, angle) * rng.integers(0, 2),
        np.round(rng.uniform(-reach, reach, 3) * 4) / 4,
    )


def question(seed, length=4.0, angle=3.0):
    rng = np.random.default_rng(seed)
    pose = [Pose(rng.normal(size=4), np.round(rng.uniform(-2.5, 2.5, 3) * 64) / 64) for _ in "ab"]
    return Query(
        "motion",
        hull(rng),
        hull(rng),
        *pose,
        motion(rng, length, angle),
        motion(rng, length, angle),
    )


def same(one, other, late=2e-5):
    """Both miss, or both hit at one time. A chord may stray by 1e-6 of A's radius, and times move
    by more where bodies graze."""
    assert one.hit == other.hit
    assert not one.hit or abs(one.time - other.time) <= late


@settings(max_examples=150, deadline=None)
@given(seeds)
def test_a_and_b_may_change_places(seed):
    query = question(seed)
    same(ofg.ask(query, repairs="all"), ofg.ask(query.swapped(), repairs="all"))


@settings(max_examples=100, deadline=None)
@given(seeds)
def test_what_both_bodies_do_changes_nothing(seed):
    """Displacements are dyadic, so that adding one to both leaves the relative one exact: the
    answers are the same to the last bit."""
    q = question(seed)
    more = np.array([64.0, -32.5, 16.25])
    moved = [
        Motion(m.displacement + more, m.axis, m.angle, m.about) for m in (q.motion, q.motion_b)
    ]
    one, other = (
        ofg.ask(q, repairs="all"),
        ofg.ask(Query("motion", q.a, q.b, q.pose_a, q.pose_b, *moved), repairs="all"),
    )
    assert one == other or (not one.hit and not other.hit)


@settings(max_examples=100, deadline=None)
@given(seeds)
def test_a_turn_about_a_point_is_a_turn_about_the_origin_of_a_frame_put_there(seed):
    """The vertices v - c are exact: they and c are quarters. p + R c is rounded."""
    q = question(seed)
    parts = []
    for body, pose, m in ((q.a, q.pose_a, q.motion), (q.b, q.pose_b, q.motion_b)):
        framed = Pose(pose.quaternion, pose.apply(m.about[None])[0])
        parts.append(
            (Body.convex(body.vertices - m.about), framed, Motion(m.displacement, m.axis, m.angle))
        )
    (a, pa, ma), (b, pb, mb) = parts
    for options in (
        {"repairs": "all"},
        {"k": 8},
        {"k": ALL, "both_vertices": True, "earliest": True},
    ):
        one, other = (
            ofg.ask(q, **options),
            ofg.ask(Query("motion", a, b, pa, pb, ma, mb), **options),
        )
        assert one.hit == other.hit
        # Without repairs the first hit in the order of the faces is taken, and the hulls are made
        # anew.
        if options != {"k": 8}:
            assert np.isclose(one.time, other.time, rtol=0, atol=2e-5, equal_nan=True)


@settings(max_examples=100, deadline=None)
@given(seeds)
def test_backwards_the_bodies_meet_too(seed):
    q = question(seed)
    ends = [m.pose_at(p, 1.0) for m, p in ((q.motion, q.pose_a), (q.motion_b, q.pose_b))]
    back = [Motion(-m.displacement, m.axis, -m.angle, m.about) for m in (q.motion, q.motion_b)]
    assert (
        ofg.ask(q, repairs="all").hit
        == ofg.ask(Query("motion", q.a, q.b, *ends, *back), repairs="all").hit
    )


def test_the_point_turned_about_matters_only_where_something_turns(hulls):
    rng = np.random.default_rng(3)
    pa, pb, m = (
        rows_of_poses(rng, 100, 3),
        rows_of_poses(rng, 100, 0),
        rows_of_motions(rng, 100, 6, 0),
    )
    about = np.hstack([m, rng.normal(size=(100, 3))])
    for options in ({}, {"repairs": "all"}):
        want, got = (ofg.sweep_many(hulls[3], hulls[9], pa, pb, x, **options) for x in (m, about))
        assert np.array_equal(want.hit, got.hit) and np.array_equal(
            want.time, got.time, equal_nan=True
        )
        assert np.array_equal(want.counts, got.counts)


@settings(max_examples=40, deadline=None)
@given(seeds)
def test_what_dense_sampling_meets_is_met_and_no_later(seed):
    """The poses sampled are those of Python, and all faces are tried there."""
    q = question(seed)
    times = np.linspace(0, 1, 101)
    poses = [
        [m.pose_at(p, t) for t in times] for m, p in ((q.motion, q.pose_a), (q.motion_b, q.pose_b))
    ]
    sampled = ofg.discrete_many(q.a, q.b, *poses, k=ALL, containment=True).hit
    got = ofg.ask(q, repairs="all")
    if sampled.any():
        assert got.hit and got.time <= times[np.argmax(sampled)] + 1e-5
    if got.hit:  # and then they are so near that the time is one of contact
        at = [m.pose_at(p, got.time) for m, p in ((q.motion, q.pose_a), (q.motion_b, q.pose_b))]
        grown = Body.convex(q.a.vertices + (q.a.vertices - q.a.centre) * 1e-4)
        assert ofg.discrete(grown, q.b, *at, k=ALL, containment=True)


@settings(max_examples=150, deadline=None)
@given(seeds, st.sampled_from([1.0, 0.5, 0.1, 0.01]), st.sampled_from([1.0, 30.0]))
def test_no_vertex_strays_from_its_chord_by_more_than_the_bound(seed, share, fast):
    q = question(seed, 4 * fast, 6)
    rows = [[*p.quaternion, *p.position] for p in (q.pose_a, q.pose_b)]
    motions = [[*m.displacement, *m.axis, m.angle, *m.about] for m in (q.motion, q.motion_b)]
    bound_a, bound_b = _core.strays(
        *(_core.Solid(x.vertices, x.faces, False, [], []) for x in (q.a, q.b)),
        np.array(rows),
        np.array(motions),
        share,
    )
    start = np.random.default_rng(seed).uniform(0, 1 - share)
    shares = np.linspace(0, 1, 33)
    paths_a, paths_b = [], []
    for s in shares:
        pa, pb = (
            m.pose_at(p, start + s * share)
            for m, p in ((q.motion, q.pose_a), (q.motion_b, q.pose_b))
        )
        paths_a.append((pa.apply(q.a.vertices) - pb.position) @ pb.rotation)
        paths_b.append(
            (pb.apply(q.b.vertices) - pa.position) @ pa.rotation
            - q.motion.about * (q.motion.angle != 0)
        )
    for paths, bound, near in (
        (paths_a, bound_a, np.inf),
        (paths_b, bound_b, _lever(q.a, q.motion)),
    ):
        paths = np.array(paths)
        chords = paths[0] + (paths[-1] - paths[0]) * shares[:, None, None]
        off = np.linalg.norm(paths - chords, axis=2).max(axis=0)
        meets = np.linalg.norm(paths, axis=2).min(axis=0) <= near
        assert (off[meets] <= bound * (1 + 1e-9) + 1e-12).all()


def _lever(body, motion):
    return np.linalg.norm(body.vertices - motion.about * (motion.angle != 0), axis=1).max()


@settings(max_examples=100, deadline=None)
@given(seeds, st.sampled_from(["centroid", "point-triangle"]))
def test_adaptive_k_finds_the_same_from_any_k(seed, nearest):
    q = question(seed)
    options = dict(repairs="all", arc_tolerance=1e-4, nearest=nearest)
    one, all_faces = ofg.ask(q, k=1, **options), ofg.ask(q, k=ALL, **options)
    assert one.hit == all_faces.hit and np.isclose(
        one.time, all_faces.time, rtol=0, atol=1e-9, equal_nan=True
    )


def test_a_tip_that_flies_past_a_spinning_plate_is_met():
    """Seen from A, which spins, the tip of B runs on a parabola that dips 0.004 into a face, off
    its edges. Windows were halved only until A's own arcs were true enough, whatever the chords of
    B's vertices strayed by: 0.12 here."""
    plate = Body.convex(CUBE * (1, 1, 0.01), "plate")
    needle = Body.convex(
        [[0, 0, 0], [1e-4, 0, -4], [-1e-4, 1e-4, -4], [-1e-4, -1e-4, -4]], "needle"
    )
    fly = Motion((120.0, 0, 0))
    for middle in np.linspace(0.3, 0.7, 41):  # of the contact, in time
        spin, start = (
            Motion(axis=(0, 1, 0), angle=-2.0),
            Pose((np.cos(middle), 0, np.sin(middle), 0)),
        )
        flown = Pose(position=(-120 * middle, 0.7, -0.01 + 0.004))
        assert ofg.discrete(
            plate, needle, spin.pose_at(start, middle), fly.pose_at(flown, middle), k=ALL
        )
        assert ofg.rotational_sweep(
            plate, needle, spin, start, flown, motion_b=fly, repairs="all", arc_tolerance=1e-3
        ), middle


def test_the_questions_here_have_both_answers():
    hits = sum(ofg.ask(question(seed), repairs="all").hit for seed in range(100))
    assert 20 < hits < 80, hits


@pytest.mark.parametrize("columns", [6, 8, 11])
def test_rows_of_motions_have_seven_or_ten_numbers(cube, columns):
    with pytest.raises(ValueError, match=r"\(n, 10\).*\(n, 7\)"):
        ofg.sweep_many(cube, cube, [Pose()], [Pose()], np.zeros((1, columns)))


def test_rows_and_motions_say_the_same(cube):
    m = Motion((1, 2, 3), (0, 1, 1), 0.7, (0.5, 0, -1))
    rows = np.array([[*m.displacement, *m.axis, m.angle, *m.about]])
    far = Pose(position=(-2.5, -2, -3))
    one, other = (
        ofg.sweep_many(cube, cube, [far], [Pose()], x, repairs="all") for x in ([m], rows)
    )
    assert one.hit[0] and np.array_equal(one.time, other.time)
