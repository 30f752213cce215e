# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""A body that translates and rotates about its own centre hits a surface, or stops just short of
it.
"""

import numpy as np

from experiments.cases.placement import any_direction, in_world, touching
from experiments.cases.scenario import Draft, Scenario
from experiments.cases.shapes import any_convex
from ofg import Motion, Pose


def generate(rng, level) -> Draft:
    a, b = any_convex(rng), any_convex(rng)
    place = ("onto", "short of")[int(rng.random() < 0.4)]
    time = rng.uniform(0.2, 0.9) if place == "onto" else rng.uniform(1.1, 2.0)
    rotation, contact, normal = touching(rng, a, b, 0.0)
    heading = -normal + 0.5 * any_direction(rng)
    travel = a.size * rng.uniform(0.5, 3.0) * heading / np.linalg.norm(heading)
    motion = Motion(travel, any_direction(rng), level)
    start = motion.pose_at(Pose(rotation, contact), -time)
    return in_world(rng, Draft(a, b, start, Pose(), motion, {"place": place}))


SCENARIO = Scenario(
    name="rotational_contact",
    question="motion",
    precision="float32",
    exposes="the error of the time of impact on a curved path",
    axis="angle of rotation, radians",
    levels=(0.1, 0.5, 1.5, 3.0, 6.0, 12.0),
    generate=generate,
    redraw_if=("start-overlap",),
)
