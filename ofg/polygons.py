# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Triangulation of polygons, convex or concave, into triangles that lie inside them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from . import exact


def triangulated(v: np.ndarray, polygons: Sequence[Sequence[int]] | np.ndarray) -> np.ndarray:
    """(m, 3) the triangles of polygons, each given by its vertices in order; a convex polygon gives
    a fan.

    The fan of a concave polygon would have triangles outside it, which would add surface. Polygons
    with fewer than three vertices are dropped.
    """
    if isinstance(polygons, np.ndarray) and polygons.shape[1] == 3:
        return polygons.astype(np.int64)
    counts = np.array([len(p) for p in polygons], int)
    if (counts == 3).all() and len(counts):
        return np.array(polygons, np.int64)
    rows: list[Sequence[Sequence[int]] | np.ndarray] = [()] * len(polygons)
    for n in np.unique(counts[counts > 2]):
        at = np.flatnonzero(counts == n)
        p = np.array([polygons[i] for i in at.tolist()])
        fans = np.stack([p[:, [0, k, k + 1]] for k in range(1, n - 1)], axis=1)
        fair = np.ones(len(p), bool) if n == 3 else _convex(v[p])
        for i, polygon, fan, whole in zip(at, p, fans, fair):
            rows[i] = fan if whole else _clipped(v[polygon], polygon)
    some = [np.asarray(row) for row in rows if len(row)]
    return np.concatenate(some) if some else np.empty((0, 3), int)


def _convex(corners: np.ndarray) -> np.ndarray:
    """(k,) bool: whether polygons (k, n, 3) turn the same way at every corner. In doubles."""
    sides = np.roll(corners, -1, axis=1) - corners
    turns = exact.cross(np.roll(sides, 1, axis=1), sides)
    normal = _normal(corners)[:, None]
    convex: np.ndarray = ((turns * normal).sum(axis=2) >= 0).all(axis=1)
    return convex


def _normal(corners: np.ndarray) -> np.ndarray:
    """(k, 3) twice the vector areas of polygons (k, n, 3)."""
    out = corners - corners[:, :1]
    normal: np.ndarray = exact.cross(out, np.roll(out, -1, axis=1)).sum(axis=1)
    return normal


def _clipped(corners: np.ndarray, ids: np.ndarray) -> np.ndarray:
    """Ear clipping in the coordinate plane nearest to the polygon; of equal ears the first is
    cut.
    """
    normal = _normal(corners[None])[0]
    drop = int(np.argmax(np.abs(normal)))
    keep = [(1, 2), (2, 0), (0, 1)][drop]
    flat = corners[:, keep] * ([1, 1] if normal[drop] >= 0 else [-1, 1])
    left, out = np.arange(len(ids)), []
    while len(left) > 3:
        ear = next((k for k in range(len(left)) if _is_ear(flat[left], k)), 0)
        out.append(left[[ear - 1, ear, (ear + 1) % len(left)]])
        left = np.delete(left, ear)
    clipped: np.ndarray = ids[np.array([*out, left])]
    return clipped


def _is_ear(ring: np.ndarray, k: int) -> bool:
    """Whether a corner is convex and its triangle contains no other corner, not even on its
    sides.
    """
    a, b, c = ring[k - 1], ring[k], ring[(k + 1) % len(ring)]
    if _turn(a, b, c) <= 0:
        return False
    inside = (_turn(a, b, ring) >= 0) & (_turn(b, c, ring) >= 0) & (_turn(c, a, ring) >= 0)
    rest = ring[inside]  # the three themselves, and coincident corners
    return all((x == a).all() or (x == b).all() or (x == c).all() for x in rest)


def _turn(p: np.ndarray, q: np.ndarray, r: np.ndarray) -> np.ndarray:
    """Twice the signed area of p, q, r: (2,) each; r may be (n, 2)."""
    turn: np.ndarray = (q[0] - p[0]) * (r[..., 1] - p[1]) - (q[1] - p[1]) * (r[..., 0] - p[0])
    return turn
