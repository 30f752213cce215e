# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The same contact in every unit of length: both bodies and the gap, scaled by one factor."""

from experiments.cases.placement import seat
from experiments.cases.scenario import Draft, Scenario
from experiments.cases.shapes import any_convex, scaled


def generate(rng, level) -> Draft:
    a, b = scaled(any_convex(rng), level), scaled(any_convex(rng), level)
    s = seat(rng, a, b)
    return s.apart(rng.choice([1e-2, 1e-4]) * rng.choice([-1, 1]) * s.size)


SCENARIO = Scenario(
    name="scale",
    question="overlap",
    precision="float32",
    exposes=(
        "tolerances and margins in units of length: micrometres and kilometres pose the same query"
    ),
    axis="factor on all lengths",
    levels=(1.0, 1e-3, 1e3, 1e-6, 1e6, 1e-9, 1e9),
    generate=generate,
)
