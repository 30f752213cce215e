"""Where a body stands: a rotation and a position."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np


@dataclass(frozen=True, eq=False)
class Pose:
    """World point = N(q)/|q|^2 v + p for a body point v.

    quaternion: (4,) float64, (w, x, y, z), any non-zero length: the rotation it stands for is N(q)/|q|^2, which needs no
    normalisation and is rational in q, so the truth can be exact.
    position: (3,) float64, length unit of the bodies.
    Raises ValueError for a wrong shape, a number that is not finite, or the zero quaternion.
    """

    quaternion: np.ndarray = field(default_factory=lambda: np.array([1.0, 0.0, 0.0, 0.0]))
    position: np.ndarray = field(default_factory=lambda: np.zeros(3))

    def __post_init__(self):
        object.__setattr__(self, "quaternion", _vector(self.quaternion, 4, "quaternion"))
        object.__setattr__(self, "position", _vector(self.position, 3, "position"))
        if not self.quaternion.any():
            raise ValueError("Pose.quaternion is zero, which is no rotation; use (1, 0, 0, 0) for none.")

    @property
    def rotation(self) -> np.ndarray:
        """(3, 3) float64 rotation matrix, rounded to double."""
        w, x, y, z = self.quaternion / np.linalg.norm(self.quaternion)
        return np.array([
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ])

    @property
    def matrix(self) -> np.ndarray:
        """(4, 4) float64 homogeneous transform."""
        m = np.eye(4)
        m[:3, :3] = self.rotation
        m[:3, 3] = self.position
        return m

    def apply(self, points: np.ndarray) -> np.ndarray:
        """(n, 3) body points -> (n, 3) world points."""
        return np.asarray(points, float) @ self.rotation.T + self.position


def _vector(value, size: int, name: str) -> np.ndarray:
    v = np.array(value, dtype=np.float64)
    if v.shape != (size,):
        raise ValueError(f"{name} must have shape ({size},), not {v.shape}.")
    if not np.isfinite(v).all():
        raise ValueError(f"{name} = {v} holds a number that is not finite; every component must be a finite number.")
    v.setflags(write=False)
    return v
