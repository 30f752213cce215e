"""A plane between two convex point sets, or the proof that there is none, in whole numbers.

A normal n separates A from B if n.c >= 0 for every c = b - a. The normals still possible form a
cone, kept by its extreme rays in order. A normal amid them is tried; the pair of vertices that
refutes it cuts the cone, until a normal stands or nothing is left. Sizes, however unlike, and thin
bodies do not matter: nothing is compared with a tolerance.
"""

from __future__ import annotations

from math import gcd, lcm

from flint import fmpz_mat

from .balls import cross, dot

ROUNDS = 400  #: cuts before giving up; some twenty do


def separating(A: list, B: list) -> list | None:
    """n with n.a <= n.b for all points (rationals); whole numbers. None if there is none."""
    common = lcm(*(int(c.q) for side in (A, B) for x in side for c in x))
    A, B = ([[int(c.p) * (common // int(c.q)) for c in x] for x in side] for side in (A, B))
    middle = [len(A) * sum(y) - len(B) * sum(x) for x, y in zip(zip(*A), zip(*B))]
    if not any(middle):
        return None
    sides = (A, fmpz_mat(A)), (B, fmpz_mat(B))
    for cone in _quarters(_reduced(middle)):
        if n := _within(cone, *sides):
            return n
    return None


def _within(cone: list, side_a, side_b) -> list | None:
    """A separating normal in a cone; None if it holds none."""
    (A, rows_a), (B, rows_b) = side_a, side_b
    for _ in range(ROUNDS):
        if not cone:
            return None
        n = _amid(cone)
        column = fmpz_mat([[c] for c in n])
        tops, lows = (rows_a * column).entries(), (rows_b * column).entries()
        top, low = max(tops), min(lows)
        if top <= low:
            return n
        a, b = A[tops.index(top)], B[lows.index(low)]
        cone = _cut(cone, [y - x for x, y in zip(a, b)])
    return None


def _quarters(c: list) -> list[list]:
    """The half-space around c as four cones of three rays each."""
    k = min(range(3), key=lambda i: abs(c[i]))
    u = _reduced(cross(c, [int(i == k) for i in range(3)]))
    v = _reduced(cross(c, u))
    ring = [u, v, [-x for x in u], [-x for x in v]]
    return [[c, ring[i], ring[(i + 1) % 4]] for i in range(4)]


def _amid(cone: list) -> list:
    """The sum of the rays at about one length each; the ray itself where there is one."""
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
