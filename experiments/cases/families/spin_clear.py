# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The end of a rotating rod passes a flat face on a circle: above the face, or into it, by a
fraction of the chord's error.
"""

import numpy as np

from experiments.cases.placement import in_world
from experiments.cases.scenario import Draft, Scenario
from experiments.cases.shapes import box, rod
from ofg import Motion, Pose


def generate(rng, level) -> Draft:
    spinner = rod(float(rng.choice([8, 16, 32])))
    turn = rng.uniform(0.6, 1.5)
    radius = np.linalg.norm(spinner.vertices[:, :2], axis=1).max()
    tip = spinner.vertices[np.argmax(np.linalg.norm(spinner.vertices[:, :2], axis=1))]
    clearance = level * radius * turn**2 / 8
    # The tip's circle touches the plane of the face near the middle of the rotation, but not at it:
    # a path sampled at i / n with an even n would sample that very instant (16 substeps then missed
    # none of 42, 15 missed 9).
    angle = np.arctan2(tip[1], tip[0]) + turn * rng.uniform(0.4, 0.6)
    block = box(0.25, float(np.float32(0.5 * turn)), 0.5)
    out = np.array([np.cos(angle), np.sin(angle), 0])
    pose = Pose([np.cos(angle / 2), 0, 0, np.sin(angle / 2)], (radius + clearance + 0.125) * out)
    motion = Motion([0, 0, 0], [0, 0, 1], turn)
    return in_world(
        rng, Draft(spinner, block, Pose(), pose, motion, {"turn": round(turn, 3), "aim": clearance})
    )


SCENARIO = Scenario(
    name="spin_clear",
    question="motion",
    precision="float32",
    exposes=(
        "the chord's error: a path of K straight segments deviates by r theta^2 / 8 K^2, and is "
        "wrong if the clearance is less"
    ),
    axis="signed clearance / (r theta^2 / 8)",
    levels=tuple(sign * 0.25**k for k in range(7) for sign in (1, -1)),
    generate=generate,
    redraw_if=("start-overlap",),
)
