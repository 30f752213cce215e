# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Two unit cubes face to face, about 1e-8 deep (float32 snapping blurs it), turned together at
random: the pose at which FCL's signed distance aborts the process.
"""

import numpy as np

from experiments.cases.scenario import Draft, Scenario
from experiments.cases.shapes import box
from ofg import Pose


def generate(rng, level):
    turn = rng.normal(size=4)
    q = np.float32(turn / np.linalg.norm(turn))
    normal = Pose(q).rotation[:, 2]
    return Draft(box(), box(), Pose(q, (1 - level) * normal), Pose(q))


SCENARIO = Scenario(
    name="cubes_face_to_face",
    question="overlap",
    exposes="what aborts",
    axis="depth",
    levels=(1e-8,),
    generate=generate,
)
