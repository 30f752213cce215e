# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Body.convex keeps every vertex of tiny and of flat bodies: trimesh's hull merged vertices closer
than 1e-8 into one.
"""

import numpy as np
import pytest

from ofg import Body, BodyError


@pytest.mark.parametrize("scale", [1e-9, 1e-6, 1.0, 1e9])
@pytest.mark.parametrize("flatness", [1.0, 1e-9])
def test_convex_is_whole_at_every_scale(scale, flatness):
    points = np.random.default_rng(3).normal(size=(40, 3)) * [1, 1, flatness]
    one, body = Body.convex(points), Body.convex(points * scale)
    assert (
        len(body.vertices) == len(one.vertices)
        and len(body.faces) == len(one.faces) == 2 * len(one.vertices) - 4
    )
    mesh = body.to_trimesh()
    assert mesh.is_watertight and mesh.is_winding_consistent
    a, b, c = (body.vertices[body.faces[:, i]] - body.vertices.mean(axis=0) for i in range(3))
    assert (np.einsum("ij,ij->i", a, np.cross(b, c)) > 0).all(), (
        "every face seen counter-clockwise from outside"
    )


def test_flat_points_are_refused():
    with pytest.raises(BodyError, match="have no volume"):
        Body.convex([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0], [0.3, 0.2, 0]])
