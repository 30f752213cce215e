# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""A body starts a tiny gap away from another and moves further into it, or away."""

import numpy as np

from experiments.cases.placement import seat
from experiments.cases.scenario import Draft, Scenario
from experiments.cases.shapes import any_convex
from ofg import Motion


def generate(rng, level) -> Draft:
    s = seat(rng, any_convex(rng), any_convex(rng))
    s.tags["place"] = ("towards", "away")[int(rng.random() < 0.4)]
    s.tags["angle"] = float(rng.choice([0.0, 45.0, 80.0]))
    tilt, heading = np.radians(s.tags["angle"]), rng.uniform(0, 2 * np.pi)
    tangent = s.matrix[:, :2] @ [np.cos(heading), np.sin(heading)] / s.unit
    sign = 1 if s.tags["place"] == "away" else -1
    travel = (
        s.size * rng.uniform(0.2, 2.0) * (np.sin(tilt) * tangent + sign * np.cos(tilt) * s.normal)
    )
    return s.draft(level * s.size * s.normal, [0, 0, 0], Motion(travel), finest=level * s.size)


SCENARIO = Scenario(
    name="near_start",
    question="translation",
    precision="float32",
    exposes="contact at t = 0: hits dismissed as resting contact, and departures reported as hits",
    axis="gap at the start / size",
    levels=(1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12),
    generate=generate,
    redraw_if=("start-overlap",),
)
