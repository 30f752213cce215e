# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Meshes of real objects that fly from outside at a point of one another's surface: right
through, just short of it, or past it.
"""

from experiments.cases.placement import in_world
from experiments.cases.realistic import throw
from experiments.cases.scenario import Draft, Scenario


def generate(rng, level) -> Draft:
    return in_world(rng, throw(rng, level))


SCENARIO = Scenario(
    name="real_sweep",
    question="translation",
    precision="float32",
    exposes=(
        "sweeps of real meshes: hollow bodies, pieces, and thin parts of a few irregular triangles"
    ),
    axis="travel / size of the body hit",
    levels=(2.0, 5.0, 20.0),
    generate=generate,
    redraw_if=("start-overlap",),
)
