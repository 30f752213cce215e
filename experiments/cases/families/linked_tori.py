# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Two tori linked like a chain, the tube of one near the inner side of the other, or penetrating
it.
"""

import numpy as np

from experiments.cases.placement import in_world
from experiments.cases.scenario import Draft, Scenario
from experiments.cases.shapes import torus
from ofg import Pose

RADIUS, AROUND = 0.75, 8


def generate(rng, level) -> Draft:
    form, tube = ("mesh", "union")[rng.integers(2)], float(rng.choice([0.125, 0.1875, 0.25]))
    sections = int(rng.choice([8, 12, 16]))
    body = torus(RADIUS, tube, sections, AROUND, form)
    flat = tube * np.cos(np.pi / AROUND)  # both tubes have a flat side at the contact
    # A about z, rotated so that a flat stretch of its inner side crosses the x axis; B stands
    # across it with a kink there.
    half = np.pi / sections
    wall = (RADIUS - flat) * np.cos(half)
    a = Pose([np.cos(half / 2), 0, 0, np.sin(half / 2)])
    b = Pose([1, 1, 0, 0], [RADIUS + flat - wall + level * body.size, 0, 0])
    return in_world(rng, Draft(body, body, a, b, tags={"form": form, "aim": level * body.size}))


SCENARIO = Scenario(
    name="linked_tori",
    question="overlap",
    precision="float32",
    exposes=(
        "concavity: hulls overlap, surfaces are linked, and only the right pieces decide whether "
        "the solids intersect"
    ),
    axis="signed gap / size",
    levels=tuple(sign * g for g in (0.05, 0.01, 1e-3, 1e-4, 1e-5) for sign in (1, -1)),
    generate=generate,
)
