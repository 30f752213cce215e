# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Bullet 3 through PyBullet: convex hulls by getClosestPoints, at one pose or at substeps.

Sweeps are sampled, because getClosestPoints takes no motion. Bullet's continuous casts, which
PyBullet does not offer, are in bullet_casts.py; its swept sphere belongs to the stepping track. A
union is a plain loop over all pairs of pieces: PyBullet's compound shape takes no vertices. Meshes
are refused except by the -coacd methods, which decompose them: a hull would be another body, and
mesh against mesh silently returns nothing. Pitfalls avoided here:
- A hull is given by its vertices only; with indices it would become a concave mesh.
- A hull that is not removed leaks 27 KiB, so each hull is removed with its query.
- One DIRECT client per process: a client takes 28 MB, and many of them exhaust the memory.
- pybullet prints a line at import and a warning at each removal; both are suppressed.
"""

from __future__ import annotations

import ctypes
import os
import weakref
from contextlib import contextmanager
from functools import cache
from itertools import product

from ofg import Body, Pose, Query

from .contract import MissingEngine, Tolerance, Unsupported
from .pieces import Decomposed
from .sampling import Discrete, Substeps
from .units import Normalised

# of each hull, whatever its size; cubes in 200 rotations: distances are short by 2e-3 to within
# 1e-12
MARGIN = 0.001


class Bullet(Discrete):
    """Bullet with its defaults: each hull has a margin of 0.001, so pairs closer than 0.002 are
    reported to touch.
    """

    name = "bullet"
    engine, imports = "pybullet", "pybullet"
    configuration = "default"
    bodies = frozenset({"convex", "union"})
    solid = True
    tolerance = Tolerance(2 * MARGIN, sides="alarms")
    guarantee = "GJK/EPA in doubles on hulls grown by 0.001 each"
    places_b = True
    threshold = 0.0  #: a reported distance below this is an overlap

    def build(self, query: Query):
        bullet, client = connection()
        shapes_a, shapes_b = (_hulls(bullet, client, body) for body in (query.a, query.b))
        pairs = list(product(shapes_a, shapes_b))
        threshold = self.threshold

        def test(at) -> bool:
            position, turn, position_b, turn_b = at
            for a, b in pairs:
                points = bullet.getClosestPoints(
                    -1,
                    -1,
                    0.0,
                    collisionShapeA=a,
                    collisionShapeB=b,
                    collisionShapePositionA=position,
                    collisionShapeOrientationA=turn,
                    collisionShapePositionB=position_b,
                    collisionShapeOrientationB=turn_b,
                    physicsClientId=client,
                )
                if any(point[8] < threshold for point in points):
                    return True
            return False

        weakref.finalize(test, _remove, bullet, client, shapes_a + shapes_b)
        return lambda a, b=query.pose_b: _place(a) + _place(b), test


class BulletNoMargin(Normalised, Bullet):
    """Bullet with the margins added back to the reported distance: accurate to 1e-12 on cubes at
    gaps from 1e-1 to -1e-1.
    """

    name = "bullet-no-margin"
    configuration = "best effort"
    own_tolerance = Tolerance()  # the margins are subtracted
    threshold = -2 * MARGIN
    guarantee = (
        "GJK/EPA in doubles on hulls grown by 0.001 each, the growth subtracted from the distance"
    )


class BulletSubsteps(Substeps, Bullet):
    name = "bullet-substeps"
    guarantee = "bullet at n sampled poses; misses contacts between samples"


class BulletNoMarginSubsteps(Substeps, BulletNoMargin):
    name = "bullet-no-margin-substeps"
    guarantee = "bullet-no-margin at n sampled poses; misses contacts between samples"


class BulletCoacd(Decomposed, BulletNoMargin):
    name = "bullet-coacd"
    guarantee = (
        "bullet-no-margin on the pieces of CoACD at threshold 0.05, which only approximate the mesh"
    )


class BulletCoacdSubsteps(Substeps, BulletCoacd):
    name = "bullet-coacd-substeps"
    guarantee = "bullet-coacd at n sampled poses; misses contacts between samples"


@cache
def connection():
    try:
        with _quiet():
            import pybullet
    except ImportError as error:
        raise MissingEngine(
            "pybullet is not installed; install it with: pip install pybullet"
        ) from error
    return pybullet, pybullet.connect(pybullet.DIRECT)


def _hulls(bullet, client: int, body: Body) -> list[int]:
    shapes = [
        bullet.createCollisionShape(
            bullet.GEOM_MESH, vertices=p.vertices.tolist(), physicsClientId=client
        )
        for p in body.pieces
    ]
    if min(shapes) < 0:
        raise Unsupported(f"pybullet cannot make a hull of body '{body.name}'")
    return shapes


def _remove(bullet, client: int, shapes: list[int]) -> None:
    if bullet.isConnected(client):
        with _quiet():
            for shape in shapes:
                bullet.removeCollisionShape(shape, physicsClientId=client)


@contextmanager
def _quiet():
    """Discard what C code prints. C buffers separately from Python, so its buffer is flushed
    while output is still diverted.
    """
    flush = ctypes.CDLL(None).fflush
    flush(None)
    saved, null = [os.dup(1), os.dup(2)], os.open(os.devnull, os.O_WRONLY)
    os.dup2(null, 1)
    os.dup2(null, 2)
    try:
        yield
    finally:
        flush(None)
        for stream, copy in enumerate(saved, start=1):
            os.dup2(copy, stream)
            os.close(copy)
        os.close(null)


def _place(pose: Pose) -> tuple[list, list]:
    w, x, y, z = pose.quaternion.tolist()
    return pose.position.tolist(), [x, y, z, w]


METHODS = [
    Bullet,
    BulletNoMargin,
    BulletSubsteps,
    BulletNoMarginSubsteps,
    BulletCoacd,
    BulletCoacdSubsteps,
]
