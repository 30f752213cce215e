# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""At k no less than the number of faces OFG is the test of all pairs: on random pairs, and on what
hypothesis finds.
"""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import ofg
from ofg import Body
from tests.ofg.conftest import rows_of_motions, rows_of_poses

ALL = 10**6


def test_discrete_equals_all_pairs_on_ten_thousand_random_pairs(hulls):
    rng = np.random.default_rng(1)
    hits = 0
    for a, b in zip(hulls, hulls[1:] + hulls[:1]):
        pa, pb = rows_of_poses(rng, 500, 0), rows_of_poses(rng, 500, 0.9)
        got, want = ofg.discrete_many(a, b, pa, pb, k=ALL), ofg.brute_force_many(a, b, pa, pb)
        assert np.array_equal(got.hit, want.hit)
        hits += want.hit.sum()
    assert 1000 < hits < 9000  # the pairs do say both


@pytest.mark.parametrize("angle", [0.0, 2.0])
def test_sweep_equals_all_virtual_edges_and_faces(hulls, angle):
    rng = np.random.default_rng(3)
    hits = tunnels = 0
    for a, b in zip(hulls, hulls[3:] + hulls[:3]):
        pa, pb, m = (
            rows_of_poses(rng, 100, 3),
            rows_of_poses(rng, 100, 0),
            rows_of_motions(rng, 100, 6, angle),
        )
        got = ofg.sweep_many(a, b, pa, pb, m, k=ALL, earliest=True)
        want = ofg.brute_force_many(a, b, pa, pb, m)
        assert np.array_equal(got.hit, want.hit)
        edge = np.isin(got.found, [ofg.FOUND.index("edge-face")])
        same = np.isclose(got.time[edge], want.time[edge], rtol=0, atol=1e-9)
        assert same.all()
        hits, tunnels = hits + want.hit.sum(), tunnels + edge.sum()
    assert 100 < hits < 1900 and tunnels > 50


coordinate = st.integers(-8, 8)
point = st.tuples(coordinate, coordinate, coordinate)


@settings(max_examples=150, deadline=None)
@given(
    st.lists(point, min_size=4, max_size=12, unique=True),
    st.lists(point, min_size=4, max_size=12, unique=True),
    point,
)
def test_discrete_equals_all_pairs_on_small_integers(a, b, offset):
    """Integers make exact touching, shared planes and thin hulls common; the answer is the same
    there too.
    """
    try:
        a, b = Body.convex(np.array(a, float)), Body.convex(np.array(b, float))
    except ofg.BodyError:
        return
    pose = ofg.Pose(position=offset)
    assert (
        ofg.discrete(a, b, pose, k=ALL).hit == ofg.brute_force(ofg.Query("overlap", a, b, pose)).hit
    )


def test_k_below_the_number_of_faces_misses_and_never_invents(hulls):
    """More faces find more hits; whatever any k finds, all pairs find."""
    rng = np.random.default_rng(5)
    missed = {}
    for k in (1, 4, 16):
        missed[k] = 0
        for a, b in zip(hulls, hulls[1:]):
            pa, pb = rows_of_poses(rng, 200, 0), rows_of_poses(rng, 200, 0.8)
            got, want = (
                ofg.discrete_many(a, b, pa, pb, k=k).hit,
                ofg.brute_force_many(a, b, pa, pb).hit,
            )
            assert not (got & ~want).any()
            missed[k] += (want & ~got).sum()
    assert missed[1] > missed[4] > missed[16]


def test_adaptive_k_finds_all_at_any_k(hulls):
    """No face that could meet the other body is left out, so one face to start from is as good as
    all.
    """
    rng = np.random.default_rng(6)
    for nearest in ("centroid", "point-triangle"):
        for a, b in zip(hulls, hulls[1:]):
            pa, pb = rows_of_poses(rng, 200, 0), rows_of_poses(rng, 200, 0.9)
            got = ofg.discrete_many(a, b, pa, pb, k=1, adaptive_k=True, nearest=nearest)
            assert np.array_equal(got.hit, ofg.brute_force_many(a, b, pa, pb).hit)


@pytest.mark.parametrize("angle", [0.0, 2.0])
@pytest.mark.parametrize("times", [1, 2, 3])
def test_adaptive_k_sweeps_find_all_at_any_k(hulls, angle, times):
    rng = np.random.default_rng(8)
    options = dict(
        adaptive_k=True,
        both_vertices=True,
        edge_edge=True,
        earliest=True,
        selection_times=times,
        arc_tolerance=0.01,
    )
    for a, b in zip(hulls[:6], hulls[3:]):
        pa, pb, m = (
            rows_of_poses(rng, 50, 3),
            rows_of_poses(rng, 50, 0),
            rows_of_motions(rng, 50, 6, angle),
        )
        got, want = (ofg.sweep_many(a, b, pa, pb, m, k=k, **options) for k in (1, ALL))
        assert np.array_equal(got.hit, want.hit) and np.allclose(
            got.time, want.time, rtol=0, atol=1e-9, equal_nan=True
        )
