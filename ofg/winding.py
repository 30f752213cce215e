# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Exact winding numbers of closed surfaces: at points, and on the two sides of a face."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction

import numpy as np

from . import exact, surface

# Directions of rays: small integers to which few edges are parallel.
RAYS = ((3, 5, 7), (-7, 4, 3), (5, -8, 6), (-2, -7, 9), (11, 3, -8), (1, 12, -5), (-9, -4, -13))
#: barycentric weights of points of a face
WEIGHTS = (
    (1, 1, 1),
    (2, 1, 1),
    (1, 3, 2),
    (5, 2, 3),
    (2, 3, 7),
)
Vector = Sequence[Fraction]  #: of three
MOST_CUTS = 4000  #: limit on faces cut by others when a volume is computed


class Unclear(ValueError):
    """The point lies on the surface, or no ray gives a decision."""


def beside(v: np.ndarray, f: np.ndarray, face: int) -> tuple[int, int, bool]:
    """(front, back, first): winding numbers just in front of a face with an area and just behind
    it, at a point inside it; first: whether no earlier face lies there too. Exact.

    Coincident faces of the same orientation count with it; if the face is cut by others, the
    numbers are those at one of its points.
    """
    for weights in WEIGHTS:
        corners = [exact.rational(v[i]) for i in f[face]]
        all_ = sum(weights)
        p = [sum((w * c[i] for w, c in zip(weights, corners)), Fraction()) / all_ for i in range(3)]
        try:
            ahead, on = crossed_ahead(v, f, p, normal_of(corners), [face])
        except Unclear:
            continue
        return ahead, ahead + 1 + sum(way for _, way in on), all(i > face for i, _ in on)
    raise Unclear(f"face {face} has other edges on it at every point tried")


def at(v: np.ndarray, f: np.ndarray, points: np.ndarray) -> np.ndarray:
    """(n,) winding numbers at (n, 3) points; 0 for a point on the surface."""
    out = np.zeros(len(points), int)
    low, high = v.min(axis=0), v.max(axis=0)
    for i in np.flatnonzero(((points > low) & (points < high)).all(axis=1)):
        try:
            ahead, on = crossed_ahead(v, f, exact.rational(points[i]))
        except Unclear:
            continue
        out[i] = 0 if on else ahead
    return out


def crossed_ahead(
    v: np.ndarray,
    f: np.ndarray,
    p: Vector,
    normal: Vector | None = None,
    skip: Iterable[int] = (),
) -> tuple[int, list[tuple[int, int]]]:
    """(crossings, on): signed crossings of a ray from p with all faces but `skip`; the faces
    that contain p, with the orientation of each relative to `normal`. p: three Fractions. The
    ray leaves on the side to which `normal` points. Raises Unclear if p is on an edge, or no ray
    decides.
    """
    near = np.array([float(c) for c in p])
    with np.errstate(all="ignore"):
        w = v[f] - near
        reach = np.abs(w).max(axis=(1, 2))
        error = 4 * exact.UNIT * (np.abs(near).max() + reach)
        bound = 64 * reach * error + 64 * exact.UNIT * reach * reach
        arms = np.stack([exact.cross(w[:, i], w[:, (i + 1) % 3]) for i in range(3)], axis=1)
        height = (w[:, 0] * arms[:, 1]).sum(axis=1)
    rest = np.ones(len(f), bool)
    rest[list(skip)] = False
    for ray in RAYS:
        facing = 1 if normal is None else sum(a * b for a, b in zip(ray, normal))
        if facing == 0:
            continue
        d = np.array(ray, float) * (1 if facing > 0 else -1)
        with np.errstate(all="ignore"):
            side = arms @ d
            slack = (bound * np.abs(d).sum())[:, None]
            up, down = (side > slack).all(axis=1), (side < -slack).all(axis=1)
            missed = (side > slack).any(axis=1) & (side < -slack).any(axis=1)
            told = (up | down) & (np.abs(height) > 4 * reach * bound) & (bound > exact.SURE)
        hits = told & rest & (up == (height > 0))
        total, on = int(up[hits].sum()) - int(down[hits].sum()), []
        try:
            for i in np.flatnonzero(rest & ~told & ~(missed & (bound > exact.SURE))):
                crossed, way = _crossed(v[f[i]], p, d, normal)
                total += crossed
                if way:
                    on.append((int(i), way))
        except _Grazed:
            continue
        return total, on
    raise Unclear("no ray gives a decision")


class _Grazed(Exception):
    """The ray passes through an edge, a vertex or the plane of a face."""


def _crossed(
    corners: np.ndarray, p: Vector, ray: np.ndarray, normal: Vector | None
) -> tuple[int, int]:
    """(crossing, way) of one face, in rationals."""
    w = [[c - q for c, q in zip(exact.rational(x), p)] for x in corners]
    d = exact.rational(ray)
    area = _cross([b - a for a, b in zip(w[0], w[1])], [b - a for a, b in zip(w[0], w[2])])
    if not any(area):
        return 0, 0
    height = _dot(w[0], _cross(w[1], w[2]))
    sides = [_dot(d, _cross(w[i], w[(i + 1) % 3])) for i in range(3)]
    if any(s > 0 for s in sides) and any(s < 0 for s in sides):
        return 0, 0
    if not any(sides) or (any(s == 0 for s in sides) and height != 0):
        raise _Grazed
    if height == 0:
        if any(s == 0 for s in sides):
            raise Unclear("the point is on an edge")
        if normal is not None and any(_cross(area, normal)):
            raise Unclear("the point is on a face that crosses")
        return 0, 1 if normal is None or _dot(area, normal) > 0 else -1
    up = sides[0] > 0
    return ((1 if up else -1) if up == (height > 0) else 0), 0


def normal_of(corners: Sequence[Vector]) -> list[Fraction]:
    """The exact normal of a triangle, of any length. corners: three points of three Fractions."""
    a, b, c = corners
    return _cross([q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)])


def _cross(a: Vector, b: Vector) -> list[Fraction]:
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def _dot(a: Vector, b: Vector) -> Fraction:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def signed_volume(v: np.ndarray, f: np.ndarray) -> float:
    """The signed volume of the faces: each region counts as often as its winding number."""
    size = np.abs(v).max()
    v = (v - v.mean(axis=0)) / size  # avoids underflow on the way
    a, b, c = (v[f[:, i]] for i in range(3))
    return float((a * exact.cross(b, c)).sum() / 6) * float(size) ** 3


def bounding(v: np.ndarray, f: np.ndarray) -> np.ndarray:
    """(m,) of -1, 0, 1: whether the solid (non-zero winding number) is behind each face only
    (1), on both sides or neither (0), or in front only (-1). Of coincident faces the first
    counts for all. For surfaces without self-intersections; faces without area have 0.
    """
    out = np.zeros(len(f), int)
    broad = np.flatnonzero(~exact.flat(v, f))
    patch = surface.patches(f)
    _, first = np.unique(patch[broad], return_index=True)
    for i in broad[first]:
        front, back, alone = beside(v, f, i)
        out[patch == patch[i]] = ((back != 0) - (front != 0)) if alone else 0
    out[exact.flat(v, f)] = 0
    return out
