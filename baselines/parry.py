# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""parry in float64 through py-parry3d: hulls and triangle meshes, at one pose or at substeps in one
batched call.

A union is parry's own group of hulls, or for the mesh methods the triangle soup of all pieces. One
thread only: the comparison is of algorithms, and with more threads the "first" pose of a batch need
not be the first.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np

from ofg import Body, Pose, Query

from .contract import MissingEngine, Tolerance, Unsupported, Verdict
from .sampling import Discrete, Substeps
from .units import Normalised

PAIR = [("a", "b", 0.0)]


@cache
def _parry():
    try:
        from py_parry3d import _internal
    except ImportError as error:
        raise MissingEngine(
            "py-parry3d is not installed; install it with: pip install py-parry3d"
        ) from error
    # must come before any other call, including that for the number of threads
    _internal.set_num_threads(1)
    return _internal


class Parry(Discrete):
    # Hulls are reported as hits at gaps of 1e-9 and less on some rotated cubes; axis-aligned ones
    # are correct down to 1e-12.
    name = "parry"
    engine, imports = "py-parry3d", "py_parry3d"
    configuration = "default"
    bodies = frozenset({"convex", "union"})
    solid = True
    places_b = True
    tolerance = Tolerance(10 * 2.0**-52)  # eps_tol() of its GJK: ten machine epsilons
    guarantee = "GJK in doubles"

    def shapes(self, body: Body) -> list:
        try:
            return [
                _parry().ConvexHull.from_mesh(np.array(p.vertices), p.faces.astype(np.uint32))
                for p in body.pieces
            ]
        except ValueError as error:
            raise Unsupported(f"parry cannot make a hull of body '{body.name}': {error}") from error

    def world(self, query: Query):
        group, a, b = _parry().CollisionGroup, self.shapes(query.a), self.shapes(query.b)
        rests = query.motion_b.rests
        fixed = {"is_static": True, "transform": query.pose_b.matrix} if rests else {}
        return _parry().CollisionWorld([group("a", a), group("b", b, **fixed)])

    def build(self, query: Query):
        check = self.world(query).check

        def place(*poses: Pose) -> dict:
            return {name: pose.matrix for name, pose in zip("ab", poses)}

        return place, lambda at: check(at, PAIR)[0]


class ParryMesh(Parry):
    name = "parry-mesh"
    bodies = frozenset({"convex", "union", "mesh"})
    solid = False
    guarantee = "triangle pairs in doubles; surfaces only"

    def shapes(self, body: Body) -> list:
        return [_parry().TriMesh(np.array(body.vertices), body.faces.astype(np.uint32))]


class _Batch(Substeps):
    """All n poses in one call, which stops at the first that hits."""

    def build(self, query: Query):
        return None, self.world(query).check_any

    def asker(self, query: Query, place, check_any) -> Callable[[], Verdict]:
        n = self.parameters["n"]
        sides = zip(*(self.poses(query, i / n) for i in range(1, n + 1)))
        poses = {name: np.stack([pose.matrix for pose in side]) for name, side in zip("ab", sides)}

        def ask() -> Verdict:
            first = check_any(poses, PAIR)
            return Verdict(False) if first is None else Verdict(True, (first + 1) / n)

        return ask


class ParryExact(Normalised, Parry):
    name = "parry-exact"
    configuration = "best effort"
    guarantee = "GJK in doubles, in the unit of units.csv, at the origin"


class ParryExactSubsteps(_Batch, ParryExact):
    name = "parry-exact-substeps"
    guarantee = "parry-exact at n sampled poses; misses contacts between samples"


class ParrySubsteps(_Batch, Parry):
    name = "parry-substeps"
    guarantee = "parry at n sampled poses; misses contacts between samples"


class ParryMeshSubsteps(_Batch, ParryMesh):
    name = "parry-mesh-substeps"
    guarantee = "parry-mesh at n sampled poses; misses contacts between samples"


METHODS = [Parry, ParryExact, ParryExactSubsteps, ParryMesh, ParrySubsteps, ParryMeshSubsteps]
