# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Two bodies at the same place far from the world's origin, with a gap that is part of their
shape.
"""

import numpy as np

from experiments.cases.placement import any_direction, seat
from experiments.cases.scenario import Draft, Scenario
from experiments.cases.shapes import any_convex, hull_of


def generate(rng, level) -> Draft:
    s = seat(rng, any_convex(rng), any_convex(rng))
    gap = s.tags["aim"] = float(rng.choice([1e-2, 1e-4]) * rng.choice([-1, 1]) * s.size)
    # At 1e8 neighbouring float32 positions are 8 apart: both bodies get the same position, and A's
    # vertices contain the gap.
    lifted = hull_of(s.a.vertices + np.array([0, 0, gap]), s.a.name)
    where = level * any_direction(rng)
    draft = s.draft(where, where)
    return Draft(lifted, draft.b, draft.pose_a, draft.pose_b, tags=draft.tags)


SCENARIO = Scenario(
    name="far_from_origin",
    question="overlap",
    precision="float32",
    exposes="cancellation, and engines that compute in float32 or in world coordinates",
    axis="distance from the origin",
    levels=(1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9),
    generate=generate,
)
