# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""A body flies through a thin wall within one step, or past its rim; both ends of the step are
clear.
"""

from experiments.cases.placement import flight_through, in_world
from experiments.cases.scenario import Draft, Scenario


def generate(rng, level) -> Draft:
    return in_world(rng, flight_through(rng, level))


SCENARIO = Scenario(
    name="thin_wall",
    question="translation",
    precision="float32",
    exposes="tunnelling: methods that test the end pose, or samples of the path",
    axis="travel in the step / thickness of the wall",
    levels=(2.0, 10.0, 100.0, 1e3, 1e4, 1e6, 1e9, 1e15),
    generate=generate,
    redraw_if=("start-overlap",),
)
