# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""A concave body rotates about something inside its hollow: a square frame about a square peg,
or a hook about a post.
"""

import numpy as np

from experiments.cases.placement import in_world
from experiments.cases.scenario import Draft, Scenario
from experiments.cases.shapes import box, frame, hook
from ofg import Motion, Pose

HOLE = 0.5


def generate(rng, level) -> Draft:
    form, kind = (
        ("mesh", "union")[rng.integers(2)],
        ("frame about a peg", "hook about a post")[rng.integers(2)],
    )
    hit = rng.random() < 0.6
    if (
        kind == "frame about a peg"
    ):  # the peg's corners reach 1.41 times as far as its sides: past the hole's sides, or not
        a, half = (
            frame(HOLE, form=form),
            HOLE * (rng.uniform(0.8, 0.95) if hit else rng.uniform(0.5, 0.68)),
        )
        b = box(float(np.float32(2 * half)), float(np.float32(2 * half)), 1.0)
        start_a, start_b = Pose(), _about_z(np.pi / 4)  # the frame's sides face the diagonals
    else:  # the post stands in the path of the arm along x, or beyond the arm's end
        a, b = hook(form=form), box(0.0625, 0.0625, 1.0)
        angle, distance = min(rng.uniform(0.3, 0.7) * level, 1.2), 0.5 if hit else 0.875
        start_a, start_b = (
            Pose(),
            Pose(position=[distance * np.cos(angle), distance * np.sin(angle), 0.0]),
        )
    tags = {"kind": kind, "form": form}
    return in_world(rng, Draft(a, b, start_a, start_b, Motion([0, 0, 0], [0, 0, 1], level), tags))


def _about_z(angle) -> Pose:
    return Pose([np.cos(angle / 2), 0, 0, np.sin(angle / 2)])


SCENARIO = Scenario(
    name="concave_rotation",
    question="motion",
    precision="float32",
    exposes=(
        "engines that use only hulls (A's hull mostly overlaps B from the start), and the "
        "selection of pieces: the colliding pair changes during the rotation"
    ),
    axis="angle of rotation, radians",
    levels=(0.25, 0.5, 1.0, float(np.float32(np.pi / 2)), 6.0),
    generate=generate,
    redraw_if=("start-overlap",),
)
