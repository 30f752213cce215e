# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""A body slides past another with a prescribed clearance, or penetrates it by that depth, on a
path parallel to the contact plane.
"""

from experiments.cases.placement import seat
from experiments.cases.scenario import Draft, Scenario
from experiments.cases.shapes import any_convex
from ofg import Motion


def generate(rng, level) -> Draft:
    s = seat(rng, any_convex(rng), any_convex(rng))
    x, y = rng.choice([-1, 1], 2) * rng.integers(1, 8, 2)
    clearance = s.tags["aim"] = level * s.size
    half = s.exact(x, y, 0, 1.5 * max(s.a.size, s.b.size))
    # Closest at t = 16 / odd, not at the middle: a path sampled at i / n with an even n would
    # sample that very instant (16 substeps then missed none of 64 scrapes, 15 missed 35).
    whole = half * rng.choice([27, 29, 31, 33, 35, 37]) / 16
    # B's position contains the clearance and A's contains the path: rounding their sum would lose
    # the clearance.
    return s.draft(-half, -clearance * s.normal, Motion(whole), finest=clearance)


SCENARIO = Scenario(
    name="graze",
    question="translation",
    precision="float32",
    exposes="false alarms of conservative sweeps, and misses of shallow scrapes",
    axis="signed clearance / size",
    levels=tuple(sign * 10.0**-e for e in (1, 2, 3, 4, 6, 8, 10, 12) for sign in (1, -1)),
    generate=generate,
    redraw_if=("start-overlap",),
)
