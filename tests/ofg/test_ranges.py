# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Numbers within the supported range mean what they say; those outside are refused, by name."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import ofg
from ofg import Body, Motion, Pose
from tests.ofg.conftest import CUBE, rows_of_poses

exponents = st.integers(-990, 990)


def answers_are_one(one, other):
    for field in ("hit", "time", "found", "faces", "counts"):
        x, y = getattr(one, field), getattr(other, field)
        assert np.array_equal(x, y, equal_nan=field == "time"), field


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32 - 1), exponents, exponents, st.booleans())
def test_the_length_of_a_quaternion_and_of_an_axis_changes_nothing(cube, seed, p, q, screen):
    """Quaternions of length 1e-200 and 1e160 answered "hit" at a distance of 100; an axis of length
    1e-200 lost the time, and one of 1e200 the hit."""
    rng = np.random.default_rng(seed)
    pa, pb = rows_of_poses(rng, 40, 2), rows_of_poses(rng, 40, 1)
    motions = rng.normal(size=(40, 10))
    long_a, long_b, long_m = pa.copy(), pb.copy(), motions.copy()
    long_a[:, :4] *= 2.0**p
    long_b[:, :4] *= 2.0**q
    long_m[:, 3:6] *= 2.0**p
    answers_are_one(
        ofg.discrete_many(cube, cube, pa, pb, screen=screen),
        ofg.discrete_many(cube, cube, long_a, long_b, screen=screen),
    )
    answers_are_one(
        ofg.sweep_many(cube, cube, pa, pb, motions, motions[::-1].copy(), repairs="all"),
        ofg.sweep_many(cube, cube, long_a, long_b, long_m, long_m[::-1].copy(), repairs="all"),
    )


@settings(max_examples=100, deadline=None)
@given(st.integers(0, 2**32 - 1), exponents)
def test_python_says_the_same_of_lengths(seed, p):
    rng = np.random.default_rng(seed)
    q, axis = rng.normal(size=4), rng.normal(size=3)
    assert np.array_equal(Pose(q * 2.0**p).rotation, Pose(q).rotation)
    ends = []
    for by in (1.0, 2.0**p):
        motion = Motion((1, 2, 3), axis * by, 2.0, (1, 0, 0))
        ends.append(motion.pose_at(Pose(q * by, (1, 1, 1)), 0.7))
    assert np.array_equal(ends[0].rotation, ends[1].rotation)
    assert np.array_equal(ends[0].position, ends[1].position)


def test_apart_is_apart_however_far(cube):
    for far in (1e2, 1e20, 1e40, 9.9e59):
        for pose in (Pose((1e-200, 0, 0, 0), (far, 0, 0)), Pose((1e160, 1e160, 0, 0), (0, far, 0))):
            assert not ofg.discrete(cube, cube, pose) and not ofg.discrete(cube, cube, Pose(), pose)
            assert not ofg.brute_force(ofg.Query("overlap", cube, cube, pose))
            near = Pose(pose.quaternion, pose.position + 0.5 * (far == 1e2))
            assert ofg.discrete(cube, cube, pose, near)  # both far from the origin, and together


@pytest.mark.parametrize("size", [2e-60, 1e-30, 1e30, 5e59])
def test_bodies_of_any_supported_size(size):
    cube = Body.convex(CUBE * size)
    for options in ({}, {"repairs": "all"}, {"screen": True}, {"k": 12, "repairs": "containment"}):
        assert not ofg.discrete(
            cube,
            cube,
            (
                Pose(position=(2.1 * size, 0, 0))
                if size < 1e59
                else Pose(position=(0.9e60, 0.9e60, 0.9e60))
            ),
            Pose(position=(-0.9e60 * (size > 1e59), 0, 0)),
            **options,
        )
        assert ofg.discrete(
            cube,
            cube,
            Pose(position=(1.9 * size, 0, 0) if size < 1e59 else (size, 0, 0)),
            **options,
        )


subnormal, huge = 5e-324, 1.7e308


@pytest.mark.parametrize(
    "make, words",
    [
        (lambda x: Pose((subnormal, 0, 0, 0)), ("Pose.quaternion", "e-324", "1e-300", "1e+300")),
        (lambda x: Pose((1e-301, 0, 0, 1e-301)), ("Pose.quaternion", "1e-300")),
        (lambda x: Pose((huge, 0, 0, 0)), ("Pose.quaternion", "1e+300")),
        (lambda x: Pose(position=(1e61, 0, 0)), ("Pose.position", "1e+61", "1e+60")),
        (lambda x: Motion((0, 1e200, 0)), ("Motion.displacement", "1e+200", "1e+60")),
        (lambda x: Motion(about=(0, 1e200, 0), angle=1), ("Motion.about", "1e+60")),
        (lambda x: Motion(axis=(0, 0, subnormal), angle=1), ("Motion.axis", "1e-300")),
        (lambda x: Motion(axis=(huge, 0, 0), angle=1), ("Motion.axis", "1e+300")),
        (lambda x: Motion(angle=1e10), ("Motion.angle", "1e+10", "1e+09")),
        (lambda x: ofg.discrete_many(x, x, rows(0, 1e-310), Pose()), ("poses_a[1].quaternion",)),
        (
            lambda x: ofg.discrete_many(x, x, rows(4, 1e99), Pose()),
            ("poses_a[1].position", "1e+60"),
        ),
        (lambda x: swept(x, 0, 1e99), ("motions_a[1].displacement", "1e+60")),
        (lambda x: swept(x, 8, 1e99), ("motions_a[1].about", "1e+60")),
        (lambda x: swept(x, 5, 1e-310), ("motions_a[1].axis", "1e-300")),
        (lambda x: swept(x, 6, 1e10), ("motions_a[1].angle", "1e+09")),
        (lambda x: ofg.discrete(Body.convex(CUBE * 1e61, "moon"), x), ("'moon'", "1e+61", "1e+60")),
        (lambda x: ofg.discrete(Body.convex(CUBE * 1e-61, "atom"), x), ("'atom'", "1e-60")),
        (
            lambda x: ofg.discrete(Body.convex(CUBE * 1e11, "sun"), x, precision="float"),
            ("'sun'", "1e+10", "double"),
        ),
        (
            lambda x: ofg.translational_sweep(x, x, (1e11, 0, 0), precision="float"),
            ("displacement of A relative to B", "1e+10", "double"),
        ),
        (
            lambda x: ofg.discrete(x, x, Pose(position=(1e11, 0, 0)), precision="float"),
            ("position of A relative to B", "1e+10"),
        ),
    ],
)
def test_what_is_out_of_range_is_refused_in_one_sentence(cube, make, words):
    with pytest.raises(ValueError) as refused:
        make(cube)
    text = str(refused.value)
    assert all(w in text for w in words), text
    assert text.endswith(".") and "\n" not in text and ". " not in text.replace("...", "")


def rows(column, value):
    made = np.tile([1.0, 0, 0, 0, 0, 0, 0], (3, 1))
    made[1, column] = value
    return made


def swept(body, column, value):
    motions = np.tile([1.0, 0, 0, 0, 0, 1, 1, 0, 0, 0], (3, 1))
    motions[1, column] = value
    return ofg.sweep_many(body, body, [Pose()] * 3, Pose(), motions)


def test_in_float_only_relative_positions_count(cube):
    far = np.array([1e15, 0, 0])
    for pose, hit in ((far + [1.5, 0, 0], True), (far + [3, 0, 0], False)):
        got = ofg.discrete(cube, cube, Pose(position=far), Pose(position=pose), precision="float")
        assert got.hit == hit
