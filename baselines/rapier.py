# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Rapier 3D (parry in float32): overlap, and linear and nonlinear shape casts, on hulls and on
triangle meshes.

A union is Rapier's own compound shape of hulls, or for the mesh methods the triangle soup of all
pieces. All numbers are float32 internally: overlaps are correct to about 1e-6 of the size on boxes
and meshes; for hulls, gaps below 1e-4 are reported as hits. Rapier has no setting that makes it
more accurate; the best effort chooses units and origin, and casts a rotation in legs.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from ofg import Body, Pose, Query

from .contract import Method, MissingEngine, Tolerance, Verdict
from .sampling import Discrete, Substeps
from .units import Normalised

GJK = Tolerance(10 * 2.0**-23)  #: eps_tol() of its GJK: ten machine epsilons of float32


def _rapier():
    try:
        import rapier3d
    except ImportError as error:
        raise MissingEngine(
            "rapier3d is not installed; install it with: pip install rapier3d"
        ) from error
    return rapier3d


class _Hull:
    engine, imports = "rapier3d", "rapier3d"
    precision = "single"
    bodies = frozenset({"convex", "union"})
    solid = True

    def shape(self, body: Body):
        rapier = _rapier()
        hulls = [
            rapier.SharedShape.convex_mesh(np.array(p.vertices), np.array(p.faces))
            for p in body.pieces
        ]
        return (
            hulls[0]
            if body.kind == "convex"
            else rapier.SharedShape.compound([(_place(Pose()), hull) for hull in hulls])
        )


class _Mesh:
    engine, imports = "rapier3d", "rapier3d"
    precision = "single"
    bodies = frozenset({"convex", "union", "mesh"})
    solid = False

    def shape(self, body: Body):
        return _rapier().SharedShape.trimesh(np.array(body.vertices), np.array(body.faces))


class _Overlap(Discrete):
    """QueryPipeline.intersect_shape of A against a world that contains B."""

    configuration = "default"
    tolerance = GJK

    def build(self, query: Query):
        shape, world = self.shape(query.a), _world(self.shape(query.b), query.pose_b)
        pipeline = world.query_pipeline
        found = []

        def stop(collider) -> bool:
            found.append(collider)
            return False

        def test(at, _keep=world) -> bool:
            found.clear()
            pipeline.intersect_shape(at, shape, stop)
            return bool(found)

        return _place, test


class Rapier(_Hull, _Overlap):
    name = "rapier"
    guarantee = "GJK in float32"


class RapierExact(Normalised, Rapier):
    name = "rapier-exact"
    configuration = "best effort"
    guarantee = "GJK in float32, in the unit of units.csv, at the origin"


class RapierExactSubsteps(Substeps, RapierExact):
    name = "rapier-exact-substeps"
    guarantee = "rapier-exact at n sampled poses; misses contacts between samples"


class RapierMesh(_Mesh, _Overlap):
    name = "rapier-mesh"
    guarantee = "triangle pairs in float32; surfaces only"


class RapierSubsteps(Substeps, Rapier):
    name = "rapier-substeps"
    guarantee = "rapier at n sampled poses; misses contacts between samples"


class RapierMeshSubsteps(Substeps, RapierMesh):
    name = "rapier-mesh-substeps"
    guarantee = "rapier-mesh at n sampled poses; misses contacts between samples"


class _Cast(Method):
    """cast_shape for translations, cast_shape_nonlinear for motions. A motion is cast in `legs`
    equal parts of the step.

    A nonlinear cast often ends with the status FAILED and a correct time (0.27650 for cubes that
    meet there); it counts as a hit, as in Rapier's own motion clamping.
    """

    questions = frozenset({"translation", "motion"})
    gives_time = True
    configuration = "default"
    tolerance = GJK
    legs = 1

    def prepare(self, query: Query) -> Callable[[], Verdict]:
        self.refuse(query)
        rapier = _rapier()
        shape, world = self.shape(query.a), _world(self.shape(query.b), query.pose_b)
        pipeline, options = world.query_pipeline, rapier.ShapeCastOptions(max_time_of_impact=1.0)
        motion = query.motion
        velocity = motion.displacement.tolist()
        if query.question == "translation":
            start = _place(query.pose_a)

            def ask(_keep=world) -> Verdict:
                found = pipeline.cast_shape(start, velocity, shape, options)
                return Verdict(True, min(found[1].time_of_impact, 1.0)) if found else Verdict(False)

            return ask

        turn = (
            (motion.angle * motion.axis / np.linalg.norm(motion.axis)).tolist()
            if motion.angle
            else [0.0, 0.0, 0.0]
        )
        n = self.legs
        paths = [
            (
                i / n,
                rapier.NonlinearRigidMotion(
                    start=_place(motion.pose_at(query.pose_a, i / n)),
                    local_center=(0, 0, 0),
                    linvel=velocity,
                    angvel=turn,
                ),
            )
            for i in range(n)
        ]

        def ask_nonlinear(_keep=world) -> Verdict:
            for start, path in paths:
                found = pipeline.cast_shape_nonlinear(path, shape, options, 0.0, 1 / n)
                if found:
                    return Verdict(True, min(start + found[1].time_of_impact, 1.0))
            return Verdict(False)

        return ask_nonlinear


class RapierCast(_Hull, _Cast):
    name = "rapier-cast"
    guarantee = "conservative advancement in float32 (linear: GJK ray cast)"


class RapierCastMesh(_Mesh, _Cast):
    # A nonlinear cast of two meshes takes 2.3 ms for cubes of 12 faces, 64 ms and more for real
    # ones.
    name = "rapier-cast-mesh"
    guarantee = "conservative advancement in float32 per triangle pair; surfaces only"


class _CastInLegs(_Cast):
    # One nonlinear cast missed 24 of 42 hits of bodies that rotate by half a turn beside another; 8
    # legs, or 32, missed none of them.
    configuration = "best effort"
    parameters = {"legs": 8}
    allowed = {"legs": (1, math.inf)}
    cheapest = {"legs": 1}

    def __init__(self, **parameters):
        super().__init__(**parameters)
        self.legs = self.parameters["legs"]


class RapierCastLegs(Normalised, _Hull, _CastInLegs):
    name = "rapier-cast-legs"
    guarantee = "conservative advancement in float32, restarted at each leg"


def _place(pose: Pose) -> tuple[tuple, tuple]:
    w, x, y, z = (pose.quaternion / math.sqrt(pose.quaternion @ pose.quaternion)).tolist()
    return tuple(pose.position.tolist()), (x, y, z, w)


def _world(shape, pose: Pose):
    """A world that contains one fixed body; it must outlive its query pipeline."""
    rapier = _rapier()
    world = rapier.PhysicsWorld()
    handle = world.add_body(rapier.RigidBody.fixed())
    world.add_collider(rapier.Collider.new(shape), handle)
    world.rigid_bodies[handle].position = _place(pose)
    world.detect_collisions()
    world.update_query_pipeline()
    return world


METHODS = [
    Rapier,
    RapierExact,
    RapierExactSubsteps,
    RapierMesh,
    RapierSubsteps,
    RapierMeshSubsteps,
    RapierCast,
    RapierCastMesh,
    RapierCastLegs,
]
