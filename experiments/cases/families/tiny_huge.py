# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""A tiny body at a feature of a huge one, at a gap or a depth of a tenth of the tiny body's
size.
"""

from experiments.cases.placement import seat
from experiments.cases.scenario import Draft, Scenario
from experiments.cases.shapes import any_convex, scaled


def generate(rng, level) -> Draft:
    a, b = any_convex(rng), any_convex(rng)
    unit = ("tiny", "huge")[rng.integers(2)]  # which of the two has the size 1
    a, b = (a, scaled(b, level)) if unit == "tiny" else (scaled(a, 1 / level), b)
    s = seat(rng, a, b)
    s.tags["unit"] = unit
    return s.apart(rng.choice([-0.1, 0.1]) * s.a.size)


SCENARIO = Scenario(
    name="tiny_huge",
    question="overlap",
    precision="float32",
    exposes="epsilons that are absolute, or relative to the larger body",
    axis="size of the huge body / size of the tiny one",
    levels=(1e2, 1e3, 1e4, 1e5, 1e6),
    generate=generate,
)
