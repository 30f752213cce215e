# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Two convex bodies with one feature each a prescribed distance apart, or penetrating by that
distance.
"""

from experiments.cases.placement import seat
from experiments.cases.scenario import Draft, Scenario
from experiments.cases.shapes import any_convex


def generate(rng, level) -> Draft:
    s = seat(rng, any_convex(rng), any_convex(rng))
    return s.apart(level * s.size)


SCENARIO = Scenario(
    name="feature_gap",
    question="overlap",
    precision="float32",
    exposes=(
        "absolute and relative tolerances: a method errs below the gap at which its own epsilon "
        "takes effect"
    ),
    axis="signed gap / size",
    levels=tuple(sign * 10.0**-e for e in (1, 2, 3, 4, 6, 8, 10, 12, 14, 16) for sign in (1, -1)),
    generate=generate,
)
