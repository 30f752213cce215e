# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Topology of closed triangle surfaces: balanced edges, cancelling faces, connected parts."""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from . import exact


def merged(v: np.ndarray, f: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Merge vertices at exactly the same place, in the order of first use; drop those without a
    face.

    Faces that then use a vertex twice are dropped: their edges balance among themselves.
    """
    v = v + 0.0  # so that -0 and 0 are one number
    _, first, same = np.unique(v, axis=0, return_index=True, return_inverse=True)
    return compact(v, first[same.reshape(-1)][f])


def compact(v: np.ndarray, f: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Without faces that use a vertex twice and without unused vertices."""
    f = f[(f[:, 0] != f[:, 1]) & (f[:, 1] != f[:, 2]) & (f[:, 2] != f[:, 0])]
    used, f = np.unique(f, return_inverse=True)
    return v[used], f.reshape(-1, 3)


class Edges:
    """The three edges of each of m faces, one face after another.

    key: (3m,) the undirected edge. way: (3m,) 1 or -1, the direction in which the face traverses
    it. face: (3m,) its face. uses: (3m,) the number of faces that share the edge.
    """

    def __init__(self, f: np.ndarray):
        a, b = f.ravel(), f[:, [1, 2, 0]].ravel()
        pair = np.minimum(a, b).astype(np.int64) * (int(f.max(initial=0)) + 1) + np.maximum(a, b)
        _, self.key, count = np.unique(pair, return_inverse=True, return_counts=True)
        self.way = np.where(a < b, 1, -1)
        self.face = np.repeat(np.arange(len(f)), 3)
        self.uses = count[self.key]

    def unbalanced(self, group: np.ndarray | None = None) -> np.ndarray:
        """(3m,) how much more often an edge is traversed in one direction than in the other: 0
        if it balances. Counted within its group of faces ((m,) numbers) if given.
        """
        key = self.key
        if group is not None:
            key = np.unique(np.stack([group[self.face], key]), axis=1, return_inverse=True)[1]
        key = key.reshape(-1)
        return np.abs(np.bincount(key, self.way, minlength=key.max(initial=0) + 1)).astype(int)[key]


def open_edges(f: np.ndarray) -> np.ndarray:
    """(n, 2) the vertices of the edges that have no opposite partner."""
    ends = np.stack([f.ravel(), f[:, [1, 2, 0]].ravel()], axis=1)
    return ends[Edges(f).unbalanced() > 0]


def groups(of: np.ndarray, by: np.ndarray, n: int) -> np.ndarray:
    """(n,) a number for each of n things: equal for two that share a value of `by`. of: (k,) the
    thing to which each value belongs.
    """
    by = np.unique(by, return_inverse=True)[1].reshape(-1)
    size = n + by.max(initial=-1) + 1
    graph = coo_array((np.ones(len(of), bool), (of, n + by)), shape=(size, size))
    return np.unique(connected_components(graph, directed=False)[1][:n], return_inverse=True)[1]


def patches(f: np.ndarray, edges: Edges | None = None) -> np.ndarray:
    """(m,) a number for each face: equal for faces connected through edges of exactly two faces."""
    e = edges or Edges(f)
    plain = e.uses == 2
    return groups(e.face[plain], e.key[plain], len(f))


def shells(f: np.ndarray) -> np.ndarray:
    """(m,) a number for each face of a closed surface: the smallest closed parts that edges
    distinguish.

    Patches that are closed by themselves are shells, even if they touch others along an edge; open
    patches are connected through the edges that they share.
    """
    e = Edges(f)
    patch = patches(f, e)
    loose = e.unbalanced(patch) > 0
    joined = groups(patch[e.face[loose]], e.key[loose], patch.max(initial=-1) + 1)
    return np.unique(joined[patch], return_inverse=True)[1].reshape(-1)


def uncancelled(f: np.ndarray) -> np.ndarray:
    """The faces without pairs of equal faces of opposite orientation."""
    turn = np.argmin(f, axis=1)
    rolled = f[np.arange(len(f))[:, None], (turn[:, None] + np.arange(3)) % 3]
    way = np.where(rolled[:, 1] < rolled[:, 2], 1, -1)
    key = np.unique(np.sort(f, axis=1), axis=0, return_inverse=True)[1].reshape(-1)
    if key.max(initial=-1) + 1 == len(f):
        return f
    net = np.bincount(key, way).astype(int)
    keep = np.zeros(len(f), bool)
    for i in np.flatnonzero(way * net[key] > 0):  # of several equal faces, the first ones
        keep[i] = net[key[i]] != 0
        net[key[i]] -= way[i] if net[key[i]] else 0
    return f[keep]


def settled(v: np.ndarray, f: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A closed surface without parts that bound nothing: pairs of faces that cancel, flat parts
    that are closed by themselves, and unneeded faces without area. Needed ones come last.

    The winding number is that of the given surface wherever it is defined.
    """
    f = uncancelled(f)
    flat = exact.flat(v, f)
    if flat.any():
        f = np.concatenate([f[~flat], _needed(f[flat])])
    while len(f):
        bounding = ~_closed_and_flat(v, f)
        if bounding.all():
            break
        f = f[bounding]
    return compact(v, f)


def _needed(f: np.ndarray) -> np.ndarray:
    """New faces without area whose edges sum to those of the given ones: each connected chain of
    such edges is collinear and is triangulated from one of its vertices. They add no point.
    """
    e = Edges(f)
    ends = np.stack([f.ravel(), f[:, [1, 2, 0]].ravel()], axis=1)
    out = [np.empty((0, 3), f.dtype)]
    line = groups(e.face, e.key, len(f))
    for number in np.unique(line):
        mine = line[e.face] == number
        low = np.sort(ends[mine], axis=1)
        net: dict[tuple[int, int], int] = {}
        for (a, b), way in zip(low.tolist(), e.way[mine].tolist()):
            net[a, b] = net.get((a, b), 0) + way
        chain = [(a, b) if n > 0 else (b, a) for (a, b), n in net.items() for _ in range(abs(n))]
        if chain:
            out.append(_fans(np.array(sorted(chain), f.dtype)))
    return np.concatenate(out)


def _fans(chain: np.ndarray) -> np.ndarray:
    part = groups(np.repeat(np.arange(len(chain)), 2), chain.ravel(), len(chain))
    rows = []
    for number in np.unique(part):
        mine = chain[part == number]
        apex = mine.min()
        rows += [(apex, a, b) for a, b in mine.tolist() if apex not in (a, b)]
    return np.array(rows, chain.dtype).reshape(-1, 3)


def _closed_and_flat(v: np.ndarray, f: np.ndarray) -> np.ndarray:
    """(m,) bool: faces of parts that are closed by themselves and exactly planar."""
    out = np.zeros(len(f), bool)
    part = shells(f)
    order = np.argsort(part, kind="stable")
    for mine in np.split(order, np.flatnonzero(np.diff(part[order])) + 1):
        out[mine] = _in_one_plane(v, f[mine])
    e = Edges(f)
    if (e.uses > 2).any():  # else the shells are all the closed parts
        plane = coplanar(v, f, e)
        closed = np.ones(plane.max() + 1, bool)
        closed[plane[e.face[e.unbalanced(plane) > 0]]] = False
        out |= closed[plane]
    return out


def _in_one_plane(v: np.ndarray, f: np.ndarray) -> bool:
    broad = np.flatnonzero(~exact.flat(v, f))
    if not len(broad):
        return True
    a, b, c = v[f[broad[0]]][:, None]
    for many in (slice(8), slice(None)):  # most shells are not flat, which a few vertices show
        if exact.sides(a, b, c, v[np.unique(f)][many]).any():
            return False
    return True


def coplanar(v: np.ndarray, f: np.ndarray, e: Edges) -> np.ndarray:
    """(m,) a number for each face: equal for exactly coplanar faces that share edges.

    Faces without area form their own groups.
    """
    broad = ~exact.flat(v, f)
    order = np.argsort(e.key, kind="stable")
    order = order[broad[e.face[order]]]
    joins = []
    for step in range(1, int(e.uses.max(initial=1))):  # each face with those after it at the edge
        i, j = order[:-step], order[step:]
        same = e.key[i] == e.key[j]
        i, j = e.face[i[same]], e.face[j[same]]
        level = np.ones(len(i), bool)
        for corner in range(3):
            a, b, c = (v[f[i, k]] for k in range(3))
            level[level] = exact.sides(a[level], b[level], c[level], v[f[j[level], corner]]) == 0
        joins.append(np.stack([i[level], j[level]]))
    i, j = np.concatenate([np.zeros((2, 0), int), *joins], axis=1)
    return groups(np.concatenate([i, j]), np.tile(np.arange(len(i)), 2), len(f))


def apart(v: np.ndarray, f: np.ndarray) -> list[tuple[np.ndarray, np.ndarray]]:
    """The shells of a surface as (vertices, faces) each, without those that enclose nothing.

    Consecutive faces that close form a separate shell, so bodies that touch along a whole face stay
    apart if the file lists one after the other.
    """
    v, f = merged(v, f)
    out = []
    for run in _runs(f):
        w, g = settled(v, run) if not len(open_edges(run)) else (v, run)
        shell = shells(g) if len(g) else np.empty(0, int)
        out += [compact(w, g[shell == i]) for i in np.unique(shell)]
    return out


def _runs(f: np.ndarray) -> list[np.ndarray]:
    """Cut wherever the faces so far balance; what is left open at the end is the last run."""
    net: dict[int, int] = {}
    e = Edges(f)
    cuts, open_ = [], 0
    for i, (key, way) in enumerate(zip(e.key.reshape(-1).tolist(), e.way.tolist())):
        before = net.get(key, 0)
        net[key] = before + way
        open_ += (net[key] != 0) - (before != 0)
        if i % 3 == 2 and open_ == 0:
            cuts.append(i // 3 + 1)
    return [run for run in np.split(f, cuts) if len(run)]
