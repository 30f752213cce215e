# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The pose of a body: a rotation and a position."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from . import checks
from .frozen import Frozen


@dataclass(frozen=True, eq=False)
class Pose(Frozen):
    """World point = N(q)/|q|^2 v + p for a body point v.

    quaternion: (4,) float64, (w, x, y, z), any non-zero length: it represents the rotation
    N(q)/|q|^2, which needs no normalisation and is rational in q, so the truth can be exact.
    position: (3,) float64, length unit of the bodies. Range: the largest component of the
    quaternion between 1e-300 and 1e300 in size, positions up to 1e60. Within this range the length
    of a quaternion does not matter. Raises TypeError for values that are not numbers; ValueError
    for a wrong shape, a number that is not finite or out of range, or the zero quaternion.
    """

    quaternion: np.ndarray = field(default_factory=lambda: np.array([1.0, 0.0, 0.0, 0.0]))
    position: np.ndarray = field(default_factory=lambda: np.zeros(3))

    def __post_init__(self) -> None:
        quaternion = checks.vector(self.quaternion, 4, "Pose.quaternion")
        object.__setattr__(self, "quaternion", quaternion)
        object.__setattr__(self, "position", checks.vector(self.position, 3, "Pose.position"))
        if not self.quaternion.any():
            raise ValueError(
                "Pose.quaternion is zero, which is not a rotation; use (1, 0, 0, 0) for none."
            )
        checks.direction(self.quaternion, "Pose.quaternion")
        checks.lengths(self.position, "Pose.position")

    @property
    def rotation(self) -> np.ndarray:
        """(3, 3) float64 rotation matrix, rounded to double."""
        q = near_one(self.quaternion)
        w, x, y, z = q / np.linalg.norm(q)
        return np.array(
            [
                [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
            ]
        )

    @property
    def matrix(self) -> np.ndarray:
        """(4, 4) float64 homogeneous transform."""
        m = np.eye(4)
        m[:3, :3] = self.rotation
        m[:3, 3] = self.position
        return m

    def apply(self, points: np.ndarray) -> np.ndarray:
        """(n, 3) body points -> (n, 3) world points."""
        placed: np.ndarray = checks.points(points, "points") @ self.rotation.T + self.position
        return placed


def near_one(v: np.ndarray) -> np.ndarray:
    """The vector, scaled by a power of two (exactly) so that its largest component is near 1 if
    products of its components could leave the range of doubles. Not for zero.
    """
    largest = np.abs(v).max()
    return v if 1e-50 < largest < 1e50 else np.ldexp(v, -int(np.frexp(largest)[1]))
