# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Who answers about the pieces of a mesh says so, and does."""

import numpy as np
import pytest

import ofg
from baselines import registry
from ofg import Body, Pose, Query

DECOMPOSE = [
    "bullet-coacd",
    "mujoco-coacd",
    "ofg",
    "ofg-article",
    "bullet-coacd-substeps",
    "mujoco-coacd-substeps",
    "ofg concave=all-pairs",
]
KEEP = ["bullet", "fcl-mesh", "ofg concave=undivided", "ofg adaptive_k=true", "ofg repairs=all"]


@pytest.mark.parametrize("label", DECOMPOSE + KEEP)
def test_a_method_says_whether_it_decomposes(label):
    (method,) = registry.make(label)
    assert method.decomposes is (label in DECOMPOSE)


@pytest.fixture(scope="module")
def ring() -> Body:
    import trimesh

    made = trimesh.creation.torus(1.0, 0.4, major_sections=16, minor_sections=8)
    return Body.mesh(made.vertices, made.faces, "ring")


@pytest.mark.parametrize("label", ["bullet-coacd", "mujoco-coacd", "ofg k=inf"])
def test_it_answers_about_the_pieces(ring, label):
    """A small cube at a corner of a piece that sticks out of the mesh, or is cut short of it."""
    (method,) = registry.make(label)
    pieces, size = ofg.decompose(ring), 1e-3
    cube = Body.convex(
        size * np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    )
    for corner in pieces.vertices[:: len(pieces.vertices) // 20]:
        at = Pose(position=corner)
        said = [method.ready(Query("overlap", cube, body, at))().hit for body in (ring, pieces)]
        assert said[0] == said[1]
