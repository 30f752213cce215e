# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""MuJoCo: signed distance of convex geoms at one pose or at substeps, and the sweep of its
speculative contacts.

A mesh geom is its convex hull, so closed meshes are refused except by the -coacd methods, which
decompose them. A union is one geom per piece, with all pairs tested in a plain loop. MuJoCo stores
mesh vertices as float32 after moving them to their inertia frame: an error of 1e-7 of the size,
which rounding the input does not remove, and which is not hidden here. It rejects flat meshes.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import product

import numpy as np

from ofg import Body, Pose, Query

from .contract import Method, MissingEngine, Tolerance, Unsupported, Verdict
from .pieces import Decomposed
from .sampling import Discrete, Substeps
from .units import Normalised, normalised

DISTMAX = 0  # only the sign is used; with a large value libccd is wrong by 0.1 to 1 on tetrahedra


def _mujoco():
    try:
        import mujoco
    except ImportError as error:
        raise MissingEngine(
            "mujoco is not installed; install it with: pip install mujoco"
        ) from error
    return mujoco


class Mujoco(Discrete):
    """mj_geomDistance < 0 with the default options: MuJoCo's own convex collision detection."""

    name = "mujoco"
    engine, imports = "mujoco", "mujoco"
    precision = "single"  # computes in doubles on vertices stored as float32
    configuration = "default"
    bodies = frozenset({"convex", "union"})
    solid = True
    places_b = True
    tolerance = Tolerance(1e-6)  # ccd_tolerance
    guarantee = (
        "GJK/EPA in doubles on vertices stored as float32; ccd_tolerance 1e-6, 35 iterations"
    )

    def options(self, mujoco, spec) -> None:
        """Apply this configuration's changes to the model."""

    def build(self, query: Query):
        mujoco = _mujoco()
        spec = mujoco.MjSpec()
        self.options(mujoco, spec)
        for side, body in (("a", query.a), ("b", query.b)):
            _add_geoms(mujoco, spec, spec.worldbody.add_body(name=side, mocap=True), side, body)
        model, data = _compile(mujoco, spec)
        pairs = _pairs(query.a, query.b)
        data.mocap_pos[1], data.mocap_quat[1] = _place(query.pose_b)
        positions, turns = data.mocap_pos, data.mocap_quat
        if query.motion_b.rests:  # only A's are written at each call
            positions, turns = positions[:1], turns[:1]
        distance, kinematics = mujoco.mj_geomDistance, mujoco.mj_kinematics

        def place(*poses: Pose) -> tuple[np.ndarray, np.ndarray]:
            return tuple(map(np.array, zip(*map(_place, poses))))

        def test(at) -> bool:
            positions[:], turns[:] = at
            kinematics(model, data)
            return any(distance(model, data, a, b, DISTMAX, None) < 0 for a, b in pairs)

        return place, test


class MujocoExact(Normalised, Mujoco):
    # The compiler rejects bodies of 1e-6, and of 1e6 beside 1, in other units.
    name = "mujoco-exact"
    configuration = "best effort"
    guarantee = (
        "GJK/EPA in doubles on vertices stored as float32; ccd_tolerance 1e-12, 1000 iterations"
    )
    own_tolerance = Tolerance(1e-12)

    def options(self, mujoco, spec) -> None:
        spec.option.ccd_tolerance = 1e-12
        spec.option.ccd_iterations = 1000


class MujocoLibccd(Mujoco):
    name = "mujoco-libccd"
    configuration = "alternative"
    guarantee = "GJK/MPR by libccd on vertices stored as float32; ccd_tolerance 1e-6, 35 iterations"

    def options(self, mujoco, spec) -> None:
        spec.option.disableflags |= mujoco.mjtDisableBit.mjDSBL_NATIVECCD


class MujocoSubsteps(Substeps, Mujoco):
    name = "mujoco-substeps"
    guarantee = "mujoco at n sampled poses; misses contacts between samples"


class MujocoExactSubsteps(Substeps, MujocoExact):
    name = "mujoco-exact-substeps"
    guarantee = "mujoco-exact at n sampled poses; misses contacts between samples"


class MujocoCoacd(Decomposed, MujocoExact):
    name = "mujoco-coacd"
    guarantee = (
        "mujoco-exact on the pieces of CoACD at threshold 0.05, which only approximate the mesh"
    )


class MujocoCoacdSubsteps(Substeps, MujocoCoacd):
    name = "mujoco-coacd-substeps"
    guarantee = "mujoco-coacd at n sampled poses; misses contacts between samples"


class MujocoSpeculative(Normalised, Method):
    """The sweep of mjENBL_SPECULATIVE over one step, with the time of impact recovered from the
    contact it makes.

    MuJoCo sweeps only geoms that travel farther than their smallest half-extent; slower ones get
    only the discrete test of the end pose, as in a stepping loop, and the time 1. The time is not
    exposed: a speculative contact is given the distance at which the solver would stop the body on
    the surface. With stiffness k and damping b per step that is dist = -(1 - t - b) / k v, so two
    settings of solref, b = 0 and b = 1, give (t - 1) v and t v, whose quotient determines t. The
    impedance must be constant (solimp) so that b has the value that was set. Its advancement stops
    at 2 % of the start distance, so the time is early by that share of the gap. A geom whose centre
    is not the body's origin moves on an arc, which MuJoCo approximates by a chord.
    """

    name = "mujoco-speculative"
    engine, imports = "mujoco", "mujoco"
    precision = "single"  # computes in doubles on vertices stored as float32
    configuration = "best effort"
    questions = frozenset({"translation", "motion"})
    bodies = frozenset({"convex", "union"})
    solid = True
    gives_time = True
    # of the start distance, which the path is at least as long as
    tolerance = Tolerance(step=0.02, sides="alarms")
    guarantee = (
        "conservative advancement to 2 % of the start distance: hits closer than that are "
        "reported early; slow movers are tested at the end only"
    )

    IMPEDANCE = 0.9999  # the largest value that MuJoCo accepts

    def prepare(self, query: Query) -> Callable[[], Verdict]:
        self.refuse(query)
        query = normalised(query, self.length)
        mujoco = _mujoco()
        spec = mujoco.MjSpec()
        spec.option.timestep = 1
        spec.option.gravity = [0, 0, 0]
        spec.option.enableflags |= mujoco.mjtEnableBit.mjENBL_SPECULATIVE
        contact = {"solimp": [self.IMPEDANCE, self.IMPEDANCE, 1, 0.5, 2]}
        moving = spec.worldbody.add_body(name="a")
        moving.add_freejoint()
        _add_geoms(mujoco, spec, moving, "a", query.a, **contact)
        _add_geoms(
            mujoco, spec, spec.worldbody.add_body(name="b", mocap=True), "b", query.b, **contact
        )
        model, data = _compile(mujoco, spec)
        data.mocap_pos[0], data.mocap_quat[0] = _place(query.pose_b)
        start = np.concatenate(_place(query.pose_a))
        end = np.concatenate(_place(query.motion.pose_at(query.pose_a, 1)))
        # angular: in A's frame
        velocity = np.concatenate(
            [query.motion.displacement, query.pose_a.rotation.T @ _turn(query)]
        )
        pairs = _pairs(query.a, query.b)

        def detect(damping: float) -> np.ndarray:
            model.geom_solref[:] = (-1, -damping)
            mujoco.mj_kinematics(model, data)
            mujoco.mj_comPos(model, data)
            mujoco.mj_collision(model, data)
            return np.array(data.contact.dist)

        def ask() -> Verdict:
            data.qpos[:], data.qvel[:] = start, velocity
            undamped = detect(0)
            if undamped.size:
                damped = detect(1)
                speculative = damped != undamped
                if (
                    not speculative.all()
                ):  # a real contact does not depend on solref: the bodies touch at the start
                    return Verdict(True, 0.0)
                times = damped / (damped - undamped)
                return Verdict(True, float(np.clip(times.min(), 0, 1)))
            data.qpos[:] = end
            mujoco.mj_kinematics(model, data)
            hit = any(
                mujoco.mj_geomDistance(model, data, a, b, DISTMAX, None) < 0 for a, b in pairs
            )
            return Verdict(True, 1.0) if hit else Verdict(False)

        return ask


def _add_geoms(mujoco, spec, owner, side: str, body: Body, **geom) -> None:
    for i, piece in enumerate(body.pieces):
        name = f"{side}{i}"
        spec.add_mesh(
            name=name,
            uservert=piece.vertices.ravel().tolist(),
            userface=piece.faces.ravel().tolist(),
        )
        owner.add_geom(type=mujoco.mjtGeom.mjGEOM_MESH, meshname=name, **geom)


def _compile(mujoco, spec):
    try:
        model = spec.compile()
    except ValueError as error:
        raise Unsupported(
            f"mujoco cannot compile a geom of these bodies: {str(error).strip().splitlines()[0]}"
        ) from error
    return model, mujoco.MjData(model)


def _pairs(a: Body, b: Body) -> list[tuple[int, int]]:
    """Pairs of geoms, which are numbered with A's pieces first."""
    return list(product(range(len(a.pieces)), range(len(a.pieces), len(a.pieces) + len(b.pieces))))


def _place(pose: Pose) -> tuple[np.ndarray, np.ndarray]:
    return pose.position, pose.quaternion / np.linalg.norm(pose.quaternion)


def _turn(query: Query) -> np.ndarray:
    motion = query.motion
    return motion.angle * motion.axis / np.linalg.norm(motion.axis) if motion.angle else np.zeros(3)


METHODS = [
    Mujoco,
    MujocoExact,
    MujocoLibccd,
    MujocoSubsteps,
    MujocoExactSubsteps,
    MujocoCoacd,
    MujocoCoacdSubsteps,
    MujocoSpeculative,
]
