# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Triangle against triangle: against exact rational arithmetic, and on the shapes that break such
tests.
"""

import itertools
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ofg import _core


def meets(s, t):
    return bool(_core.triangles_meet(np.array([*np.ravel(s), *np.ravel(t)], float)[None])[0])


def exact(s, t):
    """Closed triangles share a point, by exact linear programming in the barycentric coordinates:
    s.lambda = t.mu has a solution.

    The feasible set is a polytope in six unknowns with five equations; it is non-empty iff a basic
    solution is feasible.
    """
    s, t = [[Fraction(int(x)) for x in p] for p in s], [[Fraction(int(x)) for x in p] for p in t]
    columns = [[*p, 1, 0] for p in s] + [[*(-x for x in p), 0, 1] for p in t]
    right = [Fraction(0)] * 3 + [Fraction(1), Fraction(1)]
    for size in (2, 3, 4, 5):
        for basis in itertools.combinations(range(6), size):
            x = _solve([columns[i] for i in basis], right)
            if x is not None and all(v >= 0 for v in x):
                return True
    return False


def _solve(columns, right):
    """The unique solution of an overdetermined exact system, or None."""
    n = len(columns)
    rows = [[Fraction(c[i]) for c in columns] + [right[i]] for i in range(len(right))]
    for j in range(n):
        pivot = next((r for r in range(j, len(rows)) if rows[r][j]), None)
        if pivot is None:
            return None
        rows[j], rows[pivot] = rows[pivot], rows[j]
        rows[j] = [v / rows[j][j] for v in rows[j]]
        for r in range(len(rows)):
            if r != j and rows[r][j]:
                rows[r] = [v - rows[r][j] * p for v, p in zip(rows[r], rows[j])]
    return None if any(r[n] for r in rows[n:]) else [rows[j][n] for j in range(n)]


corner = st.tuples(*[st.integers(-4, 4)] * 3)
triangle = st.tuples(corner, corner, corner)


@settings(max_examples=400, deadline=None)
@given(triangle, triangle)
def test_agrees_with_exact_arithmetic_on_small_integers(s, t):
    """In a grid of nine values a side touching, coplanar, collinear and doubled corners all come
    up.
    """
    assert meets(s, t) == exact(s, t)


@settings(max_examples=200, deadline=None)
@given(
    st.tuples(*[st.tuples(st.integers(-3, 3), st.integers(-3, 3), st.just(0))] * 3),
    st.tuples(*[st.tuples(st.integers(-3, 3), st.integers(-3, 3), st.just(0))] * 3),
)
def test_agrees_with_exact_arithmetic_in_one_plane(s, t):
    assert meets(s, t) == exact(s, t)


@settings(max_examples=200, deadline=None)
@given(triangle, triangle, st.permutations(range(3)), st.permutations(range(3)))
def test_order_of_corners_and_of_triangles_changes_nothing(s, t, i, j):
    assert meets(s, t) == meets(t, s) == meets([s[n] for n in i], [t[n] for n in j])


@pytest.mark.parametrize(
    "name, s, t, want",
    [
        ("the same", [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 0, 0), (1, 0, 0), (0, 1, 0)], True),
        (
            "one corner shared",
            [(0, 0, 0), (1, 0, 0), (0, 1, 0)],
            [(0, 0, 0), (-1, 0, 1), (0, -1, 1)],
            True,
        ),
        (
            "one inside the other, one plane",
            [(0, 0, 0), (9, 0, 0), (0, 9, 0)],
            [(1, 1, 0), (2, 1, 0), (1, 2, 0)],
            True,
        ),
        (
            "parallel planes",
            [(0, 0, 0), (1, 0, 0), (0, 1, 0)],
            [(0, 0, 1e-9), (1, 0, 1e-9), (0, 1, 1e-9)],
            False,
        ),
        (
            "edge grazes from above",
            [(0, 0, 0), (4, 0, 0), (0, 4, 0)],
            [(1, 1, 1e-12), (2, 1, 1e-12), (1, 1, 1)],
            False,
        ),
        (
            "edge passes just below",
            [(0, 0, 0), (4, 0, 0), (0, 4, 0)],
            [(1, 1, -1e-12), (2, 1, 1e-12), (1, 1, 1)],
            True,
        ),
        ("point on a face", [(1, 1, 0)] * 3, [(0, 0, 0), (4, 0, 0), (0, 4, 0)], True),
        ("point off a face", [(1, 1, 1e-9)] * 3, [(0, 0, 0), (4, 0, 0), (0, 4, 0)], False),
        ("two points", [(0, 0, 0)] * 3, [(0, 0, 1)] * 3, False),
        (
            "segments cross",
            [(-1, 0, 0), (1, 0, 0), (0, 0, 0)],
            [(0, -1, 0), (0, 1, 0), (0, 0, 0)],
            True,
        ),
        (
            "segments in one line, apart",
            [(0, 0, 0), (1, 0, 0), (0.5, 0, 0)],
            [(2, 0, 0), (3, 0, 0), (2.5, 0, 0)],
            False,
        ),
        (
            "parallel segments",
            [(0, 0, 0), (1, 0, 0), (0.5, 0, 0)],
            [(0, 1, 0), (1, 1, 0), (0.5, 1, 0)],
            False,
        ),
        (
            "needles in one plane, apart",
            [(0, 0, 0), (1, 0, 0), (0.5, 1e-17, 0)],
            [(0, 1e-3, 0), (1, 2e-3, 0), (0.5, 1.5e-3, 1e-18)],
            False,
        ),
    ],
)
def test_known_pairs(name, s, t, want):
    assert meets(s, t) is want, name


def test_powers_of_two_change_nothing():
    rng = np.random.default_rng(0)
    pairs = rng.normal(size=(2000, 18))
    want = _core.triangles_meet(pairs)
    assert 0.02 < want.mean() < 0.98
    for scale in (2.0**-40, 2.0**40):
        assert np.array_equal(_core.triangles_meet(pairs * scale), want)
