# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""A body flies through a thin wall while it rotates, or past the wall's rim; both ends of the
step are clear.
"""

from dataclasses import replace

from experiments.cases.placement import any_direction, flight_through, in_world
from experiments.cases.scenario import Draft, Scenario


def generate(rng, level) -> Draft:
    flight = flight_through(rng, level)
    turn = float(rng.choice([0.5, 1.5, 3.0, 6.0, 12.0]))
    motion = replace(flight.motion, axis=any_direction(rng), angle=turn)
    return in_world(rng, replace(flight, motion=motion, tags={**flight.tags, "turn": turn}))


SCENARIO = Scenario(
    name="screw_wall",
    question="motion",
    precision="float32",
    exposes=(
        "tunnelling of bodies that translate and rotate at once: sampling, linearised paths, and "
        "the cost of certainty on both"
    ),
    axis="travel in the step / thickness of the wall",
    levels=(2.0, 10.0, 100.0, 1e3, 1e4, 1e6, 1e9, 1e15),
    generate=generate,
    redraw_if=("start-overlap",),
)
