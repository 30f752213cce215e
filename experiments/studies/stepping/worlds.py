# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""One scene in one engine: created, stepped and observed.

A world has `dt` (the engine's own default), `step()`, `progress()` and `rate()` (progress per
second, as the engine reports it).
"""

from __future__ import annotations

import math
from typing import Protocol

import numpy as np

from baselines import registry
from baselines.bullet import connection
from ofg import Body, Motion, Pose, Query

from .scene import ROD_INERTIA, Scene


class World(Protocol):
    def step(self) -> None: ...
    def progress(self) -> float: ...
    def rate(self) -> float: ...


class BulletWorld:
    """pybullet: maximal: rigid bodies instead of the default multibodies. ccd:
    ccdSweptSphereRadius, as a share of the least half-extent.
    """

    engine = "pybullet"
    dt = 1 / 240
    cap = math.pi / 4  # Bullet rotates no body farther in a step

    def __init__(
        self,
        scene: Scene,
        rate: float,
        start: float,
        attitude: np.ndarray,
        maximal: bool = False,
        ccd: float = 0.0,
    ):
        self.bullet, self.client = p, c = connection()
        p.resetSimulation(physicsClientId=c)
        p.setTimeStep(self.dt, physicsClientId=c)
        shape = (
            {"shapeType": p.GEOM_SPHERE, "radius": scene.half[0]}
            if scene.mover == "ball"
            else {"shapeType": p.GEOM_BOX, "halfExtents": scene.half}
        )
        mover = p.createCollisionShape(**shape, physicsClientId=c)
        fixed = p.createCollisionShape(p.GEOM_BOX, halfExtents=scene.obstacle, physicsClientId=c)
        p.createMultiBody(
            0,
            fixed,
            basePosition=[scene.reach, 0, 0],
            useMaximalCoordinates=maximal,
            physicsClientId=c,
        )
        position, turn, velocity, spin = _initial(scene, rate, start, attitude)
        self.turns = scene.turns
        self.body = b = p.createMultiBody(
            1,
            mover,
            basePosition=position,
            baseOrientation=np.roll(turn, -1).tolist(),
            useMaximalCoordinates=maximal,
            physicsClientId=c,
        )
        # Velocities above 100 are clipped unless maxJointVelocity is raised first.
        p.changeDynamics(
            b, -1, linearDamping=0, angularDamping=0, maxJointVelocity=1e9, physicsClientId=c
        )
        if scene.turns:
            # Without the mass, a body in maximal coordinates gets mass 0, and its position becomes
            # NaN.
            p.changeDynamics(
                b, -1, mass=1, localInertiaDiagonal=[ROD_INERTIA] * 3, physicsClientId=c
            )
        if ccd:
            p.changeDynamics(b, -1, ccdSweptSphereRadius=ccd * min(scene.half), physicsClientId=c)
        p.resetBaseVelocity(b, velocity, spin, physicsClientId=c)

    def step(self) -> None:
        self.bullet.stepSimulation(physicsClientId=self.client)

    def progress(self) -> float:
        position, (x, y, z, w) = self.bullet.getBasePositionAndOrientation(
            self.body, physicsClientId=self.client
        )
        return _angle((w, x, y, z)) if self.turns else position[0]

    def rate(self) -> float:
        linear, angular = self.bullet.getBaseVelocity(self.body, physicsClientId=self.client)
        return angular[2] if self.turns else linear[0]


class MujocoWorld:
    """margin: of both geoms. speculative: mjENBL_SPECULATIVE. stiff: solref of two time steps,
    the minimum in MuJoCo.
    """

    engine = "mujoco"
    dt = 0.002
    cap = math.inf

    def __init__(
        self,
        scene: Scene,
        rate: float,
        start: float,
        attitude: np.ndarray,
        margin: float = 0.0,
        speculative: bool = False,
        stiff: bool = False,
    ):
        import mujoco

        self.mujoco, self.turns = mujoco, scene.turns
        spec = mujoco.MjSpec()
        spec.option.gravity = [0, 0, 0]
        if speculative:
            spec.option.enableflags |= mujoco.mjtEnableBit.mjENBL_SPECULATIVE
        box = mujoco.mjtGeom.mjGEOM_BOX
        spec.worldbody.add_geom(
            type=box, size=scene.obstacle, pos=[scene.reach, 0, 0], margin=margin
        )
        body = spec.worldbody.add_body()
        body.add_freejoint()
        body.add_geom(
            type=mujoco.mjtGeom.mjGEOM_SPHERE if scene.mover == "ball" else box,
            size=scene.half,
            margin=margin,
            mass=1,
        )
        if scene.turns:
            body.explicitinertial, body.mass, body.inertia, body.ipos = (
                True,
                1,
                [ROD_INERTIA] * 3,
                [0, 0, 0],
            )
        self.model = spec.compile()
        if stiff:
            self.model.geom_solref[:] = 2 * self.dt, 1
        self.data = mujoco.MjData(self.model)
        position, turn, velocity, spin = _initial(scene, rate, start, attitude)
        self.data.qpos[:] = [*position, *turn]
        self.data.qvel[:] = [*velocity, *spin]  # the spin is about z, the same in the body's frame

    def step(self) -> None:
        self.mujoco.mj_step(self.model, self.data)

    def progress(self) -> float:
        return _angle(self.data.qpos[3:]) if self.turns else float(self.data.qpos[0])

    def rate(self) -> float:
        return float(self.data.qvel[5] if self.turns else self.data.qvel[0])


class RapierWorld:
    """ccd: ccd_enabled. soft: soft_ccd_prediction, in travels of a step."""

    engine = "rapier3d"
    dt = 1 / 60
    cap = math.inf

    def __init__(
        self,
        scene: Scene,
        rate: float,
        start: float,
        attitude: np.ndarray,
        ccd: bool = False,
        soft: float = 0.0,
    ):
        import rapier3d as rapier

        self.turns = scene.turns
        self.world = world = rapier.PhysicsWorld()
        world.gravity = (0, 0, 0)
        world.integration_parameters.dt = self.dt
        fixed = world.add_body(rapier.RigidBody.fixed())
        world.rigid_bodies[fixed].position = ((scene.reach, 0, 0), (0, 0, 0, 1))
        world.add_collider(rapier.Collider.cuboid(*scene.obstacle), fixed)
        self.handle = world.add_body(rapier.RigidBody.dynamic())
        density = 1 / (8 * math.prod(scene.half))
        collider = (
            rapier.Collider.ball(scene.half[0])
            if scene.mover == "ball"
            else rapier.Collider.cuboid(*scene.half)
        )
        world.add_collider(collider.density(0.0 if scene.turns else density), self.handle)
        position, turn, velocity, spin = _initial(scene, rate, start, attitude)
        body = self.body
        if scene.turns:
            properties = rapier.MassProperties((0, 0, 0), 1.0, (ROD_INERTIA,) * 3)
            body.set_additional_mass_properties(properties, True)
            body.recompute_mass_properties_from_colliders(world.colliders)
            body.allow_fast_rotation = True
        body.position = (tuple(position), tuple(np.roll(turn, -1).tolist()))
        body.linvel, body.angvel = velocity, spin
        body.ccd_enabled = ccd
        body.soft_ccd_prediction = soft * rate * self.dt * (scene.reach or 1.0)

    @property
    def body(self):
        return self.world.rigid_bodies[self.handle]

    def step(self) -> None:
        self.world.step()

    def progress(self) -> float:
        body = self.body
        if not self.turns:
            return body.translation.x
        q = body.rotation
        return _angle((q.w, q.i, q.j, q.k))

    def rate(self) -> float:
        return self.body.angvel.z if self.turns else self.body.linvel.x


class KinematicWorld:
    """A plain loop: the body moves freely until the method reports that the next step hits the
    obstacle, and stops there.
    """

    dt = 1.0
    cap = math.inf

    def __init__(self, scene: Scene, rate: float, start: float, attitude: np.ndarray, method: str):
        (self.method,) = registry.make(method)
        self.engine = self.method.engine
        self.scene, self.at, self.speed = scene, start, rate
        self.mover, self.obstacle = _body(scene.mover, scene.half), _body("box", scene.obstacle)
        self.attitude = attitude
        self.queue = []

    def prepare(self, steps: int) -> None:
        """All queries of an unhindered run: the build per body is not part of the cost of a
        step.
        """
        scene, still = self.scene, Pose(position=(self.scene.reach, 0, 0))
        question, motion = (
            ("motion", Motion(axis=(0, 0, 1), angle=self.speed))
            if scene.turns
            else ("translation", Motion((self.speed, 0, 0)))
        )
        for i in range(steps):
            position, turn, _, _ = _initial(
                scene, self.speed, self.at + i * self.speed, self.attitude
            )
            at = Pose(turn, position)
            query = Query(question, self.mover, self.obstacle, at, still, motion)
            self.queue.append(self.method.ready(query))
        self.queue.reverse()

    def step(self) -> None:
        if not self.speed:
            return
        verdict = self.queue.pop()()
        if verdict.hit:
            self.at += self.speed * (0.0 if math.isnan(verdict.time) else verdict.time)
            self.speed = 0.0
        else:
            self.at += self.speed

    def progress(self) -> float:
        return self.at

    def rate(self) -> float:
        return self.speed


def _initial(
    scene: Scene, rate: float, start: float, attitude: np.ndarray
) -> tuple[list, list, list, list]:
    """Position, attitude (w, x, y, z), velocity and spin at this progress."""
    if scene.turns:
        return (
            [0.0, 0.0, 0.0],
            [math.cos(start / 2), 0.0, 0.0, math.sin(start / 2)],
            [0.0, 0.0, 0.0],
            [0.0, 0.0, rate],
        )
    return [start, 0.0, 0.0], attitude.tolist(), [rate, 0.0, 0.0], [0.0, 0.0, 0.0]


def _angle(q) -> float:
    """Turn about z of a (w, x, y, z) quaternion, in (-pi, pi]."""
    w, x, y, z = q
    return math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))


def _body(kind: str, half) -> Body:
    if kind == "ball":
        import trimesh

        return Body.convex(trimesh.creation.icosphere(1, half[0]).vertices, "ball")
    corners = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
    return Body.convex(corners * half, "box")
