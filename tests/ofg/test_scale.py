# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Lengths times a power of two change no answer, not in its last bit, at any size supported."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import ofg
from ofg import Body, _core
from tests.ofg.conftest import rows_of_poses

FIELDS = ("hit", "time", "found", "faces", "pieces", "counts")
OPTIONS = (
    {"k": 8},
    {"k": 8, "toi": "bisection"},
    {"k": 8, "repairs": "point-triangle+both-vertices+edge-edge"},
    {"k": 8, "repairs": "all", "arc_tolerance": 1e-3},
    {"k": 10**6, "screen": True, "edge_edge": True, "earliest": True},
)
POWERS = {"double": (-190, -100, 30, 100, 190), "float": (-32, -18, 18, 30)}


def hull(rng):
    flat = rng.choice([1.0, 1.0, 1e-3], 3)
    flat[rng.integers(3)] = 1.0  # or the least float size would be below what is supported
    return Body.convex(rng.integers(-8, 9, (20, 3)) * flat / 8.0 + rng.integers(-1, 2, 3))


def rows(rng, n, angle):
    pa, pb = rows_of_poses(rng, n, 2), rows_of_poses(rng, n, 1)
    motions = [
        np.concatenate(
            [
                rng.uniform(-4, 4, (n, 3)),
                rng.normal(size=(n, 3)),
                rng.uniform(-angle, angle, (n, 1)),
                rng.uniform(-2, 2, (n, 3)),
            ],
            axis=1,
        )
        for _ in "ab"
    ]
    return [pa, pb, *motions]


def scaled(arrays, by):
    pa, pb, ma, mb = (a.copy() for a in arrays)
    for poses in (pa, pb):
        poses[:, 4:] *= by
    for motions in (ma, mb):
        motions[:, :3] *= by
        motions[:, 7:] *= by
    return pa, pb, ma, mb


def ask(a, b, arrays, options, precision):
    pa, pb, ma, mb = arrays
    if options is None:
        return (
            ofg.brute_force_many(a, b, pa, pb, precision=precision),
            ofg.brute_force_many(a, b, pa, pb, ma, mb, precision=precision),
        )
    return (
        ofg.discrete_many(a, b, pa, pb, precision=precision, **options),
        ofg.sweep_many(a, b, pa, pb, ma, mb, precision=precision, **options),
    )


@pytest.mark.parametrize("precision", ["double", "float"])
@settings(max_examples=15, deadline=None)
@given(st.integers(0, 2**32 - 1), st.sampled_from([0.0, 2.0]))
def test_a_power_of_two_changes_no_answer(precision, seed, angle):
    """Sweeps in float changed from 2^20 on, and in double from 2^170: the test of edges against
    edges multiplies eight lengths with one another."""
    rng = np.random.default_rng(seed)
    a, b, arrays = hull(rng), hull(rng), rows(rng, 8, angle)
    widest = _core.widest_isa()
    try:
        for isa in range(widest + 1):
            _core.set_isa(isa)
            for options in (*OPTIONS, None):
                want = ask(a, b, arrays, options, precision)
                for power in POWERS[precision]:
                    by = 2.0**power
                    bodies = [same_but_for_size(x, by) for x in (a, b)]
                    got = ask(*bodies, scaled(arrays, by), options, precision)
                    for w, g in zip(want, got):
                        for field in FIELDS:
                            x, y = getattr(w, field), getattr(g, field)
                            assert np.array_equal(x, y, equal_nan=field == "time"), (
                                field,
                                options,
                                power,
                            )
    finally:
        _core.set_isa(widest)


def same_but_for_size(body, by):
    """The very faces: a hull made anew may divide its flat sides in another way."""
    return Body.unchecked("convex", body.vertices * by, body.faces, (), body.name)
