# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Meshes of real objects with thousands of faces; the extreme vertex of one is near a point of
the other's surface.
"""

from experiments.cases.placement import in_world, touching
from experiments.cases.scenario import Draft, Scenario
from experiments.cases.shapes import LARGE_MESHES, real_concave
from ofg import Pose


def generate(rng, level) -> Draft:
    a, b = (real_concave(list(LARGE_MESHES)[rng.integers(len(LARGE_MESHES))]) for _ in range(2))
    rotation, position, _ = touching(rng, a, b, level * b.size)
    return in_world(
        rng, Draft(a, b, Pose(rotation, position), Pose(), tags={"bodies": f"{a.name} on {b.name}"})
    )


SCENARIO = Scenario(
    name="large_mesh",
    question="overlap",
    precision="float32",
    exposes="cost and selection on thousands of small faces, of which k cover a negligible part",
    axis="intended signed gap / size",
    levels=(0.1, -0.1, 1e-2, -1e-2, 1e-3, -1e-3),
    generate=generate,
)
