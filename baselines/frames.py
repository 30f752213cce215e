# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The same query in another frame, for engines that support fewer motions than a Query."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np

from ofg import Body, Motion, Pose, Query

from .errors import Unsupported


def stated(query: Query, movers: int, about: bool) -> Query:
    """The query in a form that a method supports.

    movers: bodies that it can move. about: whether it can rotate them about any point.

    Returns the query itself if it is already supported. Raises Unsupported if both bodies rotate
    and movers is 1.
    """
    query = one_mover(query) if movers == 1 else query
    return query if about else about_origins(query)


def one_mover(query: Query) -> Query:
    """The same query with B at rest: A gets the relative motion, in double rounding.

    This introduces no error but rounding if at most one body rotates. If that is B, the two are
    exchanged: the answer is the same. Raises Unsupported if both rotate.
    """
    if query.motion.angle and query.motion_b.angle:
        raise Unsupported("both bodies rotate, and this method supports one moving body")
    if query.motion_b.rests:
        return query
    query = query.swapped() if query.motion_b.angle else query
    relative = query.motion.displacement - query.motion_b.displacement
    motion = replace(query.motion, displacement=relative)
    return replace(query, motion=motion, motion_b=Motion())


def about_origins(query: Query) -> Query:
    """The same query with each body in a frame whose origin is its centre of rotation."""
    if not (query.motion.about.any() or query.motion_b.about.any()):
        return query
    a, pose_a, motion = _about_origin(query.a, query.pose_a, query.motion)
    b, pose_b, motion_b = _about_origin(query.b, query.pose_b, query.motion_b)
    return replace(query, a=a, b=b, pose_a=pose_a, pose_b=pose_b, motion=motion, motion_b=motion_b)


def _about_origin(body: Body, pose: Pose, motion: Motion) -> tuple[Body, Pose, Motion]:
    still = replace(motion, about=np.zeros(3))
    if not (motion.angle and motion.about.any()):  # a translation has no centre of rotation
        return body, pose, still
    there = Pose(pose.quaternion, pose.apply(motion.about[None])[0])
    return shifted(body, tuple(motion.about.tolist())), there, still


@lru_cache(maxsize=64)
def shifted(body: Body, origin: tuple[float, float, float]) -> Body:
    """The body in a frame whose origin is at `origin` (3 lengths in its own): vertices v - origin.

    Rounded to double, so a vertex is off by up to 1e-16 of |origin|.
    """
    pieces = tuple(shifted(p, origin) for p in body.pieces) if body.kind == "union" else ()
    return Body.unchecked(body.kind, body.vertices - origin, body.faces, pieces, body.name)


def seen_from(pose_b: Pose, pose_a: Pose, rest_b: Pose) -> Pose:
    """The pose of A that is to B at `rest_b` as `pose_a` is to B at `pose_b`.

    In double rounding; exact in the quaternion if B has not rotated.
    """
    turn = pose_a.quaternion
    offset = pose_a.position - pose_b.position
    if not np.array_equal(pose_b.quaternion, rest_b.quaternion):
        back = product(unit(rest_b.quaternion), unit(pose_b.quaternion) * [1, -1, -1, -1])
        turn, offset = product(back, unit(turn)), Pose(back).rotation @ offset
    return Pose(turn, rest_b.position + offset)


def product(p, q) -> np.ndarray:
    """The quaternion product p q: (4,) each, (w, x, y, z). As rotations: first q, then p."""
    vector = p[0] * q[1:] + q[0] * p[1:] + np.cross(p[1:], q[1:])
    return np.concatenate([[p[0] * q[0] - p[1:] @ q[1:]], vector])


def unit(q: np.ndarray) -> np.ndarray:
    """The quaternion (4,) at length 1."""
    q = q / np.abs(q).max()  # first, as the square of an unnormalised one can overflow
    return q / np.linalg.norm(q)
