# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The article's first example: a face passes through a wall within one step, or past its rim."""

import numpy as np

from experiments.cases.placement import in_world
from experiments.cases.scenario import Draft, Scenario
from experiments.cases.shapes import box
from ofg import Motion, Pose

HALF_WALL, THIN = 2.0, 1 / 64


def generate(rng, level) -> Draft:
    face, wall = box(1, 1, THIN), box(2 * HALF_WALL, 2 * HALF_WALL, float(np.float32(1 / level)))
    through = rng.random() < 0.75
    turn = rng.uniform(0, np.pi)
    across = (
        rng.uniform(-1, 1, 2) if through else np.array([HALF_WALL + rng.uniform(0.75, 1.0), 0.0])
    )
    start = Pose([np.cos(turn), 0, 0, np.sin(turn)], [*across, 0.5])
    place = "through" if through else "past the rim"
    return in_world(rng, Draft(face, wall, start, Pose(), Motion([0, 0, -1]), {"place": place}))


SCENARIO = Scenario(
    name="article_wall",
    question="translation",
    exposes=(
        "tunnelling, in the article's own words: the face is on the other side of the wall after "
        "one time unit"
    ),
    axis="travel in the step / thickness of the wall",
    levels=(2.0, 10.0, 100.0, 1000.0),
    generate=generate,
    precision="float32",
    redraw_if=("start-overlap",),
)
