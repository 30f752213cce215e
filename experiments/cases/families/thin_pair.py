# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""A thin body flies broadside through a thin wall within one step, or past its rim; the time of
crossing is random, and both ends are clear.
"""

import numpy as np

from experiments.cases.placement import in_world
from experiments.cases.scenario import Draft, Scenario
from experiments.cases.shapes import box, rod
from ofg import Motion, Pose

HALF_WALL = 2.0


def generate(rng, level) -> Draft:
    """In contact for 1 / level of the step: a path sampled in n substeps misses about 1 - n /
    level of the hits.
    """
    travel, share = rng.choice([1.0, 2.0, 4.0]), rng.choice([0.1, 0.5, 0.9])
    both = travel / level
    kind = ("plate", "rod")[rng.integers(2)]
    body = (
        box(1.0, 0.75, float(np.float32(share * both)))
        if kind == "plate"
        else rod(1 / (share * both), length=1.0)
    )
    wall = box(2 * HALF_WALL, 2 * HALF_WALL, float(np.float32((1 - share) * both)))
    through = rng.random() < 0.7
    side = (
        rng.uniform(-1, 1, 2)
        if through
        else np.array([HALF_WALL + body.radius * rng.uniform(1.05, 1.5), 0.0])
    )
    slant = rng.uniform(-0.5, 0.5, 2) * [through, 1]  # a body beside the rim stays beside it
    # of the centres: contact lasts from 0.5 / level before this time to 0.5 / level after it
    crossing = rng.uniform(*np.array([0.6, -0.6]) / level + [0, 1])
    # parallel to the wall within a tenth of its own thickness
    spin, tilt = (
        rng.uniform(0, np.pi),
        0.1 * rng.uniform(-1, 1) * share * both,
    )
    turn = [np.cos(spin), np.sin(spin) * np.sin(tilt), 0.0, np.sin(spin) * np.cos(tilt)]
    start = Pose(turn, [*(side - crossing * slant), crossing * travel])
    tags = {
        "place": "through" if through else "past the rim",
        "kind": kind,
        "crossing": float(crossing),
    }
    return in_world(rng, Draft(body, wall, start, Pose(), Motion([*slant, -travel]), tags))


SCENARIO = Scenario(
    name="thin_pair",
    question="translation",
    precision="float32",
    exposes=(
        "tunnelling on any sampled path, however fine: both bodies are thin, so samples miss the "
        "contact"
    ),
    axis="travel in the step / thickness of both",
    levels=(2.0, 5.0, 20.0, 100.0, 1e3, 1e4, 1e6),
    generate=generate,
    redraw_if=("start-overlap",),
)
