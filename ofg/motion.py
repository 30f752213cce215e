# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The motion of a body over one step: rotation about one of its points and translation, both at
constant velocity.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from . import checks
from .frozen import Frozen
from .pose import Pose, near_one


@dataclass(frozen=True, eq=False)
class Motion(Frozen):
    """x(t) = p + R(q) c + t d + Rot(axis/|axis|, angle t) R(q) (v - c) for t in [0, 1], from a
    start pose (q, p).

    displacement: d, (3,) float64, length: of the point c over the step. axis: (3,) float64, any
    non-zero length, fixed in the world. angle: radians over the step, any size (2 pi n is n full
    turns). about: c, (3,) float64, the point of the body about which it rotates, in the body's
    frame; by default the origin of that frame. Motion() is rest. Range: displacement and about up
    to 1e60, angles up to 1e9, the largest component of the axis of a rotation between 1e-300 and
    1e300 in size. Raises TypeError for values that are not numbers; ValueError for numbers that are
    not finite or out of range, or a zero axis with a non-zero angle.
    """

    displacement: np.ndarray = field(default_factory=lambda: np.zeros(3))
    axis: np.ndarray = field(default_factory=lambda: np.array([0.0, 0.0, 1.0]))
    angle: float = 0.0
    about: np.ndarray = field(default_factory=lambda: np.zeros(3))

    def __post_init__(self) -> None:
        for name in ("displacement", "axis", "about"):
            vector = checks.vector(getattr(self, name), 3, f"Motion.{name}")
            object.__setattr__(self, name, vector)
        object.__setattr__(self, "angle", checks.number(self.angle, "Motion.angle"))
        checks.lengths(self.displacement, "Motion.displacement")
        checks.lengths(self.about, "Motion.about")
        checks.angle(self.angle, "Motion.angle")
        if self.angle and not self.axis.any():
            raise ValueError(
                "Motion.axis is zero but Motion.angle is not; give the axis of rotation."
            )
        if self.angle:
            checks.direction(self.axis, "Motion.axis")

    @classmethod
    def degrees(
        cls,
        displacement: ArrayLike = (0, 0, 0),
        axis: ArrayLike = (0, 0, 1),
        angle: float = 0.0,
        about: ArrayLike = (0, 0, 0),
    ) -> Motion:
        """A motion with its angle in degrees, rounded to double radians."""
        vectors = {"displacement": displacement, "axis": axis, "about": about}
        radians = math.radians(checks.number(angle, "angle"))
        return cls(
            angle=radians, **{k: checks.vector(v, 3, f"Motion.{k}") for k, v in vectors.items()}
        )

    @classmethod
    def between(cls, pose0: Pose, pose1: Pose, about: ArrayLike = (0, 0, 0)) -> Motion:
        """The motion at constant velocity from one pose to another, as FCL, Bullet and Box2D define
        it; in double rounding.

        The body rotates the shorter way, by at most half a turn, about its point `about`, which
        moves on a straight line.
        """
        checks.pose(pose0, "pose0")
        checks.pose(pose1, "pose1")
        about = checks.vector(about, 3, "about")
        q0, q1 = (near_one(p.quaternion) for p in (pose0, pose1))
        turn = _multiply(q1, q0 * [1, -1, -1, -1])
        turn = -turn if turn[0] < 0 else turn
        sine = float(np.linalg.norm(turn[1:]))
        displacement = pose1.apply(about[None])[0] - pose0.apply(about[None])[0]
        if sine == 0:
            return cls(displacement)
        return cls(displacement, turn[1:] / sine, 2 * math.atan2(sine, turn[0]), about)

    @property
    def rests(self) -> bool:
        """Whether the body neither translates nor rotates."""
        return not (self.displacement.any() or self.angle)

    def pose_at(self, start: Pose, t: float) -> Pose:
        """The pose at time t of a body that starts at `start` (double rounding)."""
        checks.pose(start, "start")
        t = checks.number(t, "t")
        position = start.position + t * self.displacement
        if not self.angle:
            return Pose(start.quaternion, position)
        half = 0.5 * self.angle * t
        axis = near_one(self.axis)
        turn = Pose(
            np.concatenate([[math.cos(half)], math.sin(half) * axis / np.linalg.norm(axis)])
        )
        if self.about.any():
            arm = start.rotation @ self.about
            position = position + (arm - turn.rotation @ arm)
        return Pose(_multiply(turn.quaternion, near_one(start.quaternion)), position)


def _multiply(p: np.ndarray, q: np.ndarray) -> np.ndarray:
    """Hamilton product of two (w, x, y, z) quaternions."""
    return np.concatenate(
        [[p[0] * q[0] - p[1:] @ q[1:]], p[0] * q[1:] + q[0] * p[1:] + np.cross(p[1:], q[1:])]
    )
