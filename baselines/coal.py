# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Coal 3 (formerly hpp-fcl): convex and mesh overlap at one pose or at substeps. It has no
continuous test.

Convex methods test a union in a plain loop over all pairs of its pieces; mesh methods use the
triangle soup of all pieces. Wrong answers on 100 pairs of cubes face to face, rotated together, at
gaps of (1e-4 1e-6 1e-9 1e-12 -1e-12 -1e-9 -1e-6 -1e-4): convex, default 0 0 0 32 25 35 35 0;
convex, 1e-12 0 0 0 32 0 0 0 0; mesh, default 0 32 100 100 0 0 0 0; mesh, 1e-12 45 49 49 83 0 0 0 0.
A smaller tolerance thus does not improve meshes, which keep the default.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import product

import numpy as np

from ofg import Body, Pose, Query

from .contract import MissingEngine, Tolerance
from .sampling import Discrete, Substeps
from .units import Normalised


def _coal():
    try:
        import coal
    except ImportError as error:
        raise MissingEngine("coal is not installed; install it with: pip install coal") from error
    return coal


class CoalConvex(Discrete):
    """coal.collide with a default CollisionRequest(): contacts are computed, tolerances are
    1e-6.
    """

    name = "coal-convex"
    engine, imports = "coal", "coal"
    configuration = "default"
    bodies = frozenset({"convex", "union"})
    solid = True
    places_b = True
    tolerance = Tolerance(1e-6)  # gjk_tolerance and epa_tolerance of a default request
    guarantee = "GJK/EPA in doubles, tolerance 1e-6"

    def shapes(self, coal, body: Body) -> list:
        return [coal.Convex(*_arrays(coal, piece)) for piece in body.pieces]

    def ask_pair(self, coal, a, b) -> Callable:
        """Test one pair of shapes: poses of A and B -> overlap."""
        request = coal.CollisionRequest()

        def ask(at_a, at_b) -> bool:
            return coal.collide(a, at_a, b, at_b, request, coal.CollisionResult()) > 0

        return ask

    def build(self, query: Query):
        coal = _coal()
        pairs = product(self.shapes(coal, query.a), self.shapes(coal, query.b))
        asks = [self.ask_pair(coal, a, b) for a, b in pairs]

        def place(a: Pose, b: Pose = query.pose_b):
            return _place(a), _place(b)

        return place, lambda at: any(ask(*at) for ask in asks)


class CoalConvexExact(Normalised, CoalConvex):
    """A prepared ComputeCollision without contacts, tolerances 1e-12 (1e-14 gave a wrong sign)."""

    name = "coal-convex-exact"
    configuration = "best effort"
    guarantee = "GJK/EPA in doubles, tolerance 1e-12"
    own_tolerance = Tolerance(1e-12)

    def ask_pair(self, coal, a, b) -> Callable:
        collide, result = coal.ComputeCollision(a, b), coal.CollisionResult()
        request = coal.CollisionRequest(coal.CollisionRequestFlag.NO_REQUEST, 1)
        request.gjk_tolerance = request.epa_tolerance = 1e-12
        request.gjk_max_iterations = request.epa_max_iterations = 1000
        shapes = a, b  # ComputeCollision keeps bare pointers to them

        def ask(at_a, at_b, _keep=shapes) -> bool:
            result.clear()
            return collide(at_a, at_b, request, result) > 0

        return ask


class CoalMesh(CoalConvex):
    name = "coal-mesh"
    bodies = frozenset({"convex", "union", "mesh"})
    solid = False
    guarantee = "triangle pairs by GJK in doubles, tolerance 1e-6; surfaces only"

    def shapes(self, coal, body: Body) -> list:
        model = coal.BVHModelOBBRSS()
        model.beginModel(len(body.faces), len(body.vertices))
        model.addVertices(np.array(body.vertices))
        model.addTriangles(body.faces.astype(np.int64))
        model.endModel()
        return [model]


class CoalConvexSubsteps(Substeps, CoalConvex):
    name = "coal-convex-substeps"
    guarantee = "coal-convex at n sampled poses; misses contacts between samples"


class CoalConvexExactSubsteps(Substeps, CoalConvexExact):
    name = "coal-convex-exact-substeps"
    guarantee = "coal-convex-exact at n sampled poses; misses contacts between samples"


class CoalMeshSubsteps(Substeps, CoalMesh):
    name = "coal-mesh-substeps"
    guarantee = "coal-mesh at n sampled poses; misses contacts between samples"


def _arrays(coal, body: Body) -> tuple:
    points, triangles = coal.StdVec_Vec3s(), coal.StdVec_Triangle()
    points.extend(list(np.array(body.vertices)))
    triangles.extend([coal.Triangle(*map(int, face)) for face in body.faces])
    return points, triangles


def _place(pose: Pose):
    return _coal().Transform3s(pose.rotation, np.array(pose.position))


METHODS = [
    CoalConvex,
    CoalConvexExact,
    CoalMesh,
    CoalConvexSubsteps,
    CoalConvexExactSubsteps,
    CoalMeshSubsteps,
]
