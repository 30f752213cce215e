# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The volume enclosed by a closed surface, even if the surface intersects or overlaps itself."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from . import exact, surface, winding

MOST_CUTS = 5000  #: pairs of intersecting faces; beyond it no volume is computed
THIN = 1e-12  #: cuts shorter than this share of the size are ignored
NEAR = 1e-14  #: of the largest coordinate: distances to a plane below this may be rounding alone
Cutters = dict[int, list[tuple[int, bool]]]  #: (other face, whether in the same plane) of each cut
Reach = tuple[float, float]  #: an interval along a direction


class TooManyCuts(ValueError):
    """The surface intersects itself too often for its volume to be computed."""


def solid_volume(v: np.ndarray, f: np.ndarray) -> float:
    """The volume of the points with a non-zero winding number. Faces: closed, `surface.settled`.

    Which side of a face is solid is decided exactly. The sum, the cuts and the pieces of cut faces
    are in doubles: the error may reach some 1e-12 of size^3 if a surface intersects itself. Raises
    TooManyCuts beyond MOST_CUTS pairs of faces.
    """
    f = f[~exact.flat(v, f)]  # they do not contribute to a volume
    centre, size = (v.min(axis=0) + v.max(axis=0)) / 2, float(np.ptp(v, axis=0).max())
    cutters = _cuts(v, f, size)
    weight, busy = _weights(v, f, cutters)
    total = 0.0
    for corners, w in [(v[f[~busy]], weight[~busy])] + [
        _split(v, f, i, cutters[i], size) for i in sorted(cutters)
    ]:
        a, b, c = ((corners[:, k] - centre) / size for k in range(3))
        total += float(((a * exact.cross(b, c)).sum(axis=1) * w).sum() / 6)
    return total * size**3


def _weights(v: np.ndarray, f: np.ndarray, cutters: Cutters) -> tuple[np.ndarray, np.ndarray]:
    """For each face, whether the solid is behind it (1), in front (-1), or on both sides or none
    (0); and which faces are cut, so that their pieces differ.
    """
    cut = np.zeros(len(f), bool)
    cut[list(cutters)] = True
    busy = cut.copy()
    busy[[i for cuts in cutters.values() for i, _ in cuts]] = True  # their neighbours may differ
    e = surface.Edges(f)
    plain = (e.uses == 2) & ~busy[e.face]
    patch = surface.groups(e.face[plain], e.key[plain], len(f)).reshape(-1)
    weight = np.ones(len(f), int)
    if not cutters and patch.max() == 0:
        return weight, cut
    _, first = np.unique(patch, return_index=True)
    for i in first:
        if not cut[i]:
            front, back, alone = winding.beside(v, f, i)
            weight[patch == patch[i]] = ((back != 0) - (front != 0)) * alone
    return weight, cut


def _cuts(v: np.ndarray, f: np.ndarray, size: float) -> Cutters:
    """For each face cut by others: (other face, whether it lies in the same plane)."""
    found: Cutters = {}
    count, plane = 0, surface.coplanar(v, f, surface.Edges(f)).reshape(-1)
    for i, j in _near(v, f):
        for one, other, level in _cutting(v, f, i, j, plane, THIN * size):
            found.setdefault(one, []).append((other, level))
            count += 1
            if count > 2 * MOST_CUTS:
                raise TooManyCuts(f"more than {MOST_CUTS} pairs of its faces intersect each other")
    return found


def _cutting(
    v: np.ndarray, f: np.ndarray, i: np.ndarray, j: np.ndarray, plane: np.ndarray, least: float
) -> Iterator[tuple[int, int, bool]]:
    """(cut face, other face, coplanar?) of those pairs i, j (n,) that share a segment."""
    level = plane[i] == plane[j]
    of_i, of_j = np.zeros((2, len(i), 3), np.int8)
    of_j[~level] = _signs(v, f, i[~level], j[~level])
    near = ~((of_j > 0).all(1) | (of_j < 0).all(1))
    of_i[near & ~level] = _signs(v, f, j[near & ~level], i[near & ~level])
    near &= ~((of_i > 0).all(1) | (of_i < 0).all(1))
    level |= near & ((of_j == 0).all(1) | (of_i == 0).all(1))
    cut_i, cut_j = (
        _passes(x) & _reaches(y) & near & ~level for x, y in ((of_i, of_j), (of_j, of_i))
    )
    some = np.flatnonzero(cut_i | cut_j)
    long = _common(v[f[i[some]]], v[f[j[some]]], of_i[some], of_j[some]) > least
    cut_i[some] &= long
    cut_j[some] &= long
    flat = np.flatnonzero(level)
    both = flat[_overlap(v[f[i[flat]]], v[f[j[flat]]], least)]
    for k in np.flatnonzero(cut_i):
        yield int(i[k]), int(j[k]), False
    for k in np.flatnonzero(cut_j):
        yield int(j[k]), int(i[k]), False
    for k in both:
        yield int(i[k]), int(j[k]), True
        yield int(j[k]), int(i[k]), True


def _passes(signs: np.ndarray) -> np.ndarray:
    """Whether it lies strictly on both sides of a plane."""
    passes: np.ndarray = (signs.min(axis=1) < 0) & (signs.max(axis=1) > 0)
    return passes


def _reaches(signs: np.ndarray) -> np.ndarray:
    """Whether it has more than one point in a plane."""
    reaches: np.ndarray = _passes(signs) | (np.count_nonzero(signs == 0, axis=1) >= 2)
    return reaches


def _signs(v: np.ndarray, f: np.ndarray, i: np.ndarray, j: np.ndarray) -> np.ndarray:
    """(n, 3): the side of face i on which each corner of face j lies; 0 for a corner in its
    plane, or so near that rotating both may have put it there by rounding.
    """
    a, b, c = (v[f[i, k]] for k in range(3))
    n, out = _normals(v[f[i]]), np.zeros((len(i), 3), np.int8)
    for k in range(3):
        p = v[f[j, k]]
        away = np.abs(((p - a) * n).sum(axis=1)) > NEAR * np.abs(v).max()
        out[away, k] = exact.sides(a[away], b[away], c[away], p[away])
    return out


def _near(v: np.ndarray, f: np.ndarray) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Pairs (i, j) of faces whose boxes intersect, in batches: a sweep along the longest side."""
    low, high = v[f].min(axis=1), v[f].max(axis=1)
    axis = int(np.argmax(np.ptp(v, axis=0)))
    order = np.argsort(low[:, axis], kind="stable")
    end = np.searchsorted(low[order, axis], high[order, axis], side="right")
    first, second, count = [], [], 0
    for place, i in enumerate(order):
        j = order[place + 1 : end[place]]
        j = j[((low[j] <= high[i]) & (high[j] >= low[i])).all(axis=1)]
        first.append(np.full(len(j), i))
        second.append(j)
        count += len(j)
        if count > 100_000:
            yield np.concatenate(first), np.concatenate(second)
            first, second, count = [], [], 0
    if count:
        yield np.concatenate(first), np.concatenate(second)


def _plane(t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    n = np.cross(t[1] - t[0], t[2] - t[0])
    return t[0], n / np.linalg.norm(n)


def _section(points: np.ndarray, at: np.ndarray, n: np.ndarray, along: np.ndarray) -> Reach | None:
    """The interval along a direction of a convex polygon in the plane through `at`, or None."""
    height = (points - at) @ n
    ends = []
    for p, q, hp, hq in zip(points, np.roll(points, -1, axis=0), height, np.roll(height, -1)):
        if hp == 0 or hp * hq < 0:
            ends.append(float((p + (q - p) * (hp / (hp - hq) if hp else 0)) @ along))
    return (min(ends), max(ends)) if ends else None


def _common(s: np.ndarray, t: np.ndarray, of_s: np.ndarray, of_t: np.ndarray) -> np.ndarray:
    """(n,) the length of the segment shared by triangles s, t (n, 3, 3) in different planes, 0
    or less if none; of_s, of_t: (n, 3) the sides of the other's plane on which their corners
    lie.
    """
    n, m = _normals(s), _normals(t)
    along = np.cross(n, m)
    along /= np.linalg.norm(along, axis=1)[:, None]
    low_s, high_s = _reach(s, of_s, t[:, 0], m, along)
    low_t, high_t = _reach(t, of_t, s[:, 0], n, along)
    length: np.ndarray = np.minimum(high_s, high_t) - np.maximum(low_s, low_t)
    return length


def _normals(t: np.ndarray) -> np.ndarray:
    n = exact.cross(t[:, 1] - t[:, 0], t[:, 2] - t[:, 0])
    unit: np.ndarray = n / np.linalg.norm(n, axis=1)[:, None]
    return unit


def _reach(
    t: np.ndarray, of: np.ndarray, at: np.ndarray, n: np.ndarray, along: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """The intervals along directions of triangles in planes; `of`: the sides of their corners."""
    height = ((t - at[:, None]) * n[:, None]).sum(axis=2)
    place = (t * along[:, None]).sum(axis=2)
    low, high = np.full(len(t), np.inf), np.full(len(t), -np.inf)
    for k in range(3):
        q = (k + 1) % 3
        share = height[:, k] / np.where(of[:, k] * of[:, q] < 0, height[:, k] - height[:, q], 1)
        for found, x in (
            (of[:, k] == 0, place[:, k]),
            (of[:, k] * of[:, q] < 0, place[:, k] + share * (place[:, q] - place[:, k])),
        ):
            low, high = (
                np.where(found, np.minimum(low, x), low),
                np.where(found, np.maximum(high, x), high),
            )
    return low, high


def _overlap(s: np.ndarray, t: np.ndarray, least: float) -> np.ndarray:
    """(n,) bool: whether coplanar triangles s, t (n, 3, 3) share more than a line."""
    n, out = _normals(s), np.ones(len(s), bool)
    for one, other in ((s, t), (t, s)):
        for k in range(3):
            axis = exact.cross(one[:, (k + 1) % 3] - one[:, k], n)
            axis = (axis / np.linalg.norm(axis, axis=1)[:, None])[:, None]
            own, its = (
                ((one - one[:, k : k + 1]) * axis).sum(axis=2),
                ((other - one[:, k : k + 1]) * axis).sum(axis=2),
            )
            out &= (its.min(axis=1) < own.max(axis=1) - least) & (
                its.max(axis=1) > own.min(axis=1) + least
            )
    return out


def _split(
    v: np.ndarray, f: np.ndarray, face: int, cutters: list[tuple[int, bool]], size: float
) -> tuple[np.ndarray, np.ndarray]:
    """((n, 3, 3) triangles, (n,) weights) of the pieces into which other faces cut a face."""
    corners = v[f[face]]
    at, n = _plane(corners)
    pieces, level = [corners], [i for i, same in cutters if same]
    for i, same in cutters:
        other = v[f[i]]
        for p, m in _walls(other, n) if same else [_plane(other)]:
            along = np.cross(n, m)
            reach = np.sort(other @ along)[[0, 2]] if same else _section(other, at, n, along)
            if reach is not None:
                pieces = [
                    x for piece in pieces for x in _halves(piece, p, m, along, reach, THIN * size)
                ]
    triangles, weights = [], []
    for piece in pieces:
        weight = _weight(v, f, face, level, piece, n)
        triangles += [(piece[0], b, c) for b, c in zip(piece[1:], piece[2:])]
        weights += [weight] * (len(piece) - 2)
    return np.array(triangles), np.array(weights)


def _walls(t: np.ndarray, n: np.ndarray) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Planes through the edges of a triangle, perpendicular to it."""
    for p, q in zip(t, np.roll(t, -1, axis=0)):
        m = np.cross(q - p, n)
        yield p, m / np.linalg.norm(m)


def _halves(
    piece: np.ndarray,
    p: np.ndarray,
    m: np.ndarray,
    along: np.ndarray,
    reach: Reach | np.ndarray,
    least: float,
) -> list[np.ndarray]:
    """A convex polygon cut by a plane, if the cut is within reach and not thin."""
    height = (piece - p) @ m
    if height.max() <= least or height.min() >= -least:
        return [piece]
    chord = _section(piece, p, m, along)
    if chord is None or chord[1] <= reach[0] or chord[0] >= reach[1]:
        return [piece]
    sides: tuple[list[np.ndarray], list[np.ndarray]] = ([], [])
    for a, b, ha, hb in zip(piece, np.roll(piece, -1, axis=0), height, np.roll(height, -1)):
        for side, sign in zip(sides, (1, -1)):
            if sign * ha >= 0:
                side.append(a)
            if ha * hb < 0:
                side.append(a + (b - a) * (ha / (ha - hb)))
    return [np.array(side) for side in sides if len(side) > 2]


def _weight(
    v: np.ndarray, f: np.ndarray, face: int, level: list[int], piece: np.ndarray, n: np.ndarray
) -> int:
    for shares in (
        np.ones(len(piece)),
        1 + np.arange(len(piece)),
        1 + np.arange(len(piece))[::-1] ** 2,
    ):
        p = (piece * (shares / shares.sum())[:, None]).sum(axis=0)
        on = [(i, 1 if _plane(v[f[i]])[1] @ n > 0 else -1) for i in level if _holds(v[f[i]], p)]
        if any(i < face for i, _ in on):
            return 0  # of coincident faces, the first counts for all
        normal = winding.normal_of([exact.rational(c) for c in v[f[face]]])
        try:
            front, grazed = winding.crossed_ahead(v, f, exact.rational(p), normal, [face, *level])
        except winding.Unclear:
            continue
        back = front + 1 + sum(way for _, way in on)
        return int(back != 0) - int(front != 0)
    return 0  # edges of other faces at every point tried: too thin to decide, and to matter


def _holds(t: np.ndarray, p: np.ndarray) -> bool:
    n = _plane(t)[1]
    return all(np.cross(t[(k + 1) % 3] - t[k], p - t[k]) @ n > 0 for k in range(3))
