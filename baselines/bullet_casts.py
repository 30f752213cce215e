# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Bullet's continuous convex casts, which only its C++ library offers, through a native plugin.

btSubsimplexConvexCast and btGjkConvexCast support translations, btContinuousConvexCollision also
rotations. A union is cast in pairs of pieces, and the earliest hit counts. `ofg-bench native
--build` builds the plugin if it finds Bullet's headers.

By their documentation bodies must not overlap at the start; btSubSimplexConvexCast.h advises
testing that with btGjkPairDetector, which the best effort does.

The unit of the best effort is chosen as for every engine (units.csv). Its hull margin, 0 or 0.001,
gave the fewest misses, then the fewest false alarms, on 703 certified sweeps, among margins from 0
to 0.1; up to 1000 iterations and an epsilon down to 1e-30 change nothing for the subsimplex cast in
large units, and a positive m_allowedPenetration adds misses.
"""

from __future__ import annotations

import ctypes
import math
import weakref
from collections.abc import Callable
from functools import cache
from typing import ClassVar

import numpy as np

from ofg import Body, Motion, Pose, Query

from .contract import Method, Tolerance, Verdict
from .native import library
from .units import Normalised

MARGIN = 0.04  #: CONVEX_DISTANCE_MARGIN, which a btConvexHullShape adds around its points
NEAR = 0.001  #: the distance at which the GJK and the continuous cast report contact
TURN = math.pi / 4  #: the largest rotation that btTransformUtil::integrateTransform supports


class _Cast(Method):
    """A cast with Bullet's own values: hulls with their margin, limits as constructed."""

    engine, imports = "libbullet", "baselines.native.library"
    configuration = "default"
    questions = frozenset({"translation"})
    bodies = frozenset({"convex", "union"})
    solid = True
    movers = 2
    gives_time = True
    kind: ClassVar[int]  #: casts::Kind of native/casts.hpp
    hull_margin: ClassVar[float] = -1  #: -1: Bullet's default
    start_unit: ClassVar[float] = 0.0  #: of the test at the start, see native/casts.hpp; 0: none
    halvings: ClassVar[int] = 0  #: of a leg whose cast did not converge

    def prepare(self, query: Query) -> Callable[[], Verdict]:
        self.refuse(query)
        plugin, legs = _plugin(), _legs(query, self.legs(query))
        question = plugin.bullet_casts_make(
            self.kind,
            self.hull_margin,
            self.start_unit,
            self.halvings,
            *_pieces(query.a),
            *_pieces(query.b),
            legs,
            len(legs),
        )
        time = ctypes.c_double()
        at, cast = ctypes.byref(time), plugin.bullet_casts_ask

        def ask() -> Verdict:
            return Verdict(True, time.value) if cast(question, at) else Verdict(False)

        weakref.finalize(ask, plugin.bullet_casts_free, question)
        return ask

    def legs(self, query: Query) -> int:
        """The number of consecutive casts into which the motion is divided."""
        return 1


class _Exact(Normalised):
    """No margin, the unit of units.csv, and a test at the start."""

    configuration = "best effort"
    own_tolerance = Tolerance()
    hull_margin = 0.0

    @property
    def start_unit(self) -> float:
        """Bodies of radius 1, as in `bullet-no-margin`."""
        return 1 / self.length


class BulletSubsimplexCast(_Cast):
    name = "bullet-subsimplex-cast"
    kind = 0
    tolerance = Tolerance(2 * MARGIN, sides="alarms")
    guarantee = (
        "btSubsimplexConvexCast on hulls grown by 0.04 each; requires no overlap at the start"
    )


class BulletSubsimplexCastExact(_Exact, BulletSubsimplexCast):
    """In units of 32 and above, 9 of 253 hits are missed: bodies that start 1e-10 or less from
    contact.
    """

    name = "bullet-subsimplex-cast-exact"
    guarantee = "btSubsimplexConvexCast without margins, the start tested by GJK/EPA"


class BulletGjkCast(_Cast):
    name = "bullet-gjk-cast"
    kind = 1
    tolerance = Tolerance(2 * MARGIN + NEAR, sides="alarms")
    guarantee = "btGjkConvexCast on hulls grown by 0.04 each, a hit at distances up to 0.001"


class BulletGjkCastExact(_Exact, BulletGjkCast):
    """The cast has no penetration solver and loses contact when hulls without margin touch.

    The hulls therefore keep a small margin: without it, 146 of 253 hits are missed in units of
    2^18.
    """

    name = "bullet-gjk-cast-exact"
    hull_margin = 0.001
    own_tolerance = Tolerance(2 * hull_margin + NEAR, sides="alarms")
    guarantee = "btGjkConvexCast on hulls grown by 0.001 of its unit, the start tested by GJK/EPA"


class BulletContinuousCast(_Cast):
    """As in btCollisionWorld's convexSweepTest: one cast, with GJK-EPA for penetrations."""

    name = "bullet-continuous-cast"
    questions = frozenset({"translation", "motion"})
    kind = 2
    tolerance = Tolerance(2 * MARGIN + NEAR, sides="alarms")
    guarantee = (
        "btContinuousConvexCollision on hulls grown by 0.04 each, a hit at distances up to "
        "0.001; rotations up to 45 degrees"
    )


class BulletContinuousCastExact(_Exact, BulletContinuousCast):
    """Rotations in legs of up to 45 degrees, within which Bullet's interpolation equals our
    rotation about an axis.

    A leg whose cast reports that its 64 iterations were insufficient is halved: otherwise 20 of 156
    hits of rotating bodies are missed.
    """

    name = "bullet-continuous-cast-exact"
    own_tolerance = Tolerance(NEAR, sides="alarms")
    halvings = 20
    guarantee = (
        "btContinuousConvexCollision without margins, rotations in legs of 45 degrees, the start "
        "tested by GJK/EPA"
    )

    def legs(self, query: Query) -> int:
        turn = max(abs(query.motion.angle), abs(query.motion_b.angle))
        return max(1, math.ceil(turn / TURN))


def _legs(query: Query, n: int) -> np.ndarray:
    """(n, 28): A at the start and the end of each leg, then B."""
    sides = ((query.motion, query.pose_a), (query.motion_b, query.pose_b))
    return np.array(
        [
            np.concatenate(
                [_place(motion, pose, t) for motion, pose in sides for t in (i / n, (i + 1) / n)]
            )
            for i in range(n)
        ]
    )


def _place(motion: Motion, pose: Pose, t: float) -> np.ndarray:
    """(7,): position and quaternion (w, x, y, z) at time t of the step."""
    at = motion.pose_at(pose, t)
    return np.concatenate([at.position, at.quaternion])


def _pieces(body: Body) -> tuple[np.ndarray, np.ndarray, int]:
    """Points of all pieces (m, 3), the number of points of each, and the number of pieces."""
    points = [np.asarray(piece.vertices, float) for piece in body.pieces]
    return np.concatenate(points), np.array([len(p) for p in points], np.int64), len(points)


@cache
def _plugin() -> ctypes.CDLL:
    plugin = library.load("libbullet")
    real, whole = (
        np.ctypeslib.ndpointer(kind, flags="C_CONTIGUOUS") for kind in (np.float64, np.int64)
    )
    body, number = [real, whole, ctypes.c_int64], ctypes.c_int
    plugin.bullet_casts_make.restype = ctypes.c_void_p
    options = [number, ctypes.c_double, ctypes.c_double, number]
    plugin.bullet_casts_make.argtypes = [*options, *body, *body, real, ctypes.c_int64]
    plugin.bullet_casts_free.argtypes, plugin.bullet_casts_free.restype = [ctypes.c_void_p], None
    plugin.bullet_casts_ask.argtypes = [ctypes.c_void_p, ctypes.POINTER(ctypes.c_double)]
    return plugin


METHODS = [
    BulletSubsimplexCast,
    BulletSubsimplexCastExact,
    BulletGjkCast,
    BulletGjkCastExact,
    BulletContinuousCast,
    BulletContinuousCastExact,
]
