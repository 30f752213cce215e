# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""A body flies through the hole of a frame, clear of its inner side or scraping it; or the frame
flies over the body.
"""

import numpy as np

from experiments.cases.placement import any_rotation, in_world
from experiments.cases.scenario import Draft, Scenario
from experiments.cases.shapes import any_convex, frame, scaled
from ofg import Motion, Pose

HOLE, SIDES = 0.5, 4


def generate(rng, level) -> Draft:
    form, mover = ("mesh", "union")[rng.integers(2)], ("body", "frame")[rng.integers(2)]
    ring = frame(HOLE, sections=SIDES, form=form)
    body = any_convex(rng)
    body = scaled(body, float(np.float32(0.4 / body.radius)))
    rotation = any_rotation(rng)
    # the normal of one inner side
    side = np.array([np.cos(np.pi / SIDES), np.sin(np.pi / SIDES), 0.0])
    turned = Pose(rotation).apply(body.vertices)
    beside = (HOLE - level * body.size - (turned @ side).max()) * side
    start, travel = beside + [0, 0, 1.0], np.array([0.0, 0.0, -2.0])
    tags = {"form": form, "mover": mover, "aim": level * body.size}
    if mover == "body":
        return in_world(rng, Draft(body, ring, Pose(rotation, start), Pose(), Motion(travel), tags))
    return in_world(rng, Draft(ring, body, Pose(), Pose(rotation, start), Motion(-travel), tags))


SCENARIO = Scenario(
    name="through_hole",
    question="translation",
    precision="float32",
    exposes="hulls of concave bodies, and hulls of their sweeps: both fill the hole",
    axis="signed clearance / size",
    levels=tuple(sign * 10.0**-e for e in (1, 2, 3, 4, 5) for sign in (1, -1)),
    generate=generate,
    redraw_if=("start-overlap",),
)
