# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Random bodies in random poses at a given distance of their centres: the control, which
resembles most published comparisons.
"""

from experiments.cases.placement import any_direction, any_rotation, in_world
from experiments.cases.scenario import Draft, Scenario
from experiments.cases.shapes import any_convex
from ofg import Pose


def generate(rng, level) -> Draft:
    a, b = any_convex(rng), any_convex(rng)
    away = level * (a.radius + b.radius) * any_direction(rng)
    return in_world(rng, Draft(a, b, Pose(any_rotation(rng), away), Pose(any_rotation(rng))))


SCENARIO = Scenario(
    name="random_pose",
    question="overlap",
    precision="float32",
    exposes=(
        "a control: easy cases that hardly separate methods, on which nearly every method is "
        "right and pooled rates are flattering"
    ),
    axis="distance of the centres / sum of the radii",
    levels=(0.25, 0.5, 0.75, 1.0, 1.25),
    generate=generate,
)
