# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Verified Opposing Face Geometry in motion: the first contact of solids, never late."""

from __future__ import annotations

import numpy as np

from . import _core, checks
from .algorithm import threads_of
from .arrays import Motions, Poses, broadcast, row, rows_of
from .body import Body
from .impact import Impact, Impacts
from .motion import Motion
from .pose import Pose
from .query import Query
from .solid import BodyError
from .verification import solid_of


def verified_sweep(
    a: Body, b: Body, pose_a: Pose, pose_b: Pose, motion_a: Motion, motion_b: Motion = Motion()
) -> Impact:
    """When do the interiors of `a` and `b` meet first over the step? Never missed, never late.

    a, b: convex bodies, or unions, whose pairs of pieces are asked until the earliest time found.
    Both may translate and rotate, any number of turns. Overlap at the start has time 0. Bodies that
    touch at the start and part are clear.

    Translation: a ray is shot at the difference of the bodies. What doubles cannot prove is decided
    exactly, so that every answer is proved. Rotation: planes that are fixed, turn with a body or
    stay normal to an edge of each keep the bodies apart over intervals of time, by bounds on second
    derivatives. Where rounding hides whether they meet, the answer is a hit with Impact.proved
    False. Every time is proved to be no later than the first contact; see `Impact`.

    Lengths in the unit of the bodies. counts: spheres, distances (of vertices along an axis),
    face_pairs (portals tried), full_tests (supports of the whole bodies), steps (pairs of pieces,
    segments of time, and exact decisions). Raises as `verified`, and TypeError for a motion of
    another type. Sources: van den Bergen, Ray Casting against General Convex Objects, 2004;
    Mirtich, Impulse-based Dynamic Simulation, 1996, for advancement by bounds.
    """
    checks.pose(pose_a, "pose_a")
    checks.pose(pose_b, "pose_b")
    checks.motion(motion_a, "motion_a")
    checks.motion(motion_b, "motion_b")
    return verified_sweep_many(a, b, [pose_a], [pose_b], [motion_a], [motion_b])[0]


def verified_sweep_many(
    a: Body,
    b: Body,
    poses_a: Poses,
    poses_b: Poses,
    motions_a: Motions,
    motions_b: Motions = Motion(),
    *,
    threads: int | None = 1,
) -> Impacts:
    """`verified_sweep` for n pairs of poses and motions in one call.

    poses_a, poses_b, motions_a, motions_b: as for `sweep_many`. threads: 1 to 256; None for one per
    core; answers do not depend on it. The interpreter lock is released. Raises as `verified_sweep`.
    """
    count = threads_of(threads)
    given = (
        (poses_a, Pose, "poses_a"),
        (poses_b, Pose, "poses_b"),
        (motions_a, Motion, "motions_a"),
        (motions_b, Motion, "motions_b"),
    )
    at_a, at_b, along_a, along_b = broadcast([rows_of(*each) for each in given])
    (hit, time, found, faces, pieces, counts), latest, proved = _core.verified_sweep_many(
        pieces_of(a, "a"), pieces_of(b, "b"), at_a, at_b, along_a, along_b, count
    )
    return Impacts(hit, time, found, faces, pieces, counts, "none", latest, proved)


def prepare_verified_sweep(query: Query) -> _core.PreparedVerifiedSweep:
    """A callable that asks a translation or motion query in the core and returns (hit, time): what
    a harness times.
    """
    checks.query(query)
    if query.question == "overlap":
        raise ValueError("Query.question = 'overlap'; use prepare_verified.")
    poses = np.array([row(query.pose_a), row(query.pose_b)])
    motions = np.array([row(query.motion), row(query.motion_b)])
    return _core.PreparedVerifiedSweep(
        pieces_of(query.a, "a"), pieces_of(query.b, "b"), poses, motions
    )


def pieces_of(body: Body, name: str) -> _core.VerifiedSolid:
    """The core's form of a body that moves. BodyError for an undivided mesh and a flat body."""
    checks.body(body, name)
    if body.kind == "mesh":
        raise BodyError(
            f"Body '{body.name}' is an undivided mesh, and verified OFG moves convex bodies and"
            " unions of them; use ofg.decompose first."
        )
    return solid_of(body, name)
