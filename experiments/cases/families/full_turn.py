# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""A rod makes whole turns about its own centre beside a body: the step ends in the pose in which
it began.
"""

import numpy as np

from experiments.cases.placement import in_world, spin_beside
from experiments.cases.scenario import Draft, Scenario


def generate(rng, level) -> Draft:
    return in_world(rng, spin_beside(rng, 2 * np.pi * level, rng.uniform(0.25, 0.75) * np.pi, 0.3))


SCENARIO = Scenario(
    name="full_turn",
    question="motion",
    precision="float32",
    exposes=(
        "methods that reduce a motion to its two end poses: start and end pose are the same, so "
        "nothing seems to move"
    ),
    axis="whole turns in the step",
    levels=(1.0, 2.0, 5.0, 20.0, 100.0),
    generate=generate,
    redraw_if=("start-overlap",),
)
