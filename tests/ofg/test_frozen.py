# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""A query that was sent to another process is as read-only as the one it was made from."""

import copy
import pickle

import numpy as np
import pytest

from ofg import Body, Motion, Pose, Query

CUBE = Body.convex(np.array(np.meshgrid([-1, 1], [-1, 1], [-1, 1])).reshape(3, -1).T)
QUERY = Query(
    "motion",
    CUBE,
    Body.union([CUBE, CUBE]),
    Pose(),
    Pose(position=(3, 0, 0)),
    Motion((1, 0, 0), (0, 0, 1), 1.0),
)


@pytest.mark.parametrize(
    "copied", [lambda q: q, lambda q: pickle.loads(pickle.dumps(q)), copy.deepcopy]
)
def test_no_array_of_a_query_can_be_written(copied):
    """Pickled arrays can be: a method that wrote into its query changed that of the methods after
    it.
    """
    query = copied(QUERY)
    bodies = [query.a, query.b, *query.b.pieces]
    arrays = [
        getattr(o, name)
        for o in (*bodies, query.pose_a, query.pose_b, query.motion, query.motion_b)
        for name in vars(o)
        if isinstance(getattr(o, name), np.ndarray)
    ]
    assert len(arrays) > 14
    for array in arrays:
        with pytest.raises(ValueError, match="read-only"):
            array[:] = 0
    assert query.a.digest == QUERY.a.digest
