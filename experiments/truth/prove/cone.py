# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""A separating plane between two convex point sets, or the proof that there is none, in integers.

A normal n separates A from B if n.c >= 0 for every c = b - a. The remaining candidate normals form
a cone, stored as its extreme rays in order. A normal in its interior is tried; the pair of vertices
that refutes it cuts the cone, until a normal holds or nothing is left. The method is robust to very
different sizes and to thin bodies, because it uses no tolerance.
"""

from __future__ import annotations

from math import gcd, lcm

from flint import fmpz_mat

from experiments.truth.check.balls import cross, dot

ROUNDS = 400  #: cuts before giving up; some twenty suffice


def separating(*pairs: tuple[list, list]) -> list | None:
    """n with n.a <= n.b for all points of A and B, in each pair (A, B); integers. None if there is
    none.

    Points are rationals. Further pairs are, for example, the same two sets at another time.
    """
    common = lcm(*{int(c.q) for pair in pairs for side in pair for x in side for c in x})
    pairs = tuple(tuple(_whole(side, common) for side in pair) for pair in pairs)
    A, B = (rows for rows, _ in pairs[0])
    middle = [len(A) * sum(y) - len(B) * sum(x) for x, y in zip(zip(*A), zip(*B))]
    if not any(middle):
        return None
    for cone in _quarters(_reduced(middle)):
        if n := _within(cone, pairs):
            return n
    return None


def _whole(points: list, common: int) -> tuple[list, fmpz_mat]:
    rows = [[int(c.p) * (common // int(c.q)) for c in x] for x in points]
    return rows, fmpz_mat(rows)


def _within(cone: list, pairs) -> list | None:
    """A separating normal in a cone; None if it contains none."""
    for _ in range(ROUNDS):
        if not cone:
            return None
        n = _amid(cone)
        against = [c for pair in pairs if (c := _refuting(n, pair))]
        if not against:
            return n
        for c in against:
            cone = _cut(cone, c)
    return None


def _refuting(n: list, pair) -> list | None:
    """The difference b - a of the vertices that reach farthest across a plane, if they cross it."""
    (A, rows_a), (B, rows_b) = pair
    column = fmpz_mat([[c] for c in n])
    tops, lows = (rows_a * column).entries(), (rows_b * column).entries()
    top, low = max(tops), min(lows)
    if top <= low:
        return None
    return [y - x for x, y in zip(A[tops.index(top)], B[lows.index(low)])]


def _quarters(c: list) -> list[list]:
    """The half-space around c as four cones of three rays each."""
    k = min(range(3), key=lambda i: abs(c[i]))
    u = _reduced(cross(c, [int(i == k) for i in range(3)]))
    v = _reduced(cross(c, u))
    ring = [u, v, [-x for x in u], [-x for x in v]]
    return [[c, ring[i], ring[(i + 1) % 4]] for i in range(4)]


def _amid(cone: list) -> list:
    """The sum of the rays, each at about unit length; the ray itself if there is only one."""
    bits = [max(abs(c) for c in ray).bit_length() for ray in cone]
    most = max(bits)
    return _reduced([sum(c << (most - b) for c, b in zip(row, bits)) for row in zip(*cone)])


def _cut(cone: list, c: list) -> list:
    """The rays, in order, of the part of a cone where n.c >= 0."""
    height, out = [dot(ray, c) for ray in cone], []
    for i, (ray, here) in enumerate(zip(cone, height)):
        before, there = cone[i - 1], height[i - 1]
        if here * there < 0:
            out.append(_reduced([abs(there) * x + abs(here) * y for x, y in zip(ray, before)]))
        if here >= 0:
            out.append(ray)
    return [list(ray) for ray in dict.fromkeys(map(tuple, out))]


def _reduced(n: list) -> list:
    shared = gcd(*n)
    return [c // shared for c in n]
