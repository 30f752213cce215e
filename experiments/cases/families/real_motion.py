# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Meshes of real objects that fly at one another while rotating: onto a point of the surface,
just short of it, or past it.
"""

from experiments.cases.placement import in_world
from experiments.cases.realistic import throw
from experiments.cases.scenario import Draft, Scenario


def generate(rng, level) -> Draft:
    return in_world(rng, throw(rng, 2.0, level))


SCENARIO = Scenario(
    name="real_motion",
    question="motion",
    precision="float32",
    exposes="curved paths of irregular, concave bodies: their cost, and which pieces collide",
    axis="angle of rotation, radians",
    levels=(0.5, 1.5, 3.0, 6.0),
    generate=generate,
    redraw_if=("start-overlap",),
)
