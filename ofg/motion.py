"""How a body moves over one step: it turns about its own origin and translates, both at constant speed."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from .pose import Pose, _vector


@dataclass(frozen=True, eq=False)
class Motion:
    """x(t) = p + t d + Rot(axis/|axis|, angle t) R(q) v for t in [0, 1], from a start pose (q, p).

    displacement: (3,) float64, length. axis: (3,) float64, any non-zero length, fixed in the world. angle: radians over
    the step, any size (2 pi n is n full turns). A Motion() is rest.
    Raises ValueError for numbers that are not finite, or a zero axis with a non-zero angle.
    """

    displacement: np.ndarray = field(default_factory=lambda: np.zeros(3))
    axis: np.ndarray = field(default_factory=lambda: np.array([0.0, 0.0, 1.0]))
    angle: float = 0.0

    def __post_init__(self):
        object.__setattr__(self, "displacement", _vector(self.displacement, 3, "displacement"))
        object.__setattr__(self, "axis", _vector(self.axis, 3, "axis"))
        object.__setattr__(self, "angle", float(self.angle))
        if not np.isfinite(self.angle):
            raise ValueError(f"Motion.angle = {self.angle} is not finite.")
        if self.angle and not self.axis.any():
            raise ValueError("Motion.axis is zero while Motion.angle is not; give the axis of the turn.")

    def pose_at(self, start: Pose, t: float) -> Pose:
        """The pose at time t of a body that starts at `start` (double rounding)."""
        position = start.position + t * self.displacement
        if not self.angle:
            return Pose(start.quaternion, position)
        half = 0.5 * self.angle * t
        turn = np.concatenate([[np.cos(half)], np.sin(half) * self.axis / np.linalg.norm(self.axis)])
        return Pose(_multiply(turn, start.quaternion), position)


def _multiply(p: np.ndarray, q: np.ndarray) -> np.ndarray:
    """Hamilton product of two (w, x, y, z) quaternions."""
    return np.concatenate([[p[0] * q[0] - p[1:] @ q[1:]], p[0] * q[1:] + q[0] * p[1:] + np.cross(p[1:], q[1:])])
