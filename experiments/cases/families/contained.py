# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""A small body wholly inside a large one (surfaces apart, solids overlap), or just outside it."""

import numpy as np

from experiments.cases.placement import any_direction, in_world, touching
from experiments.cases.scenario import Draft, Scenario
from experiments.cases.shapes import any_convex, scaled
from ofg import Body, Pose


def generate(rng, level) -> Draft:
    large, small = any_convex(rng), any_convex(rng)
    room = inscribed_radius(large)
    small = scaled(small, float(np.float32(level * room / small.radius)))
    place = ("inside", "outside")[int(rng.random() < 0.3)]
    rotation, position, _ = touching(rng, small, large, small.size)
    if place == "inside":
        position = rng.uniform(0.0, 0.95) * (room - small.radius) * any_direction(rng)
    return in_world(
        rng, Draft(small, large, Pose(rotation, position), Pose(), tags={"place": place})
    )


def inscribed_radius(body: Body) -> float:
    """Radius of the largest ball about the origin inside a convex body."""
    mesh = body.to_trimesh()
    return float(np.einsum("ij,ij->i", mesh.face_normals, mesh.triangles[:, 0]).min())


SCENARIO = Scenario(
    name="contained",
    question="overlap",
    precision="float32",
    exposes="surface-only tests, which detect nothing when one body is wholly inside the other",
    axis="radius of the inner body / radius of the largest ball inside the outer",
    levels=(0.9, 0.5, 0.1, 1e-2, 1e-3),
    generate=generate,
)
