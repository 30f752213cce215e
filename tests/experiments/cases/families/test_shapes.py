# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Bodies: float32 to the bit, closed, and the two forms of a concave one the same solid."""

import numpy as np
import pytest

from experiments.cases import shapes
from experiments.cases.scenario import snap


@pytest.mark.parametrize(
    "make",
    [shapes.torus, lambda form: shapes.frame(0.5, form=form), lambda form: shapes.hook(form=form)],
    ids=["torus", "frame", "hook"],
)
def test_mesh_and_union_are_the_same_solid(make):
    mesh, union = make(form="mesh"), make(form="union")
    points = np.random.default_rng(1).uniform(
        mesh.vertices.min(axis=0), mesh.vertices.max(axis=0), (2000, 3)
    )
    in_union = np.zeros(len(points), bool)
    for piece in union.pieces:
        inward = np.einsum(
            "pfi,fi->pf",
            points[:, None] - piece.vertices[piece.faces[:, 0]],
            piece.to_trimesh().face_normals,
        )
        in_union |= (inward < 1e-7).all(axis=1)
    triangles = mesh.vertices[mesh.faces][None] - points[:, None, None]
    a, b, c = triangles.transpose(2, 0, 1, 3)
    la, lb, lc = (np.linalg.norm(x, axis=2) for x in (a, b, c))
    dot = lambda x, y: np.einsum("pfi,pfi->pf", x, y)  # noqa: E731
    angle = 2 * np.arctan2(
        dot(a, np.cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb
    )
    in_mesh = angle.sum(axis=1) > 2 * np.pi  # solid angle: 4 pi inside, 0 outside
    assert np.array_equal(in_mesh, in_union) and 0 < in_mesh.mean() < 1


@pytest.mark.parametrize("name", shapes.CONVEX_MESHES)
def test_real_convex_mesh_is_its_hull(name):
    body = shapes.real_convex(name)
    assert (
        body.kind == "convex"
        and body.radius == pytest.approx(1)
        and len(body.faces) == 2 * len(body.vertices) - 4
    )


@pytest.mark.parametrize("name", {**shapes.CONCAVE_MESHES, **shapes.LARGE_MESHES})
def test_real_concave_mesh_is_closed_centred_and_concave(name):
    body = shapes.real_concave(name)
    assert (
        body.kind == "mesh" and body.radius == pytest.approx(1) and np.abs(body.centre).max() < 1e-6
    )
    assert np.array_equal(body.vertices, snap(body.vertices))
    mesh = body.to_trimesh()
    assert mesh.is_watertight and mesh.volume < 0.95 * mesh.convex_hull.volume


@pytest.mark.parametrize("name", shapes.PIECEWISE_MESHES)
def test_real_pieces_are_a_union(name):
    body = shapes.real_pieces(name)
    assert body.kind == "union" and len(body.pieces) >= 5 and body.radius == pytest.approx(1)


def test_decomposed_pieces_are_float32_and_cover_the_mesh_roughly():
    mesh, union = shapes.real_concave("cone"), shapes.real_concave("cone", "union")
    assert union.kind == "union" and np.array_equal(union.vertices, snap(union.vertices))
    assert sum(p.to_trimesh().volume for p in union.pieces) == pytest.approx(
        mesh.to_trimesh().volume, rel=0.2
    )


@pytest.mark.parametrize("factor", [1e-9, 1e-3, 1e9])
def test_scaled_keeps_the_shape_of_every_kind(factor):
    for body in (shapes.icosphere(), shapes.torus(form="mesh"), shapes.torus(form="union")):
        big = shapes.scaled(body, factor)
        assert (
            big.kind == body.kind
            and big.size == pytest.approx(factor * body.size)
            and len(big.faces) == len(body.faces)
        )
        assert shapes.scaled(body, factor) is big


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("faces", [4, 12, 40, 100])
def test_hull_has_the_faces_asked_for(faces, seed):
    assert len(shapes.hull(faces, seed).faces) == faces
