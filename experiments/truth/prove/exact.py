# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The exact time of impact of two convex bodies in translation: the linear program min t, t d in B
- A, solved in rationals.

A support-function simplex: three points of B - A whose triangle is pierced by the ray along d; the
support point of the triangle's plane replaces one of them until none is lower (Snethen 2008 calls
the triangle a portal). Doubles select the first triangle.
"""

from __future__ import annotations

from functools import cache
from itertools import combinations

import numpy as np

from experiments.truth.check.balls import (
    add,
    cross,
    dot,
    mul,
    rational,
    rotation,
    transposed,
    vector,
)
from experiments.truth.check.geometry import support
from ofg import Query

ROUNDS = 60


def exact_time(query: Query, piece_a: int, piece_b: int, plane) -> dict | None:
    """The certificate's `exact` for these pieces, from a plane (3 doubles) near the touching
    one; None if it degenerates.
    """
    a, b = query.a.pieces[piece_a], query.b.pieces[piece_b]
    d = add(vector(query.motion.displacement), vector(query.motion_b.displacement), -1)
    RA, RB = (rotation(*map(rational, p.quaternion)) for p in (query.pose_a, query.pose_b))
    dp = add(vector(query.pose_b.position), vector(query.pose_a.position), -1)

    def point(i, j):
        return add(add(mul(RB, vector(b.vertices[j])), dp), mul(RA, vector(a.vertices[i])), -1)

    for start in _portals(query, a.vertices, b.vertices, plane):
        corners = [(i, j, point(i, j)) for i, j in start]
        if _pierced([c for _, _, c in corners], d) is not None:
            break
    else:
        return None
    for _ in range(ROUNDS):
        weights = _pierced([c for _, _, c in corners], d)
        if weights is None:
            return None
        n = cross(add(corners[1][2], corners[0][2], -1), add(corners[2][2], corners[0][2], -1))
        if dot(n, d) < 0:
            n = [-c for c in n]
        if dot(n, d) == 0:
            return None
        i, j = support(a, transposed(RA, n))[1], support(b, transposed(RB, [-c for c in n]))[1]
        lowest = point(i, j)
        if dot(n, lowest) == dot(n, corners[0][2]):
            t = dot(n, lowest) / dot(n, d)
            return {
                "time": str(t),
                "normal": [str(c) for c in n],
                "a": {
                    "piece": piece_a,
                    "vertices": [i for i, _, _ in corners],
                    "weights": [str(w) for w in weights],
                },
                "b": {
                    "piece": piece_b,
                    "vertices": [j for _, j, _ in corners],
                    "weights": [str(w) for w in weights],
                },
            }
        swaps = [corners[:k] + [(i, j, lowest)] + corners[k + 1 :] for k in range(3)]
        swaps = [s for s in swaps if _pierced([c for _, _, c in s], d) is not None]
        if not swaps:
            return None
        corners = swaps[0]
    return None


def _pierced(c, d):
    """Convex weights of the point where the line along d pierces triangle c; None if it misses
    or is parallel to the plane.
    """
    w = [dot(d, cross(c[(k + 1) % 3], c[(k + 2) % 3])) for k in range(3)]
    total = sum(w)
    if total == 0 or min(w) < 0 < max(w):
        return None
    return [x / total for x in w]


@cache
def _triples(n):
    return np.array(list(combinations(range(n), 3)))


def _portals(query, a, b, plane):
    """Triples of vertex pairs near the plane's supports whose triangle the ray appears to
    pierce, the best conditioned first.
    """
    A, B = a @ query.pose_a.rotation.T, b @ query.pose_b.rotation.T
    n = np.array(plane) / np.linalg.norm(plane)
    key_a, key_b = A @ n, B @ n
    size = np.ptp(key_a) + np.ptp(key_b)
    dp, d = (
        query.pose_b.position - query.pose_a.position,
        query.motion.displacement - query.motion_b.displacement,
    )
    for near, most in (
        (1e-10, 9),
        (1e-10, 32),
        (1e-7, 32),
        (1e-4, 32),
        (1e-2, 32),
        (0.1, 32),
        (0.5, 32),
    ):
        ia = np.flatnonzero(key_a >= key_a.max() - near * size)
        ib = np.flatnonzero(key_b <= key_b.min() + near * size)
        pairs = sorted((key_b[j] - key_a[i], i, j) for i in ia for j in ib)
        if len(pairs) < 3 or (most == 32 and near == 1e-10 and len(pairs) <= 9):
            continue
        pairs = pairs[:most]
        c = np.array([B[j] + dp - A[i] for _, i, j in pairs])
        triples = _triples(len(pairs))
        x, y, z = (c[triples[:, k]] for k in range(3))
        w = np.stack([np.cross(y, z) @ d, np.cross(z, x) @ d, np.cross(x, y) @ d], 1)
        total = np.where(w.sum(1) == 0, np.nan, w.sum(1))
        worth = np.nan_to_num((w / total[:, None]).min(1), nan=-np.inf)
        for best in np.argsort(-worth)[:4]:
            if worth[best] > -1e-6:
                yield [(int(pairs[k][1]), int(pairs[k][2])) for k in triples[best]]
