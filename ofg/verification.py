# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Verified Opposing Face Geometry: overlap of solids, each answer proved or decided exactly."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable

import numpy as np

from . import _core, checks
from .algorithm import threads_of
from .answer import Answer, Answers
from .arrays import Poses, broadcast, row, rows_of
from .body import Body
from .pose import Pose
from .query import Query
from .solid import BodyError

_SOLIDS: OrderedDict[str, _core.VerifiedSolid] = OrderedDict()
_KEPT_SOLIDS = 256


class PairCache:
    """What the last `verified` question about a pair of bodies proved, for the next one: worth
    keeping where poses change little from one call to the next. No answer depends on it. It is used
    where both bodies are convex; asked about other bodies it is forgotten. For one thread at a
    time. core: what the native code keeps.
    """

    def __init__(self) -> None:
        self.core = _core.Cache()


def verified(
    a: Body, b: Body, pose_a: Pose = Pose(), pose_b: Pose = Pose(), cache: PairCache | None = None
) -> Answer:
    """Do the interiors of `a` and `b` meet at these poses? Never a miss and never a false alarm.

    a, b: bodies of any kind. Of unions every pair of pieces, of meshes every pair of faces is
    excluded by the boxes of a tree or asked, the deepest first, until one meets. Two meshes meet
    where faces cross, or where none do and a shell of one lies inside the other. Of two convex
    bodies or pieces, a table of directions selects the vertices of the faces that oppose each
    other, a portal tests them, and the answer is verified: a hit by a tetrahedron of differences of
    points of both that holds the origin by more than rounding, a clear by a plane that the whole
    bodies confirm by more than rounding. Where these object the selection grows, and what doubles
    cannot prove is decided exactly on the vertices, quaternions and positions as they are given.
    Convex bodies, and unions, that only touch are clear. What meshes that only touch are called may
    not be relied on: there `b` is moved by less than any number, so that no vertex lies on a face.

    Answer.found: "start", with the faces of two convex bodies that oppose each other where the
    portal was left (they need not cross), or those of two meshes that cross. "inside" where
    inscribed balls meet or a shell is inside, without faces. Answer.time is NaN.
    counts: spheres (pairs compared), evaluated (pairs of boxes), distances (of vertices along an
    axis), face_pairs (portals tried; pairs of faces of meshes), full_tests (verifications: supports
    of the whole bodies), growths (those that objected), steps (pairs of pieces, or 1 for meshes,
    and 1 more for each that took exact arithmetic).

    cache: of this pair, or None. Lengths in the unit of the bodies. Raises TypeError for what is of
    another type, ValueError for bodies or poses out of range (as of `discrete`), BodyError (a
    ValueError) for bodies that are exactly flat and for open surfaces. Sources: Snethen,
    XenoCollide, Game Programming Gems 7, 2008; Kara, Opposing Face Geometry, GameDev.net 2004;
    Edelsbrunner and Muecke, Simulation of Simplicity, ACM Transactions on Graphics 9, 1990.
    """
    checks.pose(pose_a, "pose_a")
    checks.pose(pose_b, "pose_b")
    return _many(a, b, [pose_a], [pose_b], PairCache() if cache is None else cache, 1)[0]


def verified_many(
    a: Body,
    b: Body,
    poses_a: Poses,
    poses_b: Poses,
    *,
    cache: PairCache | None = None,
    threads: int | None = 1,
) -> Answers:
    """`verified` for n pairs of poses in one call.

    poses_a, poses_b: sequences of n Pose, or (n, 7) arrays of quaternion (w, x, y, z) and position;
    one Pose stands for n of it. cache: asked from pose to pose, in their order; with one thread
    alone. threads: how many, 1 to 256; None for one per core. Answers do not depend on either.
    Without a cache as many pairs are asked at once as a register has lanes, in single precision and
    of the whole bodies; one that this does not settle is asked as by `verified`. Hits are equal,
    the faces of a hit and the counts may differ. The interpreter lock is released then. Raises as
    `verified`.
    """
    count = threads_of(threads)
    if cache is not None and count > 1:
        raise ValueError(f"threads = {count} cannot share a cache; use threads = 1, or no cache.")
    return _many(a, b, poses_a, poses_b, cache, count)


def _many(
    a: Body, b: Body, poses_a: Poses, poses_b: Poses, cache: PairCache | None, count: int
) -> Answers:
    if cache is not None:
        remedy = "make one with PairCache() for each pair of bodies"
        checks.of_type(cache, PairCache, "cache", remedy)
    at_a, at_b = broadcast([rows_of(poses_a, Pose, "poses_a"), rows_of(poses_b, Pose, "poses_b")])
    kept = cache.core if cache is not None else None
    hit, time, found, faces, pieces, counts = _core.verified_many(
        solid_of(a, "a"), solid_of(b, "b"), at_a, at_b, kept, True, count
    )
    return Answers(hit, time, found, faces, pieces, counts, "none")


def prepare_verified(query: Query, *, selection: bool = True) -> _core.PreparedVerified:
    """A callable that asks an overlap query in the core and returns (hit, NaN): what a harness
    times.

    selection: False to leave out the opposing faces, for a portal of the whole bodies: what the
    selection is worth is the difference. The answers are the same.
    """
    checks.query(query)
    if query.question != "overlap":
        raise ValueError(f"Query.question = '{query.question}'; verified OFG answers 'overlap'.")
    poses = np.array([row(query.pose_a), row(query.pose_b)])
    checks.truth("selection", selection)
    return _core.PreparedVerified(solid_of(query.a, "a"), solid_of(query.b, "b"), poses, selection)


def prepare_spheres(
    query: Query, clear: object, hit: object, otherwise: Callable[[], object]
) -> _core.PreparedSpheres:
    """A callable that asks the bounding and inscribed spheres of an overlap query first, which is
    the first step of `verified`: `clear` or `hit` where they prove it, else what `otherwise()`
    returns.

    Both bodies are convex. What spheres are worth to any other method is the difference.
    """
    checks.query(query)
    poses = np.array([row(query.pose_a), row(query.pose_b)])
    solids = solid_of(query.a, "a"), solid_of(query.b, "b")
    return _core.PreparedSpheres(*solids, poses, clear, hit, otherwise)


def solid_of(body: Body, name: str = "body") -> _core.VerifiedSolid:
    """The core's form of a body with its tables and its tree, built when first asked and kept for
    the last few hundred bodies by content. BodyError for a flat body and an open surface.
    """
    checks.body(body, name)
    checks.coordinates(body)
    key = body.digest
    if key in _SOLIDS:
        _SOLIDS.move_to_end(key)
        return _SOLIDS[key]
    closed = body.kind == "mesh"
    parts = (body,) if closed else body.pieces
    try:
        made = _core.VerifiedSolid([p.vertices for p in parts], [p.faces for p in parts], closed)
    except ValueError as error:
        raise BodyError(f"Body '{body.name}': {error}.") from error
    _SOLIDS[key] = made
    if len(_SOLIDS) > _KEPT_SOLIDS:
        _SOLIDS.popitem(last=False)
    return made
