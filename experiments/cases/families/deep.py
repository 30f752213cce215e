# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""A body and its own copy, or another body, with nearly or exactly the same centre."""

from experiments.cases.placement import any_direction, any_rotation, in_world
from experiments.cases.scenario import Draft, Scenario
from experiments.cases.shapes import any_convex
from ofg import Pose


def generate(rng, level) -> Draft:
    a = any_convex(rng)
    kind = ("copy", "turned copy", "other body")[rng.integers(3)]
    b = any_convex(rng) if kind == "other body" else a
    turn = [1, 0, 0, 0] if kind == "copy" else any_rotation(rng)
    # No world offset: at 1e-8 rounding to it would remove the offset between the bodies.
    return in_world(
        rng,
        Draft(a, b, Pose(turn, level * a.size * any_direction(rng)), Pose(), tags={"kind": kind}),
        offset=0.0,
    )


SCENARIO = Scenario(
    name="deep",
    question="overlap",
    precision="float32",
    exposes=(
        "the degenerate case of GJK with the origin at the centre of the Minkowski difference, "
        "and OFG's selection by distance of centres"
    ),
    axis="distance of the centres / size",
    levels=(0.1, 1e-2, 1e-4, 1e-8, 0.0),
    generate=generate,
)
