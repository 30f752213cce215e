# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The table of supports is made for the queries that need it, once, and threads may share it."""

import numpy as np
import trimesh

import ofg
from ofg import Body


def test_threads_that_ask_first_at_once_get_the_answers_of_one():
    rng = np.random.default_rng(3)
    n = 256
    poses = np.column_stack([rng.normal(size=(n, 4)), rng.normal(size=(n, 3)) * 1.2])
    origin = np.zeros((n, 7))
    origin[:, 0] = 1

    def asked(threads):
        ball = trimesh.creation.icosphere(3)
        a, b = (Body.from_trimesh(ball.copy().apply_scale(s)) for s in (1, 0.5))
        return ofg.discrete_many(a, b, poses, origin, screen=True, threads=threads).hit

    alone = asked(1)
    assert 0 < alone.sum() < n
    for _ in range(10):
        assert (asked(8) == alone).all()
