# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Drake's SceneGraph: hulls at one pose or at substeps, by HasCollisions or by signed distance.

A union is one geometry per piece on the same frame. Every call goes through Drake's system
framework (a pose is fixed on an input port and the query port is evaluated), which costs more than
the test itself; Drake's users pay the same cost. Drake 1.51.1 is the last version with wheels for
Python 3.11.
"""

from __future__ import annotations

from itertools import product

import numpy as np

from ofg import Body, Query

from .contract import MissingEngine, Tolerance
from .sampling import Discrete, Substeps
from .units import Normalised


def _drake():
    try:
        import pydrake.geometry
        import pydrake.math
    except ImportError as error:
        raise MissingEngine(
            "drake is not installed; install it with: pip install drake==1.51.1"
        ) from error
    return pydrake


class Drake(Discrete):
    name = "drake"
    engine, imports = "drake", "pydrake"
    configuration = "default"
    bodies = frozenset({"convex", "union"})
    solid = True
    places_b = True
    tolerance = Tolerance(1e-6)  # the tolerance of FCL's libccd, which it calls
    guarantee = "GJK (FCL with libccd) in doubles"

    def ask(self, query_object, ids_a, ids_b) -> bool:
        return query_object.HasCollisions()

    def build(self, query: Query):
        pydrake = _drake()
        geometry, transform = pydrake.geometry, pydrake.math.RigidTransform
        graph = geometry.SceneGraph()
        source = graph.RegisterSource("ofg")
        frame = graph.RegisterFrame(source, geometry.GeometryFrame("a"))
        ids_a = [
            graph.RegisterGeometry(source, frame, g)
            for g in _geometries(pydrake, query.a, "a", transform())
        ]
        frames = [frame]
        if query.motion_b.rests:
            geometries_b = _geometries(pydrake, query.b, "b", transform(query.pose_b.matrix))
            ids_b = [graph.RegisterAnchoredGeometry(source, g) for g in geometries_b]
        else:
            frames.append(graph.RegisterFrame(source, geometry.GeometryFrame("b")))
            geometries_b = _geometries(pydrake, query.b, "b", transform())
            ids_b = [graph.RegisterGeometry(source, frames[1], g) for g in geometries_b]
        for identity in ids_a + ids_b:
            graph.AssignRole(source, identity, geometry.ProximityProperties())
        context = graph.CreateDefaultContext()
        pose_port, query_port = graph.get_source_pose_port(source), graph.get_query_output_port()

        def place(*poses):
            vector = geometry.FramePoseVector()
            for mover, pose in zip(frames, poses):
                vector.set_value(mover, transform(pose.matrix))
            return vector

        def test(at, _keep=graph) -> bool:
            pose_port.FixValue(context, at)
            return self.ask(query_port.Eval(context), ids_a, ids_b)

        return place, test


class DrakeExact(Normalised, Drake):
    name = "drake-exact"
    configuration = "best effort"
    guarantee = "GJK (FCL with libccd) in doubles, in the unit of units.csv, at the origin"


class DrakeExactSubsteps(Substeps, DrakeExact):
    name = "drake-exact-substeps"
    guarantee = "drake-exact at n sampled poses; misses contacts between samples"


class DrakeDistance(Drake):
    name = "drake-distance"
    configuration = "alternative"
    guarantee = "signed distance by GJK/EPA (FCL with libccd) in doubles"

    def ask(self, query_object, ids_a, ids_b) -> bool:
        return any(
            query_object.ComputeSignedDistancePairClosestPoints(a, b).distance < 0
            for a, b in product(ids_a, ids_b)
        )


class DrakeSubsteps(Substeps, Drake):
    name = "drake-substeps"
    guarantee = "drake at n sampled poses; misses contacts between samples"


class DrakeDistanceSubsteps(Substeps, DrakeDistance):
    name = "drake-distance-substeps"
    guarantee = "drake-distance at n sampled poses; misses contacts between samples"


def _geometries(pydrake, body: Body, side: str, at) -> list:
    geometry = pydrake.geometry
    return [
        geometry.GeometryInstance(
            at, geometry.Convex(np.array(p.vertices.T), f"{side}{i}"), f"{side}{i}"
        )
        for i, p in enumerate(body.pieces)
    ]


METHODS = [
    Drake,
    DrakeExact,
    DrakeExactSubsteps,
    DrakeDistance,
    DrakeSubsteps,
    DrakeDistanceSubsteps,
]
