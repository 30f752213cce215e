# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Words, truth values and what is too large are no numbers, whatever numpy makes of them."""

import numpy as np
import pytest

import ofg
from ofg import Body, BodyError, Motion, Pose

POINTS = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
CUBE = Body.convex(POINTS)
MESH = Body.mesh(CUBE.vertices, CUBE.faces)
NO_VECTORS = (["1", "2", "3"], [True, False, True], [1, 2, 10**400], [1, 2, None], [1j, 0, 0])
NO_NUMBERS = ("1", b"1", True, 10**400, 1 + 0j, [1], np.zeros((9, 9)), np.bool_(True))
TAKES_VECTOR = {
    "displacement": Motion,
    "about": lambda v: Motion(about=v),
    "axis": lambda v: Motion(axis=v),
    "position": lambda v: Pose(position=v),
    "points": lambda v: Pose().apply(v),
    "sweep": lambda v: ofg.translational_sweep(CUBE, CUBE, v),
    "vertices": lambda v: Body.convex([v] * 4),
}
TAKES_NUMBER = {
    "angle": lambda x: Motion(angle=x),
    "degrees": lambda x: Motion.degrees(angle=x),
    "t": lambda x: Motion().pose_at(Pose(), x),
    "arc_tolerance": lambda x: ofg.discrete(CUBE, CUBE, arc_tolerance=x),
    "weld": lambda x: Body.from_trimesh(MESH.to_trimesh(), weld=x),
    "threshold": lambda x: ofg.decompose(MESH, threshold=x),
    "seconds": lambda x: ofg.decompose(MESH, seconds=x),
}


def refusal(call, value) -> str:
    with pytest.raises((TypeError, ValueError)) as error:
        call(value)
    return str(error.value)


@pytest.mark.parametrize("name", TAKES_VECTOR)
@pytest.mark.parametrize("value", NO_VECTORS, ids=repr)
def test_a_vector_is_of_numbers(name, value):
    if name in ("points", "vertices") and value[2] == 10**400:
        pytest.skip("an infinite point, which poses move")
    message = refusal(TAKES_VECTOR[name], value)
    assert "\n" not in message and len(message) < 300, message


@pytest.mark.parametrize("name", TAKES_NUMBER)
@pytest.mark.parametrize("value", NO_NUMBERS, ids=lambda value: repr(value)[:9])
def test_a_number_is_one(name, value):
    message = refusal(TAKES_NUMBER[name], value)
    assert "\n" not in message and len(message) < 300, message


@pytest.mark.parametrize("one", (1, np.float32(1), np.int8(1), np.array(1.0)))
def test_numpy_scalars_are_numbers(one):
    assert Motion(angle=one).angle == 1.0 and Motion([one] * 3).displacement.tolist() == [1] * 3


@pytest.mark.parametrize("name", (5, b"a", ["a"], True))
def test_a_name_is_a_word(name):
    assert "name = " in refusal(lambda n: Body.convex(POINTS, n), name)
    assert "name = " in refusal(lambda n: Body.from_trimesh(MESH.to_trimesh(), n), name)


@pytest.mark.parametrize("split", ("no", 1, None))
def test_split_is_true_or_false(split):
    call = lambda s: Body.from_trimesh(MESH.to_trimesh(), split=s)  # noqa: E731
    assert refusal(call, split).endswith("must be True or False.")


def test_what_is_no_body_is_not_decomposed():
    for thing in (None, POINTS, "cube"):
        assert refusal(ofg.decompose, thing).startswith("body must be an ofg.Body")


def test_a_limit_of_bytes_is_a_whole_number(tmp_path):
    (tmp_path / "a.stl").write_bytes(MESH.to_trimesh().export(file_type="stl"))
    for most in (np.inf, np.nan, "1", 0, None):
        call = lambda m: Body.from_file(tmp_path / "a.stl", most=m)  # noqa: E731
        assert refusal(call, most).startswith("most = ")


def test_points_have_three_coordinates():
    for points in (np.zeros((2, 2)), 1, []):
        assert "shape" in refusal(Pose().apply, points)


def test_a_body_of_huge_whole_numbers_is_refused():
    with pytest.raises(BodyError, match="not finite"):
        Body.convex([*POINTS.tolist(), [10**400, 0, 0]])
