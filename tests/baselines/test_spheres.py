# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Spheres in front of an engine settle what they prove, and ask the engine about the rest."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import ofg
from baselines import registry, spheres
from ofg import Body, Pose, Query
from ofg.verification import prepare_spheres

CUBE = Body.convex(np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float))
OUTER, INNER = np.sqrt(3), 1.0  # radii of the spheres about and inside the cube


@given(st.floats(0, 5), st.integers(0, 2**32 - 1))
def test_the_engine_is_asked_only_where_the_spheres_prove_nothing(distance, seed):
    rng = np.random.default_rng(seed)
    way, turn = rng.normal(size=3), rng.normal(size=4)
    pose = Pose(turn, way * (distance / np.linalg.norm(way)))
    query = Query("overlap", CUBE, CUBE, pose, Pose())
    said = prepare_spheres(query, "clear", "hit", lambda: "asked")()
    off = 1e-9
    if distance > 2 * OUTER + off:
        assert said == "clear"
    elif distance < 2 * INNER - off:
        assert said == "hit"
    elif 2 * INNER + off < distance < 2 * OUTER - off:
        assert said == "asked"
    if said != "asked":
        assert (said == "hit") == ofg.verified(CUBE, CUBE, pose, Pose()).hit


@pytest.mark.parametrize("cls", spheres.METHODS, ids=lambda cls: cls.name)
def test_each_is_the_best_effort_of_its_engine_on_convex_bodies(cls):
    peer = registry.methods()[cls.name.removeprefix("spheres-")]
    assert issubclass(cls, peer) and peer.configuration == "best effort"
    assert type(cls().floor()) is peer
    assert cls.bodies == {"convex"} <= peer.bodies and cls.questions == peer.questions
