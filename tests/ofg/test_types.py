# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Wrong types are refused in one sentence that says what to give."""

import numpy as np
import pytest
import trimesh

import ofg
from ofg import Answers, Motion, Pose, Query, _core
from ofg.options import core_options

TRIMESH = trimesh.creation.box()
NO_BODIES = [TRIMESH, np.eye(3), None, "cube"]


def refused(error, words, call, *arguments, **options):
    with pytest.raises(error) as caught:
        call(*arguments, **options)
    text = str(caught.value)
    assert all(word in text for word in words), text
    assert text.endswith(".") and "\n" not in text


@pytest.mark.parametrize("wrong", NO_BODIES, ids=lambda x: type(x).__name__)
def test_what_is_no_body(cube, wrong):
    words = ("must be an ofg.Body", type(wrong).__name__, "Body.from_trimesh")
    refused(TypeError, ("a must", *words), ofg.discrete, wrong, cube)
    refused(TypeError, ("b must", *words), ofg.discrete_many, cube, wrong, [Pose()], Pose())
    refused(TypeError, ("Query.a", *words), Query, "overlap", wrong, cube)
    refused(TypeError, ("Query.b", *words), Query, "overlap", cube, wrong)


@pytest.mark.parametrize("wrong", [[1, 0, 0, 0], None, np.zeros(7), Motion()], ids=str)
def test_what_is_no_pose(cube, wrong):
    words = ("must be an ofg.Pose", type(wrong).__name__, "Pose(quaternion, position)")
    refused(TypeError, ("pose_a", *words), ofg.discrete, cube, cube, wrong)
    refused(TypeError, ("Query.pose_b", *words), Query, "overlap", cube, cube, Pose(), wrong)
    refused(TypeError, ("start", *words), Motion().pose_at, wrong, 0.5)
    refused(TypeError, ("pose1", *words), Motion.between, Pose(), wrong)


@pytest.mark.parametrize("wrong", [Pose(), None, (1, 0, 0)], ids=str)
def test_what_is_no_motion(cube, wrong):
    words = ("must be an ofg.Motion", type(wrong).__name__, "Motion(displacement")
    refused(TypeError, ("motion_a", *words), ofg.rotational_sweep, cube, cube, wrong)
    refused(
        TypeError, ("motion_b", *words), ofg.rotational_sweep, cube, cube, Motion(), motion_b=wrong
    )
    refused(TypeError, ("Query.motion ", *words), Query, "motion", cube, cube, motion=wrong)
    refused(TypeError, ("Query.motion_b", *words), Query, "motion", cube, cube, motion_b=wrong)


def test_what_is_no_query():
    refused(TypeError, ("query", "ofg.Query", "NoneType"), ofg.ask, None)
    refused(TypeError, ("query", "ofg.Query"), ofg.brute_force, Pose())
    refused(TypeError, ("query", "ofg.Query"), ofg.prepare, None)


@pytest.mark.parametrize("wrong", [None, 3, [1, 2], {Pose(): 1}.values(), np.array(["x"])], ids=str)
def test_what_is_no_array_of_poses(cube, wrong):
    if isinstance(wrong, type({}.values())):
        assert len(ofg.sweep_many(cube, cube, [Pose()], [Pose()], [Motion()])) == 1
        return
    refused(TypeError, ("poses_a", "(n, 7)"), ofg.discrete_many, cube, cube, wrong, Pose())
    refused(
        TypeError, ("motions_a", "(n, 10)"), ofg.sweep_many, cube, cube, [Pose()], [Pose()], wrong
    )


@pytest.mark.parametrize(
    "make, words",
    [
        (lambda: Pose("abcd"), ("Pose.quaternion", "4 numbers")),
        (lambda: Pose(position=[[1], [2, 3]]), ("Pose.position", "3 numbers")),
        (lambda: Pose(position=Pose()), ("Pose.position", "3 numbers")),
        (lambda: Motion(displacement=Pose()), ("Motion.displacement", "3 numbers")),
        (lambda: Motion(angle="right"), ("Motion.angle", "number")),
        (lambda: Motion(angle=None), ("Motion.angle", "number")),
        (lambda: Motion.degrees(angle=[90, 45]), ("angle", "number")),
    ],
)
def test_what_is_no_number(make, words):
    refused(TypeError, words, make)


@pytest.mark.parametrize(
    "error, options, words",
    [
        (TypeError, {"repairs": ["arcs"]}, ("repairs", "'arcs+containment'")),
        (TypeError, {"repairs": None}, ("repairs", "string")),
        (ValueError, {"k": np.inf}, ("k = inf", "whole number")),
        (ValueError, {"k": np.nan}, ("k = nan", "whole number")),
        (ValueError, {"k": None}, ("k = None", "whole number")),
        (ValueError, {"k": True}, ("k = True", "whole number")),
        (ValueError, {"k": 2**40}, ("2147483647",)),
        (TypeError, {"containment": "False"}, ("containment = 'False'", "True or False")),
        (TypeError, {"screen": 1}, ("screen = 1", "True or False")),
        (TypeError, {"arc_tolerance": "small"}, ("arc_tolerance", "number")),
        (ValueError, {"arc_tolerance": np.nan}, ("arc_tolerance",)),
        (ValueError, {"toi": None}, ("toi = None", "velocity")),
        (ValueError, {"precision": None}, ("precision = None", "double")),
        (TypeError, {"selection": "centroid"}, ("'selection'", "called 'nearest'")),
        (TypeError, {"selections": 3}, ("'selections'", "called 'selection_times'")),
    ],
)
def test_options_of_wrong_types(cube, error, options, words):
    refused(error, words, ofg.discrete, cube, cube, **options)
    refused(error, words, ofg.prepare, Query("overlap", cube, cube), **options)


@pytest.mark.parametrize("threads", [1.5, 0, -1, 2000, "all", np.nan, True])
def test_threads_are_bounded(cube, threads):
    """2000 of them aborted the interpreter."""
    words = ("threads", "from 1 to 256", "None for one per core")
    refused(ValueError, words, ofg.discrete_many, cube, cube, [Pose()] * 3, Pose(), threads=threads)


def test_answers_do_not_depend_on_threads(cube):
    poses = [Pose(position=(x, 0, 0)) for x in np.linspace(0, 4, 300)]
    want = ofg.discrete_many(cube, cube, poses, Pose())
    for threads in (2, 256, None):
        got = ofg.discrete_many(cube, cube, poses, Pose(), threads=threads)
        assert np.array_equal(got.hit, want.hit) and np.array_equal(got.counts, want.counts)


def test_many_answers_are_neither_true_nor_false(cube):
    answers = ofg.discrete_many(cube, cube, [Pose(position=(9, 0, 0))], Pose())
    assert isinstance(answers, Answers) and not answers.hit.any() and len(answers) == 1
    refused(ValueError, ("ambiguous", "answers.hit.any()"), bool, answers)
    assert not answers[0]


GOOD = np.eye(4, 3), np.array([[0, 1, 2]], np.int32)


@pytest.mark.parametrize(
    "vertices, faces, word",
    [
        (np.eye(4), GOOD[1], "columns"),
        (GOOD[0], np.array([[0, 1]], np.int32), "columns"),
        (GOOD[0], np.array([[0, 1, 4]], np.int32), "not there"),
        (GOOD[0], np.array([[0, 1, -1]], np.int32), "not there"),
        (GOOD[0] * np.nan, GOOD[1], "finite"),
        (GOOD[0] + np.inf, GOOD[1], "finite"),
        (np.zeros((0, 3)), GOOD[1], "needs a vertex"),
        (GOOD[0], np.zeros((0, 3), np.int32), "needs a vertex"),
    ],
)
def test_native_code_refuses_meshes_that_it_would_read_past(vertices, faces, word):
    with pytest.raises(ValueError, match=word):
        _core.Solid(vertices, faces, False, [], [])
    with pytest.raises(ValueError, match=word):
        _core.Solid(*GOOD, False, [vertices], [faces])


def test_native_code_refuses_pieces_without_faces():
    with pytest.raises(ValueError, match="one length"):
        _core.Solid(*GOOD, False, [GOOD[0]], [])


@pytest.mark.parametrize("at", range(4))
@pytest.mark.parametrize("spoil", ["columns", "rows", "nan"])
def test_native_code_refuses_arrays_that_it_would_read_past(at, spoil):
    body = _core.Solid(*GOOD, False, [], [])
    arrays = [np.ones((2, 7)), np.ones((2, 7)), np.ones((2, 10)), np.ones((2, 10))]
    if spoil == "columns":
        arrays[at] = arrays[at][:, :-1].copy()
    elif spoil == "rows":
        arrays[at] = arrays[at][:1].copy() if at else np.ones((3, 7))
    else:
        arrays[at][1, 4] = np.nan
    with pytest.raises(ValueError, match=spoil if spoil != "nan" else "finite"):
        _core.ask_many(body, body, *arrays, core_options(), 0, True, False, 1)
    if spoil != "rows":
        rows = [np.ones((2, 7)), np.ones((2, 10))]
        rows[at // 2] = arrays[at]
        with pytest.raises(ValueError):
            _core.Prepared(body, body, *rows, core_options(), 0, True, False)


def test_native_code_refuses_options_out_of_range():
    body = _core.Solid(*GOOD, False, [], [])
    arrays = [np.ones((1, 7)), np.ones((1, 7)), np.ones((1, 10)), np.ones((1, 10))]
    for name, value in (
        ("k", 0),
        ("selection_times", 4),
        ("toi", 4),
        ("order", 2),
        ("nearest", -1),
        ("concave", 7),
    ):
        options = core_options()
        setattr(options, name, value)
        with pytest.raises(ValueError, match="out of range"):
            _core.ask_many(body, body, *arrays, options, 0, True, False, 1)
    with pytest.raises(ValueError, match="algorithm"):
        _core.ask_many(body, body, *arrays, core_options(), 3, True, False, 1)
