# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""SSE2, AVX2 and AVX-512 give the same answers to the last bit: verdicts, faces, times and
counts.
"""

import numpy as np
import pytest
import trimesh

import ofg
from ofg import Body, _core

from .conftest import CUBE, rows_of_motions, rows_of_poses

FIELDS = ("hit", "time", "found", "faces", "pieces", "counts")
NAMES = ("sse2", "avx2", "avx512")


@pytest.fixture
def each_isa():
    """A function that asks once per instruction set of this machine."""
    widest = _core.widest_isa()

    def ask(question):
        answers = {}
        for isa in range(widest + 1):
            assert _core.set_isa(isa)
            answers[NAMES[isa]] = question()
        return answers

    yield ask
    _core.set_isa(widest)


def assert_all_equal(answers):
    first = answers["sse2"]
    for name, other in answers.items():
        for field in FIELDS:
            assert np.array_equal(
                getattr(other, field), getattr(first, field), equal_nan=field == "time"
            ), (name, field)


@pytest.mark.parametrize("precision", ["double", "float"])
@pytest.mark.parametrize(
    "options", [{"k": 3}, {"k": 8}, {"k": 16}, {"k": 40}, {"k": 10**6}, {"repairs": "all"}], ids=str
)
def test_instruction_sets_agree_to_the_last_bit(each_isa, hulls, options, precision):
    rng = np.random.default_rng(1)
    ball = Body.from_trimesh(trimesh.creation.icosphere(subdivisions=3), "1280 faces")
    for a, b in [(hulls[0], hulls[1]), (hulls[4], hulls[17]), (ball, hulls[9]), (ball, ball)]:
        n = 60 if b is ball else 200
        pa, pb, m = (
            rows_of_poses(rng, n, 0),
            rows_of_poses(rng, n, 1.5),
            rows_of_motions(rng, n, 3, 1),
        )
        assert_all_equal(
            each_isa(lambda: ofg.discrete_many(a, b, pa, pb, precision=precision, **options))
        )
        if b is not ball:
            assert_all_equal(
                each_isa(lambda: ofg.sweep_many(a, b, pa, pb, m, precision=precision, **options))
            )


def test_instruction_sets_agree_on_ties_and_touching(each_isa):
    """Cubes on a grid: most distances are equal, most faces touch or share a plane."""
    cube = Body.convex(CUBE, "cube")
    rng = np.random.default_rng(2)
    pb = np.column_stack([np.tile([1.0, 0, 0, 0], (400, 1)), rng.integers(-4, 5, (400, 3)) / 2])
    for k in (1, 5, 12):
        assert_all_equal(each_isa(lambda: ofg.discrete_many(cube, cube, ofg.Pose(), pb, k=k)))
        assert_all_equal(
            each_isa(lambda: ofg.sweep_many(cube, cube, pb, ofg.Pose(), ofg.Motion((2, 1, 0)), k=k))
        )


def test_blocks_select_what_a_full_sort_selects(hulls):
    """The faces that met are the first pair in the article's order, found here by sorting all
    distances in numpy.
    """
    rng = np.random.default_rng(3)
    ball = Body.from_trimesh(trimesh.creation.icosphere(subdivisions=3), "ball")
    lumpy = Body.convex(rng.normal(size=(300, 3)), "lumpy")
    for a, b in [(ball, lumpy), (lumpy, ball), (hulls[15], hulls[16])]:
        for _ in range(40):
            pose = ofg.Pose(position=rng.uniform(-2, 2, 3))
            centres = [x.vertices[x.faces].mean(axis=1) for x in (a, b)]
            order_a = np.argsort(
                np.linalg.norm(centres[0] - (b.vertices.mean(axis=0) - pose.position), axis=1),
                kind="stable",
            )[:8]
            selected = centres[0][order_a].mean(axis=0) + pose.position
            order_b = np.argsort(np.linalg.norm(centres[1] - selected, axis=1), kind="stable")[:8]
            answer = ofg.discrete(a, b, pose)
            if answer and answer.counts["face_pairs"]:
                pairs = [(int(i), int(j)) for i in order_a for j in order_b]
                assert answer.faces == pairs[answer.counts["face_pairs"] - 1]
