# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The scenes: a mover that translates or rotates towards an obstacle, and when it has passed."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

#: per step, in thicknesses of the obstacle
TRAVELS = (
    0.05,
    0.1,
    0.25,
    0.5,
    1.0,
    2.0,
    5.0,
    10.0,
    20.0,
    50.0,
    100.0,
)


@dataclass(frozen=True)
class Scene:
    """A free body without gravity, and a fixed box about the origin or, for a rod, on its circle.

    mover: "ball" or "box". half: half-extents of the mover (a ball's radius thrice). obstacle:
    half-extents of the fixed box. thickness: of the obstacle along the path: the unit of travel.
    reach: 0 for a body that flies along x at a wall; else the mover turns about z, and the obstacle
    stands at x = reach. contact: progress before which mover and obstacle cannot touch. Progress is
    the centre's x, or the angle; the obstacle is at 0.
    """

    name: str
    mover: str
    half: tuple[float, float, float]
    obstacle: tuple[float, float, float]
    thickness: float
    contact: float
    reach: float = 0.0

    @property
    def turns(self) -> bool:
        return self.reach > 0

    def per_step(self, travel: float) -> float:
        """Length, or angle, per step of `travel` thicknesses."""
        return travel * self.thickness / (self.reach or 1.0)

    def start(self, travel: float, phase: float) -> float:
        """Progress at the start: a free step and a random part of a second step before contact
        is possible.
        """
        return -self.contact - (1 + phase) * self.per_step(travel)

    def steps(self, travel: float, cap: float = math.inf) -> int:
        """Steps after which an unhindered mover is past the obstacle, plus three. cap: the
        largest rotation of a body that an engine makes per step.
        """
        step = min(self.per_step(travel), cap) if self.turns else self.per_step(travel)
        return math.ceil((2 * self.contact + 3 * self.per_step(travel)) / step) + 3


WALL = (0.01, 2.0, 2.0)
SCENES = (
    Scene("ball at a wall", "ball", (0.1, 0.1, 0.1), WALL, 0.02, 0.11 + 1e-3),
    Scene("box at a wall", "box", (0.1, 0.1, 0.1), WALL, 0.02, 0.1 * math.sqrt(3) + 0.01 + 1e-3),
    # 100 thicknesses are 1.25 rad, so rotations are never ambiguous and no rod starts with its
    # other end at the post. Its half-thickness is 0.01 and the post's corner is 0.0035 off the
    # post's middle: they meet at 0.034 rad.
    Scene("rod at a post", "box", (0.5, 0.01, 0.05), (0.0025, 0.0025, 0.5), 0.005, 0.04, reach=0.4),
)

#: A rod's inertia is small relative to its mass, so that a hit stops its rotation instead of
#: pushing it off the post.
ROD_INERTIA = 1e-3


def turned(rng: np.random.Generator, scene: Scene) -> np.ndarray:
    """(w, x, y, z) start attitude: random for a box, none for a ball or a rod."""
    if scene.mover == "ball" or scene.turns:
        return np.array([1.0, 0, 0, 0])
    q = rng.normal(size=4)
    return q / np.linalg.norm(q)
