# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Every way into native code checks what it is given by itself: numbers, shapes and indices."""

import itertools

import numpy as np
import pytest

import ofg
from experiments.truth.prove import _native
from ofg import Body, _core

CUBE = Body.convex(np.array(list(itertools.product((0.0, 1.0), repeat=3))))
V, F = CUBE.vertices, CUBE.faces
BAD = {
    "an index of a million": (V, np.where(F == 0, 10**6, F)),
    "a negative index": (V, F - 1),
    "no face": (V, F[:0]),
    "no vertex": (V[:0], F),
    "a number that is none": (np.where(V == 0, np.nan, V), F),
    "an infinite one": (np.where(V == 0, np.inf, V), F),
    "two columns": (V[:, :2].copy(), F),
    "a list": (V.tolist(), F),
    "words": (V.astype(str), F),
    "not in a row": (V[::2], F[::2]),
    "faces of doubles": (V, F + 1e6),
}


@pytest.mark.parametrize("what", BAD)
def test_a_malformed_body_is_refused(what):
    """The prover's binding checked nothing, and died."""
    v, f = BAD[what]
    f = f if f.dtype == float else f.astype(np.int32)
    for make in (
        lambda: _core.Solid(v, f, False, [], []),
        lambda: _core.Solid(V, F, False, [v], [f]),
        lambda: _native.Solid.of_mesh(v, f),
    ):
        with pytest.raises((ValueError, TypeError)):
            make()


def test_the_prover_refuses_what_is_no_body_no_pose_and_no_time():
    solid = _native.Solid.of_mesh(V, F)
    still = _native.Mover([1, 0, 0, 0], [0] * 3, [0] * 3, [0, 0, 1], 0.0, [0] * 3)
    for pieces in ([], [V[:0]], [np.full((4, 3), np.nan)]):
        with pytest.raises(ValueError):
            _native.Solid.of_pieces(pieces)
    for q, p, theta in (
        ([0] * 4, [0] * 3, 0.0),
        ([1, 0, 0, np.nan], [0] * 3, 0.0),
        ([1, 0, 0, 0], [np.inf, 0, 0], 0.0),
        ([1, 0, 0, 0], [0] * 3, np.nan),
    ):
        with pytest.raises(ValueError):
            _native.Mover(q, p, [0] * 3, [0, 0, 1], theta, [0] * 3)
    pair = _native.Pair(still, still)
    for t, limit in ((np.nan, 1.0), (2.0, 1.0), (0.0, np.nan), (0.0, -1.0), (0.0, np.inf)):
        with pytest.raises(ValueError):
            _native.instant(pair, solid, solid, t, limit, {})


def asked(poses=None, motions=None, single=False, threads=1, solid=None):
    solid = solid or _core.Solid(V, F, True, [], [])
    poses = np.array([[1.0, 0, 0, 0, 0, 0, 0]]) if poses is None else poses
    motions = np.array([[0.0, 0, 0, 0, 0, 1, 0, 0, 0, 0]]) if motions is None else motions
    return _core.ask_many(
        solid, solid, poses, poses, motions, motions, _core.Options(), 0, True, single, threads
    )


def test_the_core_refuses_poses_motions_and_threads_out_of_range():
    assert asked()[0].all()
    for poses in (
        [[0.0] * 7],
        [[1e301, 0, 0, 0, 0, 0, 0]],
        [[1, 0, 0, 0, 1e61, 0, 0]],
        [[1, 0, 0, 0, np.nan, 0, 0]],
    ):
        with pytest.raises(ValueError):
            asked(poses=np.array(poses, float))
    for motions in (
        [[1e61, 0, 0, 0, 0, 1, 0, 0, 0, 0]],
        [[0, 0, 0, 0, 0, 0, 1, 0, 0, 0]],
        [[0, 0, 0, 0, 0, 1, 1e10, 0, 0, 0]],
    ):
        with pytest.raises(ValueError):
            asked(motions=np.array(motions, float))
    for threads in (0, -1, 257, 2000, 2**31 - 1):
        with pytest.raises(ValueError, match="threads must be 1 to 256"):
            asked(threads=threads)


def test_a_body_out_of_the_range_of_floats_has_no_float_form():
    """Its coordinates were infinite in float, and sorted."""
    large = _core.Solid(V * 1e50, F, True, [], [])
    assert asked(solid=large)[0].all()
    with pytest.raises(ValueError, match="single precision"):
        asked(solid=large, single=True)


@pytest.mark.parametrize("threads", [0, -1, 2000, 2**40, 1.5, True, np.nan, "2", []])
def test_threads_are_a_whole_number_from_1_to_256(threads):
    with pytest.raises(ValueError, match="threads"):
        ofg.discrete_many(CUBE, CUBE, [ofg.Pose()], [ofg.Pose()], threads=threads)


def test_pieces_larger_than_their_whole_find_room():
    """Room was made for pairs of pieces, and none where one body had no pieces: a piece larger than
    its whole wrote past it.
    """
    points = np.random.default_rng(1).normal(size=(20_000, 3))
    ball = Body.convex(points / np.linalg.norm(points, axis=1)[:, None])
    odd, plain = (
        _core.Solid(V, F, False, [ball.vertices], [ball.faces]),
        _core.Solid(V, F, False, [], []),
    )
    poses, motions = (
        np.array([[1.0, 0, 0, 0, 0, 0, 0]]),
        np.array([[0.1, 0, 0, 0, 0, 1, 0.5, 0, 0, 0]]),
    )
    options = _core.Options()
    options.k = 10**6
    assert _core.ask_many(odd, plain, poses, poses, motions, motions, options, 0, True, False, 1)[
        0
    ].shape == (1,)
