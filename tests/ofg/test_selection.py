# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Selections by distance to the face itself, against all distances worked out here."""

import numpy as np
import pytest
import trimesh

import ofg
from ofg import Body, Pose


@pytest.mark.parametrize("k", [1, 8, 16, 40])
def test_point_triangle_selects_what_a_full_sort_selects(k):
    """Long and short faces mixed. The first face of A that can be told from an answer is the
    nearest: the row of the first hit.
    """
    rng = np.random.default_rng(1)
    stretched = Body.convex(rng.normal(size=(120, 3)) * (5, 1, 0.2))
    ball = Body.from_trimesh(trimesh.creation.icosphere(subdivisions=2))
    seen = 0
    for _ in range(60):
        pose = Pose(position=rng.uniform(-3, 3, 3))
        answer = ofg.discrete(stretched, ball, pose, k=k, nearest="point-triangle")
        centre = ball.vertices.mean(axis=0) - pose.position
        triangles = stretched.vertices[stretched.faces]
        closest = trimesh.triangles.closest_point(triangles, np.tile(centre, (len(triangles), 1)))
        distance = np.linalg.norm(closest - centre, axis=1)
        order = np.argsort(distance, kind="stable")[:k]
        if answer:
            row = (answer.counts["face_pairs"] - 1) // min(k, len(ball.faces))
            assert distance[answer.faces[0]] == pytest.approx(distance[order[row]], rel=1e-12)
            seen += 1
    assert seen > 5
