# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""A rod rotates about its own centre and its end hits a body at its side, or passes it; both
ends of the step are clear.
"""

from experiments.cases.placement import in_world, spin_beside
from experiments.cases.scenario import Draft, Scenario


def generate(rng, level) -> Draft:
    return in_world(
        rng, spin_beside(rng, level, rng.uniform(0.35, 0.65) * level, min(0.4, 0.15 * level))
    )


SCENARIO = Scenario(
    name="spin_side",
    question="motion",
    precision="float32",
    exposes=(
        "methods that linearise the path or ignore the rotation: the rod's centre does not move "
        "at all"
    ),
    axis="angle of rotation, radians",
    levels=(0.5, 1.0, 2.0, 3.0, 6.0),
    generate=generate,
    redraw_if=("start-overlap",),
)
