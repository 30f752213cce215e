# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""A common point of two coplanar point sets, in rationals."""

from __future__ import annotations

from flint import fmpq


def meeting(A: list, B: list, normal: list) -> tuple[list, list] | None:
    """Convex weights that give one point of the hulls of A and of B, which lie in one plane.

    Exact, without a tolerance: a corner of one in the other, or two edges that cross.
    """
    drop = max(range(3), key=lambda i: abs(normal[i]))
    flat = [[[x[i] for i in range(3) if i != drop] for x in side] for side in (A, B)]
    (P, a), (Q, b) = ((points, _hull(points)) for points in flat)
    for i in a:
        if inside := _inside(Q, b, P[i]):
            return _listed({i: fmpq(1)}, len(A)), _listed(inside, len(B))
    for j in b:
        if inside := _inside(P, a, Q[j]):
            return _listed(inside, len(A)), _listed({j: fmpq(1)}, len(B))
    for i, k in _edges(a):
        for j, m in _edges(b):
            if shares := _crossing(P[i], P[k], Q[j], Q[m]):
                s, t = shares
                return _listed({i: 1 - s, k: s}, len(A)), _listed({j: 1 - t, m: t}, len(B))
    return None


def _listed(weights: dict, n: int) -> list:
    return [weights.get(k, fmpq(0)) for k in range(n)]


def _turn(p, q, r):
    """Twice the area of a triangle, positive if it runs counter-clockwise."""
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])


def _hull(points: list) -> list[int]:
    """Indices of the corners of the hull, counter-clockwise; one or two if it is degenerate."""
    order = sorted(range(len(points)), key=points.__getitem__)
    chains = []
    for way in (order, order[::-1]):
        chain: list[int] = []
        for k in way:
            if chain and points[k] == points[chain[-1]]:
                continue
            while len(chain) > 1 and _turn(*(points[i] for i in (chain[-2], chain[-1], k))) <= 0:
                chain.pop()
            chain.append(k)
        chains.append(chain)
    return chains[0][:-1] + chains[1][:-1] or order[:1]


def _edges(ring: list[int]) -> list[tuple[int, int]]:
    return list(zip(ring, ring[1:] + ring[:1])) if len(ring) > 2 else [tuple(ring)][: len(ring) - 1]


def _inside(points: list, ring: list[int], p) -> dict | None:
    """Convex weights of corners of a hull that give the point p; None if it is outside."""
    if len(ring) < 3:
        return _along(points, ring, p)
    for j, k in zip(ring[1:], ring[2:]):
        corners = [points[i] for i in (ring[0], j, k)]
        whole = _turn(*corners)
        parts = [_turn(*(p if m == i else corners[m] for m in range(3))) for i in range(3)]
        if min(parts) >= 0:
            return {i: w / whole for i, w in zip((ring[0], j, k), parts)}
    return None


def _along(points: list, ring: list[int], p) -> dict | None:
    a, b = points[ring[0]], points[ring[-1]]
    if a == b:
        return {ring[0]: fmpq(1)} if p == a else None
    axis = 0 if a[0] != b[0] else 1
    share = (p[axis] - a[axis]) / (b[axis] - a[axis])
    fits = _turn(a, b, p) == 0 and 0 <= share <= 1
    return {ring[0]: 1 - share, ring[1]: share} if fits else None


def _crossing(p, q, r, s) -> tuple | None:
    """The parameters of two segments at which they cross; None for parallel ones."""
    one, other = _turn(r, s, p), _turn(r, s, q)
    if one == other:
        return None
    share, at = one / (one - other), _turn(p, q, r)
    there = at / (at - _turn(p, q, s))
    return (share, there) if 0 <= share <= 1 and 0 <= there <= 1 else None
