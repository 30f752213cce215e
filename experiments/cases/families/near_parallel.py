# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""A face on another with a minute tilt, pressed in or lifted by less than the tilt's own height."""

import numpy as np

from experiments.cases.placement import IDENTITY, UPSIDE_DOWN, multiply, rest_on
from experiments.cases.scenario import Draft, Scenario
from experiments.cases.shapes import any_convex, box
from ofg import Pose

KINDS = {"cubes": lambda rng: box(), "hulls": any_convex}
PLACES = {"pressed": -1, "lifted": 1}
SHARE = (0.2, 0.4)  # of the tilt's height by which A is pressed in or lifted


def generate(rng, level) -> Draft:
    kind, place = rng.choice(list(KINDS)), rng.choice(list(PLACES))
    a, b = (rest_on(KINDS[kind](rng), "face", int(rng.integers(4))) for _ in "ab")
    tilt = _about_the_face(level, rng.uniform(0, 2 * np.pi))
    heights = Pose(tilt).apply(a.vertices[a.vertices[:, 2] == 0])[:, 2]
    gap = PLACES[place] * rng.uniform(*SHARE) * np.ptp(heights)
    aligned = rng.random() < 0.5
    spin = IDENTITY if aligned else np.array([rng.integers(1, 8), 0, 0, rng.integers(1, 8)])
    # B keeps the axes of the world: in no other frame can float32 represent a tilt of 1e-9
    pose_a = Pose(multiply(spin, tilt), [0, 0, gap - heights.min()])
    tags = {"kind": str(kind), "place": str(place), "aligned": "yes" if aligned else "no"}
    return Draft(a, b, pose_a, Pose(UPSIDE_DOWN), tags=tags)


def _about_the_face(tilt: float, direction: float) -> np.ndarray:
    """The quaternion of a rotation by `tilt` about an axis in z = 0; `direction` is the axis's
    angle.
    """
    half = np.tan(tilt / 2)
    return np.array([1, half * np.cos(direction), half * np.sin(direction), 0])


SCENARIO = Scenario(
    name="near_parallel",
    question="overlap",
    precision="float32",
    exposes="early termination of GJK: the wedge between the faces is thinner than its tolerance",
    axis="tilt, radians",
    levels=(1e-7, 1e-8, 3e-9, 1e-9),
    generate=generate,
)
