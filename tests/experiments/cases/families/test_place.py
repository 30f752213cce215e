# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The constructions that gaps rest on are exact: judged in rationals."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from experiments.cases.placement import FEATURE_PAIRS, norm_matrix, rest_on, seat
from experiments.cases.scenario import snap
from experiments.cases.shapes import CONVEX_KINDS, any_convex, convex


def exact(values):
    return np.vectorize(Fraction)(np.asarray(values, float))


def heights(s, body, rotation):
    """Heights of the vertices above the contact plane, as exact fractions of a common positive
    unit.
    """
    world = exact(norm_matrix(rotation)) @ exact(body.vertices).T
    return exact(s.matrix[:, 2]) @ world


@pytest.mark.parametrize("kind", CONVEX_KINDS)
@pytest.mark.parametrize("feature, count", [("vertex", 1), ("edge", 2), ("face", 3)])
def test_rest_on_stands_exactly_on_the_feature(kind, feature, count):
    v = rest_on(convex(kind), feature, 1).vertices
    ground = v[v[:, 2] == 0]
    assert (v[:, 2] >= 0).all() and np.array_equal(v, snap(v))
    assert len(ground) >= count if feature == "face" else len(ground) == count
    if feature == "edge":
        assert (ground[:, 1] == 0).all() and ground[:, 0].min() < 0 < ground[:, 0].max()
    if (
        feature == "face"
    ):  # the origin is inside the ground polygon: no line through it leaves all of it on one side
        turn = np.sort(np.arctan2(ground[:, 1], ground[:, 0]))
        assert np.diff(np.append(turn, turn[0] + 2 * np.pi)).max() < np.pi


@settings(max_examples=40, deadline=None)
@given(st.sampled_from(FEATURE_PAIRS), st.integers(0, 10**6))
def test_seat_separates_the_bodies_by_its_plane_exactly(pair, seed):
    rng = np.random.default_rng(seed)
    s = seat(rng, any_convex(rng), any_convex(rng), pair)
    a, b = heights(s, s.a, s.rotation_a), heights(s, s.b, s.rotation_b)
    assert min(a) == 0 == max(b)
    step = s.exact(3, -2, 0, 1.0)
    assert np.array_equal(step, snap(step)) and exact(s.matrix[:, 2]) @ exact(step) == 0
