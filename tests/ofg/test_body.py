# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Bodies: what they are made of, and the one-paragraph error for what cannot be one."""

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from ofg import Body, BodyError, Motion, Pose, Query

BOX = trimesh.creation.box()
TORUS = trimesh.creation.torus(1.0, 0.25, major_sections=12, minor_sections=6)


def with_nan(mesh):
    v = np.array(mesh.vertices)
    v[3, 1] = np.nan
    return v


@pytest.mark.parametrize(
    "make, words",
    [
        (
            lambda: Body.mesh(with_nan(BOX), BOX.faces, "crate"),
            ["crate", "vertex 3", "not finite", "Remove"],
        ),
        (lambda: Body.convex(with_nan(BOX), "crate"), ["crate", "vertex 3", "not finite"]),
        (lambda: Body.mesh(BOX.vertices, BOX.faces[1:], "crate"), ["crate", "open", "fill_holes"]),
        (
            lambda: Body.mesh(BOX.vertices, BOX.faces + 1, "crate"),
            ["crate", "names vertex 8", "0 to 7"],
        ),
        (
            lambda: Body.mesh(BOX.vertices, BOX.faces.astype(float), "crate"),
            ["crate", "faces", "float64"],
        ),
        (lambda: Body.mesh(BOX.vertices[:, :2], BOX.faces, "crate"), ["crate", "(8, 2)", "(n, 3)"]),
        (lambda: Body.convex(BOX.vertices * [1, 1, 0], "sheet"), ["sheet", "no volume"]),
        (lambda: Body.convex(np.zeros((5, 3)), "point"), ["point", "no volume"]),
        (lambda: Body.union([], "nothing"), ["nothing", "one convex piece"]),
        (
            lambda: Body.union([Body.from_trimesh(TORUS)], "ring"),
            ["ring", "given Body('trimesh', mesh", "Body.convex"],
        ),
        (lambda: Body.union([BOX], "ring"), ["ring", "given a Trimesh", "Body.convex"]),
        (lambda: Body.union(Body.from_trimesh(BOX), "ring"), ["ring", "not Body", "Body.convex"]),
        (lambda: Body.union(None, "ring"), ["ring", "not NoneType", "Body.convex"]),
        (lambda: Body.convex("cube", "crate"), ["crate", "array of numbers"]),
        (lambda: Body.convex(1j * BOX.vertices, "crate"), ["crate", "array of numbers"]),
        (lambda: Body.from_file("no/such.obj"), ["such.obj", "does not exist"]),
    ],
)
def test_what_is_no_body_is_said_in_one_paragraph(make, words):
    with pytest.raises(BodyError) as error:
        make()
    message = str(error.value)
    assert all(word in message for word in words), message
    assert "\n" not in message and len(message) < 500


def test_a_file_that_is_no_mesh_is_named(tmp_path):
    path = tmp_path / "novel.obj"
    path.write_text("It was a dark and stormy night.\n")
    with pytest.raises(BodyError, match="novel.obj|novel"):
        Body.from_file(path)


@pytest.mark.parametrize("suffix", ["obj", "stl", "ply", "off", "glb"])
@pytest.mark.parametrize("mesh, kind", [(BOX, "convex"), (TORUS, "mesh")])
def test_files_give_the_body_that_was_written(tmp_path, suffix, mesh, kind):
    path = tmp_path / f"body.{suffix}"
    mesh.export(path)
    body = Body.from_file(path)
    assert body.kind == kind and body.name == "body" and len(body.faces) == len(mesh.faces)
    assert body.to_trimesh().volume == pytest.approx(mesh.volume, rel=1e-5)


@given(st.integers(0, 10**6), st.integers(5, 60))
@settings(max_examples=50, deadline=None)
def test_a_hull_is_closed_outward_and_holds_its_points(seed, n):
    points = np.random.default_rng(seed).normal(size=(n, 3))
    body = Body.convex(points)
    mesh = body.to_trimesh()
    assert mesh.is_watertight and mesh.volume > 0
    Body.mesh(body.vertices, body.faces)
    heights = np.einsum(
        "fk,nfk->nf", mesh.face_normals, points[:, None, :] - mesh.triangles[None, :, 0]
    )
    assert heights.max() < 1e-9


def test_the_digest_is_of_the_content():
    assert Body.from_trimesh(BOX, "a").digest == Body.from_trimesh(BOX, "b").digest
    assert Body.from_trimesh(BOX).digest != Body.convex(BOX.vertices * 2).digest
    piece = Body.from_trimesh(BOX)
    assert Body.union([piece]).digest != piece.digest


@pytest.mark.parametrize(
    "make, words",
    [
        (lambda: Pose((0, 0, 0, 0)), "quaternion is zero"),
        (lambda: Pose(position=(0, np.inf, 0)), "position.*not finite"),
        (lambda: Pose(position=(0, 0)), r"position must have shape \(3,\)"),
        (lambda: Motion(axis=(0, 0, 0), angle=1.0), "axis is zero"),
        (lambda: Motion(angle=np.nan), "angle"),
        (
            lambda: Query("overlapp", Body.from_trimesh(BOX), Body.from_trimesh(BOX)),
            "overlap, translation, motion",
        ),
        (
            lambda: Query(
                "overlap", Body.from_trimesh(BOX), Body.from_trimesh(BOX), motion=Motion((1, 0, 0))
            ),
            "one pair of poses",
        ),
        (
            lambda: Query(
                "translation",
                Body.from_trimesh(BOX),
                Body.from_trimesh(BOX),
                motion=Motion(angle=1),
            ),
            "use 'motion'",
        ),
    ],
)
def test_what_is_no_pose_motion_or_query_is_said(make, words):
    with pytest.raises(ValueError, match=words):
        make()


@given(
    st.lists(st.floats(-1, 1), min_size=4, max_size=4).filter(
        lambda q: sum(x * x for x in q) > 1e-3
    ),
    st.floats(0.1, 10),
)
def test_a_quaternion_of_any_length_is_the_same_rotation(q, scale):
    assert np.allclose(Pose(q).rotation, Pose(np.multiply(q, scale)).rotation, atol=1e-12)
    assert np.allclose(Pose(q).rotation @ Pose(q).rotation.T, np.eye(3), atol=1e-12)


@given(st.floats(0, 1), st.floats(-20, 20))
def test_a_motion_turns_about_the_bodys_own_origin(t, angle):
    start = Pose((0.3, -0.2, 0.9, 0.1), (1, 2, 3))
    motion = Motion((4, 5, 6), (1, 2, -2), angle)
    turn = Rotation.from_rotvec(np.array([1, 2, -2]) / 3 * angle * t)
    v = np.array([[0.5, -0.7, 0.2]])
    expected = np.array([1, 2, 3]) + t * np.array([4, 5, 6]) + turn.apply(v @ start.rotation.T)
    assert np.allclose(motion.pose_at(start, t).apply(v), expected, atol=1e-9)
