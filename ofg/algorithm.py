# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""OFG as functions: one query, or many poses of one pair of bodies in one call."""

from __future__ import annotations

import os
from collections import OrderedDict
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import _core, checks
from .answer import Answer, Answers
from .arrays import Motions, Poses, broadcast, check_float, row, rows_of
from .body import Body
from .motion import Motion
from .options import PRECISION, check_article, core_options
from .pose import Pose
from .query import Query

OFG, BRUTE_FORCE, ARTICLE = 0, 1, 2
_SOLIDS: OrderedDict[str, _core.Solid] = OrderedDict()
_KEPT_SOLIDS = 256
MOST_THREADS = 256


def discrete(
    a: Body, b: Body, pose_a: Pose = Pose(), pose_b: Pose = Pose(), *, k: int = 8, **options: Any
) -> Answer:
    """Discrete OFG in eight steps: do the surfaces of `a` and `b` intersect at these poses?

    k: faces in each selection. If k is at least the number of faces, the answer equals that of
    testing all pairs of faces. Without repairs, a body wholly inside another is not detected, and
    too small a k misses contacts.

    The options below apply to all calls.
    order: order of the tests of a sweep. "ends": the start, the end, then the virtual edges, so a
    hit at an end has the time 0 or 1 and needs no estimate. "steps": the article's list read
    literally, virtual edges first.
    toi: how the time of impact of a hit between the ends is computed. "velocity": the parameter at
    which the virtual edge meets the face, placed on the real motion. "halving": the article's
    second method read literally: move half of the step and test the faces; if none meet, move half
    of the remainder, and so on; NaN if no move meets. "bisection": halving that keeps the bracket.
    "none": no time.
    iterations: maximum number of halvings (20: the bracket of a bisection is then 1e-6 of the step;
    its later end is returned).
    broad: "swept" (step 1 uses bounding spheres swept along the motion) or "start" (at the start
    pose, the literal reading). The default stays "swept" with repairs="none": step 1 at the start
    pose loses fast movers before any other repair can act.
    concave: "object" (OFG at the object level selects one pair of pieces), "undivided" (the surface
    as one mesh) or "all-pairs" (all pairs of pieces).
    precision: "double" or "float" (the relative pose is always in double).
    screen: True lets a separating plane between the whole bodies settle "no" before the steps. The
    answers are the same. They come sooner for bodies that are near but apart, soonest in
    `discrete_many`; the counts then cover only the work done. Adaptive k always screens.
    repairs: "none", "all", "all-but-X", "X" or "X+Y" of the names in parentheses below; or set one
    by one:
    nearest="point-triangle" (point-triangle): how faces are ranked; the article uses "centroid".
    adaptive_k=True (adaptive-k), broad="swept" (swept-spheres), both_vertices=True (both-vertices),
    edge_edge=True (edge-edge), containment=True (containment), concave="all-pairs" (all-pieces),
    earliest=True (earliest).
    selection_times=3 (selection-times): number of times of the step at which faces are selected.
    arc_tolerance=1e-6 (arcs): chords deviate from the arcs by at most this share of A's radius.
    end_moment=True (end-moment): a hit found only at the end gets its time by bisection.
    piece_times=3 (pieces-over-time): pieces are selected at the start, at the end and where the
    centres pass closest.

    Ranges: the largest coordinate of a body lies between 1e-60 and 1e60, or with precision="float"
    between 1e-10 and 1e10; positions and motions as for Pose and Motion, with precision="float"
    those of A relative to B up to 1e10. Raises TypeError for a value of the wrong type, ValueError
    for an unknown option or a value out of range. Source: Kara, "Opposing Face Geometry",
    GameDev.net 2004.
    """
    return _ask(False, a, b, pose_a, pose_b, Motion(), Motion(), OFG, k=k, **options)


def translational_sweep(
    a: Body,
    b: Body,
    displacement: ArrayLike,
    pose_a: Pose = Pose(),
    pose_b: Pose = Pose(),
    *,
    displacement_b: ArrayLike = (0, 0, 0),
    k: int = 8,
    **options: Any,
) -> Answer:
    """Translational sweep in six steps: `a` moves by `displacement` (and `b` by `displacement_b`),
    each (3,), over t in [0, 1].

    Options as for `discrete`. Source: part 3 of the article, "Solving the discrete time problem".
    """
    return _ask(
        True,
        a,
        b,
        pose_a,
        pose_b,
        _shift(displacement),
        _shift(displacement_b),
        OFG,
        k=k,
        **options,
    )


def rotational_sweep(
    a: Body,
    b: Body,
    motion_a: Motion,
    pose_a: Pose = Pose(),
    pose_b: Pose = Pose(),
    *,
    motion_b: Motion = Motion(),
    k: int = 8,
    **options: Any,
) -> Answer:
    """Rotational sweep: `a` (and `b`) rotate and translate by their motions.

    Each rotates about the origin of its frame, or about another point given by its motion. The
    virtual edges are chords of the true paths in the frame of `b`. Options as for `discrete`.
    Source: part 3 of the article, "Solving for rotating objects".
    """
    return _ask(True, a, b, pose_a, pose_b, motion_a, motion_b, OFG, k=k, **options)


def ask(query: Query, *, k: int = 8, **options: Any) -> Answer:
    """Answer a Query with the variant for its question."""
    return _ask(*_asked(query), OFG, k=k, **options)


def article(query: Query, *, k: int = 8, broad: str = "start", **options: Any) -> Answer:
    """Run the article's steps only, without acceleration or repairs. ARTICLE.md discusses the
    article sentence by sentence.

    broad: "start" (step 1 of a sweep at the start pose, the literal reading) or "swept". Further
    options: toi, order, iterations, precision, as for `discrete`. `ask` with the same options gives
    the same answers, faster. Raises TypeError for any other option.
    """
    check_article(options)
    return _ask(*_asked(query), ARTICLE, k=k, broad=broad, **options)


def brute_force(query: Query, *, precision: str = "double") -> Answer:
    """Test all faces against all faces; in a sweep, also every virtual edge of A against every face
    of B, with the earliest time. Bodies are undivided.
    """
    return _ask(*_asked(query), BRUTE_FORCE, precision=precision)


def discrete_many(
    a: Body,
    b: Body,
    poses_a: Poses,
    poses_b: Poses,
    *,
    k: int = 8,
    threads: int | None = 1,
    **options: Any,
) -> Answers:
    """Run `discrete` for n pairs of poses in one call, without holding the interpreter lock.

    poses_a, poses_b: sequences of n Pose, or (n, 7) arrays of quaternion (w, x, y, z) and position;
    a single Pose is used for all n. threads: number of threads, 1 to 256; None for one per core.
    The answers do not depend on it.
    """
    return _many(False, a, b, poses_a, poses_b, Motion(), Motion(), OFG, threads, k=k, **options)


def sweep_many(
    a: Body,
    b: Body,
    poses_a: Poses,
    poses_b: Poses,
    motions_a: Motions,
    motions_b: Motions = Motion(),
    *,
    k: int = 8,
    threads: int | None = 1,
    **options: Any,
) -> Answers:
    """Run sweeps for n pairs of poses and motions in one call.

    motions_a, motions_b: sequences of n Motion, or (n, 10) arrays of displacement, axis, angle and
    about, or (n, 7) without about, which rotate about the origins of the bodies' frames; a single
    Motion is used for all n. If all angles are zero, this is the translational sweep. Other
    arguments as for `discrete_many`.
    """
    return _many(True, a, b, poses_a, poses_b, motions_a, motions_b, OFG, threads, k=k, **options)


def brute_force_many(
    a: Body,
    b: Body,
    poses_a: Poses,
    poses_b: Poses,
    motions_a: Motions | None = None,
    motions_b: Motions = Motion(),
    *,
    threads: int | None = 1,
    precision: str = "double",
) -> Answers:
    """Run `brute_force` for n pairs of poses (and motions, for sweeps) in one call."""
    moving = motions_a is not None
    motions_a = Motion() if motions_a is None else motions_a
    return _many(
        moving,
        a,
        b,
        poses_a,
        poses_b,
        motions_a,
        motions_b,
        BRUTE_FORCE,
        threads,
        precision=precision,
    )


def prepare(
    query: Query, *, algorithm: int = OFG, precision: str = "double", **options: Any
) -> _core.Prepared:
    """A callable that answers `query` in the core and returns (hit, time), for timing."""
    checks.query(query)
    single = _is_float(precision)
    poses = np.array([row(query.pose_a), row(query.pose_b)])
    motions = np.array([row(query.motion), row(query.motion_b)])
    if single:
        check_float(poses[:1], poses[1:], motions[:1], motions[1:])
    return _core.Prepared(
        solid(query.a, precision),
        solid(query.b, precision),
        poses,
        motions,
        core_options(**options),
        algorithm,
        query.question != "overlap",
        single,
    )


def solid(body: Body, precision: str = "double") -> _core.Solid:
    """The core's representation of a body, cached by content for the last few hundred bodies.

    Raises ValueError if the largest coordinate of the body is out of the core's range (see
    `discrete`).
    """
    checks.coordinates(body, precision)
    key = body.digest
    if key in _SOLIDS:
        _SOLIDS.move_to_end(key)
        return _SOLIDS[key]
    made = _core.Solid(
        body.vertices,
        body.broad_faces,
        body.kind == "convex",
        [p.vertices for p in body.pieces],
        [p.faces for p in body.pieces],
    )
    _SOLIDS[key] = made
    if len(_SOLIDS) > _KEPT_SOLIDS:
        _SOLIDS.popitem(last=False)
    return made


def _shift(displacement: ArrayLike) -> Motion:
    return Motion(checks.vector(displacement, 3, "Motion.displacement"))


def _asked(q: Query) -> tuple[bool, Body, Body, Pose, Pose, Motion, Motion]:
    checks.query(q)
    return q.question != "overlap", q.a, q.b, q.pose_a, q.pose_b, q.motion, q.motion_b


def _ask(
    moving: bool,
    a: Body,
    b: Body,
    pose_a: Pose,
    pose_b: Pose,
    motion_a: Motion,
    motion_b: Motion,
    algorithm: int,
    **options: Any,
) -> Answer:
    checks.pose(pose_a, "pose_a")
    checks.pose(pose_b, "pose_b")
    checks.motion(motion_a, "motion_a")
    checks.motion(motion_b, "motion_b")
    return _many(moving, a, b, [pose_a], [pose_b], [motion_a], [motion_b], algorithm, 1, **options)[
        0
    ]


def _many(  # noqa: PLR0913 - the core's arguments
    moving: bool,
    a: Body,
    b: Body,
    poses_a: Poses,
    poses_b: Poses,
    motions_a: Motions,
    motions_b: Motions,
    algorithm: int,
    threads: int | None,
    *,
    precision: str = "double",
    **options: Any,
) -> Answers:
    checks.body(a, "a")
    checks.body(b, "b")
    single = _is_float(precision)
    rows = [
        rows_of(poses_a, Pose, "poses_a"),
        rows_of(poses_b, Pose, "poses_b"),
        rows_of(motions_a, Motion, "motions_a"),
        rows_of(motions_b, Motion, "motions_b"),
    ]
    at_a, at_b, by_a, by_b = broadcast(rows)
    if single:
        check_float(at_a, at_b, by_a, by_b)
    hit, time, found, faces, pieces, counts = _core.ask_many(
        solid(a, precision),
        solid(b, precision),
        at_a,
        at_b,
        by_a,
        by_b,
        core_options(**options),
        algorithm,
        moving,
        single,
        threads_of(threads),
    )
    toi = options.get("toi", "velocity")
    return Answers(hit, time, found, faces, pieces, counts, toi)


def threads_of(threads: int | None) -> int:
    """As many threads as given, or for None one per core. ValueError if out of range."""
    if threads is None:
        return min(os.cpu_count() or 1, MOST_THREADS)
    try:
        return checks.whole("threads", threads, 1, MOST_THREADS)
    except ValueError as error:
        raise ValueError(f"{str(error)[:-1]}, or None for one per core.") from None


def _is_float(precision: str) -> bool:
    return checks.one_of("precision", precision, PRECISION) == 1
