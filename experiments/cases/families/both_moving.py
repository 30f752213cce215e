# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Two bodies translate and rotate, each about its centre or another of its points, and collide
or stop short of contact.
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
    # B makes part of the approach, and both drift: a method that reads only A's motion gets another
    # approach.
    share, drift = rng.uniform(0.2, 0.8), a.size * any_direction(rng)
    pivot = ("centre", "point")[int(rng.random() < 0.5)]
    off = float(pivot == "point")
    arms = [off * body.size * rng.uniform(0.3, 1.0) * any_direction(rng) for body in (a, b)]
    motion = Motion((1 - share) * travel + drift, any_direction(rng), level, arms[0])
    motion_b = Motion(drift - share * travel, any_direction(rng), level, arms[1])
    # They touch at `time`; from that pose both are moved back to the start.
    start_a = motion.pose_at(Pose(rotation, contact), -time)
    start_b = motion_b.pose_at(Pose(), -time)
    tags = {"place": place, "turns about": pivot}
    return in_world(rng, Draft(a, b, start_a, start_b, motion, tags, motion_b))


SCENARIO = Scenario(
    name="both_moving",
    question="motion",
    precision="float32",
    exposes="methods that support one moving body, and methods that reduce a motion to its two "
    "end poses",
    axis="angle of rotation of each body, radians",
    levels=(0.1, 0.5, 1.5, 6.0),
    generate=generate,
    redraw_if=("start-overlap",),
)
