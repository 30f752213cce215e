# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The article's second example: a cube floats above a table and rotates by 45 degrees within one
step.
"""

import numpy as np

from experiments.cases.placement import in_world
from experiments.cases.scenario import Draft, Scenario
from experiments.cases.shapes import box
from ofg import Motion, Pose

TABLE = 0.5  # thickness


def generate(rng, level) -> Draft:
    cube, table = box(1, 1, 1), box(6, 6, TABLE)
    yaw = rng.uniform(0, np.pi)
    start = Pose(
        [np.cos(yaw / 2), 0, 0, np.sin(yaw / 2)],
        [*rng.uniform(-1.5, 1.5, 2), TABLE / 2 + 0.5 + level],
    )
    edge = [-np.sin(yaw), np.cos(yaw), 0.0]  # of the cube's base
    return in_world(rng, Draft(cube, table, start, Pose(), Motion([0, 0, 0], edge, np.pi / 4)))


SCENARIO = Scenario(
    name="article_table",
    question="motion",
    exposes=(
        "selections made before the rotation: the base of the cube is nearest to the table, but "
        "an edge of it hits"
    ),
    axis="height above the table / side of the cube; clear from 0.207 on",
    levels=(0.01, 0.1, 0.2, 0.25),
    generate=generate,
    precision="float32",
    redraw_if=("start-overlap",),
)
