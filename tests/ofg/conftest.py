# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Bodies and poses that the tests of the core share."""

import numpy as np
import pytest
import trimesh

from ofg import Body

CUBE = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)


@pytest.fixture(scope="session")
def cube():
    return Body.convex(CUBE, "cube")


@pytest.fixture(scope="session")
def ball():
    return Body.from_trimesh(trimesh.creation.icosphere(subdivisions=2), "ball")


@pytest.fixture(scope="session")
def hulls():
    """Twenty random hulls of 8 to 76 faces: round, flat and long."""
    rng = np.random.default_rng(2)
    made = []
    for i in range(20):
        v = rng.normal(size=(6 + 2 * (i % 18), 3))
        v /= np.linalg.norm(v, axis=1)[:, None]
        made.append(Body.convex(v * rng.choice([0.05, 0.5, 1.0, 1.0], 3), f"hull{i}"))
    return made


def rows_of_poses(rng, n, spread):
    """(n, 7) random poses with positions within `spread`."""
    return np.concatenate([rng.normal(size=(n, 4)), rng.uniform(-spread, spread, (n, 3))], axis=1)


def rows_of_motions(rng, n, length, angle):
    return np.concatenate(
        [
            rng.uniform(-length, length, (n, 3)),
            rng.normal(size=(n, 3)),
            rng.uniform(-angle, angle, (n, 1)),
        ],
        axis=1,
    )
