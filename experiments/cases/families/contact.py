# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""A body moves onto a feature of another, at an angle to the contact normal, or stops just short
of it.
"""

import numpy as np

from experiments.cases.placement import seat
from experiments.cases.scenario import Draft, Scenario
from experiments.cases.shapes import any_convex
from ofg import Motion


def generate(rng, level) -> Draft:
    s = seat(rng, any_convex(rng), any_convex(rng))
    s.tags["place"] = ("onto", "short of")[int(rng.random() < 0.3)]
    time = rng.uniform(0.1, 0.9) if s.tags["place"] == "onto" else rng.uniform(1.01, 1.5)
    tilt, heading = np.radians(level), rng.uniform(0, 2 * np.pi)
    tangent = s.matrix[:, :2] @ [np.cos(heading), np.sin(heading)] / s.unit
    speed = s.size * 10 ** rng.uniform(-0.5, 1.0)
    travel = speed * (np.sin(tilt) * tangent - np.cos(tilt) * s.normal)
    return s.draft(-time * travel, [0, 0, 0], Motion(travel), finest=s.size)


SCENARIO = Scenario(
    name="contact",
    question="translation",
    precision="float32",
    exposes=(
        "the error of the time of impact as a function of the angle between the path and the "
        "contact normal"
    ),
    axis="angle to the normal, degrees",
    levels=(0.0, 30.0, 60.0, 80.0, 89.0, 89.9),
    generate=generate,
    redraw_if=("start-overlap",),
)
