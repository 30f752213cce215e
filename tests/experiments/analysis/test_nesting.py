# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Which bodies are inside another: containment is proved, or the case counts as any other."""

import numpy as np
import pandas as pd
import pytest

from baselines.easy_queries import box
from experiments.analysis import nesting
from experiments.run.folder.rows import body_row
from ofg import Body, Motion, Pose


def nested(a: Body, b: Body, position=(0, 0, 0), displacement=(0, 0, 0)) -> bool:
    row = {
        "case": "c",
        "label": "hit",
        "question": "translation" if any(displacement) else "overlap",
        "body_a": a.digest,
        "body_b": b.digest,
        "quaternion_a": Pose().quaternion,
        "position_a": np.array(position, float),
        "quaternion_b": Pose().quaternion,
        "position_b": np.zeros(3),
        "displacement": np.array(displacement, float),
        "displacement_b": np.zeros(3),
        "axis": Motion().axis,
        "angle": 0.0,
    }
    return bool(
        nesting.added(pd.DataFrame([row]), pd.DataFrame([body_row(a), body_row(b)])).nested[0]
    )


LARGE, SMALL = box(10, 10, 10), box(0.01, 0.01, 0.01)
WITH_ONE_INSIDE = Body.union([LARGE, box(0.5, 0.5, 1, at=(0.5, 0.5, 0))])


@pytest.mark.parametrize("swap", [False, True])
@pytest.mark.parametrize(
    "position, inside",
    [((0, 0, 0), True), ((9.9, 9.9, 9.9), True), ((10, 0, 0), False), ((12, 0, 0), False)],
)
def test_a_box_in_a_box(swap, position, inside):
    a, b = (LARGE, SMALL) if swap else (SMALL, LARGE)
    assert nested(a, b, -np.array(position) if swap else position) == inside


@pytest.mark.parametrize("displacement, inside", [((5, 5, 5), True), ((11, 0, 0), False)])
def test_a_box_that_moves_in_a_box(displacement, inside):
    assert nested(SMALL, LARGE, (0, 0, 0), displacement) == inside


@pytest.mark.parametrize(
    "end, inside",
    [
        ((-0.2, -3.0, 0.5), True),  # past the piece, behind one of its planes all the way
        # behind one plane at the start, behind another at the end, and through its corner between
        ((0.7, -0.2, 0.0), False),
        ((-0.2, -3.0, 11), False),
    ],
)
def test_a_piece_on_the_way_is_passed_behind_one_plane(end, inside):
    """Each end used to be looked at by itself, so that a small body that crossed a piece counted as
    contained.
    """
    start = np.array((-0.2, 0.5, 0.0))
    assert nested(SMALL, WITH_ONE_INSIDE, start, np.array(end) - start) == inside
