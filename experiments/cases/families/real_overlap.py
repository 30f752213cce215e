# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Meshes of real objects, convex and concave; the extreme vertex of one is near a point of the
other's surface.
"""

from experiments.cases.placement import in_world, touching
from experiments.cases.realistic import any_pair
from experiments.cases.scenario import Draft, Scenario
from ofg import Pose


def generate(rng, level) -> Draft:
    a, b, kind = any_pair(rng)
    rotation, position, _ = touching(rng, a, b, level * b.size)
    return in_world(
        rng,
        Draft(
            a,
            b,
            Pose(rotation, position),
            Pose(),
            tags={"kind": kind, "bodies": f"{a.name} on {b.name}"},
        ),
    )


SCENARIO = Scenario(
    name="real_overlap",
    question="overlap",
    precision="float32",
    exposes=(
        "the effect of irregular real triangles, concavity and many pieces on methods that clean "
        "shapes flatter"
    ),
    axis="intended signed gap / size",
    levels=(0.1, -0.1, 1e-2, -1e-2, 1e-3, -1e-3, 1e-4, -1e-4),
    generate=generate,
)
