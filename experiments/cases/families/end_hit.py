# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""A body moves onto a feature of another and arrives just before the end of the step, or would
arrive just after it.
"""

import numpy as np

from experiments.cases.placement import seat
from experiments.cases.scenario import Draft, Scenario
from experiments.cases.shapes import any_convex
from ofg import Motion


def generate(rng, level) -> Draft:
    s = seat(rng, any_convex(rng), any_convex(rng))
    x, y = rng.integers(-4, 5, 2)
    travel = s.exact(x, y, -5, s.size * rng.uniform(0.5, 2.0))
    # A reaches B's place at t = 1 exactly; B is offset from there by the last bit of the path.
    return s.draft(-travel, -level * travel, Motion(travel), finest=level * np.linalg.norm(travel))


SCENARIO = Scenario(
    name="end_hit",
    question="translation",
    precision="float32",
    exposes=(
        "the end of the step: hits in its last instant that are lost, and hits of the next step "
        "that are counted early"
    ),
    axis="1 - time of impact",
    levels=tuple(sign * 10.0**-e for e in (2, 4, 6, 8, 10) for sign in (1, -1)),
    generate=generate,
    redraw_if=("start-overlap",),
)
