# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Read back stored bodies with the same vertices and faces, and check them like new bodies."""

from __future__ import annotations

import warnings

import numpy as np
from numpy.typing import ArrayLike

from . import checks, solid, surface, winding
from .body import Body, BodyError

MOST = 20_000_000  #: vertices, faces or pieces of a body


def body(
    kind: str,
    vertices: ArrayLike,
    faces: ArrayLike,
    piece_vertices: ArrayLike = (),
    piece_faces: ArrayLike = (),
    name: str = "body",
) -> Body:
    """The body with exactly these arrays. BodyError if no constructor would have made it.

    vertices: 3 n numbers or (n, 3). faces: 3 m indices or (m, 3); for a union, the faces of its
    pieces, one piece after another, with indices into all vertices. piece_vertices, piece_faces:
    the numbers of vertices and faces of each piece of a union.
    """
    who = f"Body '{checks.shown(name)[1:-1]}'"
    if kind not in ("convex", "mesh", "union"):
        raise BodyError(
            f"{who}: its kind is {checks.shown(kind)}; it must be convex, mesh or union."
        )
    v = solid.points(_threes(vertices, "vertices", who), who)
    f = solid.triangles(_threes(faces, "faces", who), len(v), who)
    if kind == "mesh":
        _check_mesh(v, f, who)
        return Body.unchecked("mesh", v, f, (), name)
    if kind == "convex":
        _check_convex(v, f, who)
        return Body.unchecked("convex", v, f, (), name)
    v0, f0 = (
        _ends(piece_vertices, len(v), "vertices", who),
        _ends(piece_faces, len(f), "faces", who),
    )
    if len(v0) != len(f0):
        raise BodyError(
            f"{who}: it gives the vertex counts of {len(v0) - 1} pieces but the face counts of "
            f"{len(f0) - 1}."
        )
    pieces = []
    for i in range(len(v0) - 1):
        of, at = f"{who}, piece {i}", v[v0[i] : v0[i + 1]]
        own = f[f0[i] : f0[i + 1]] - v0[i]
        solid.points(at, of)
        _check_convex(at, solid.triangles(own, len(at), of), of)
        pieces.append(Body.unchecked("convex", at, own, (), f"{name}[{i}]"))
    return Body.unchecked("union", v, f, tuple(pieces), name)


def _threes(values: ArrayLike, what: str, who: str) -> np.ndarray:
    """(n, 3): a flat list grouped by three."""
    try:
        array = np.asarray(values)
    except (ValueError, OverflowError) as error:
        raise BodyError(f"{who}: its {what} are not an array of numbers ({error}).") from error
    if array.size % 3 or array.size > 3 * MOST or array.dtype.kind not in "iuf":
        raise BodyError(
            f"{who}: its {what} are {array.size} values of type {array.dtype}; there must be "
            f"three numbers for each, and at most {MOST}."
        )
    return array.reshape(-1, 3)


def _ends(counts: ArrayLike, total: int, what: str, who: str) -> np.ndarray:
    """The start of each piece, then the end."""
    try:
        n = np.asarray(counts)
    except (ValueError, OverflowError):
        n = np.empty(0, object)
    fine = n.ndim == 1 and n.size and n.dtype.kind in "iu" and n.min() > 0 and n.max() <= total
    if not fine or sum(n.tolist()) != total:
        raise BodyError(
            f"{who}: the counts of the {what} of its pieces are {checks.shown(counts)}; they must "
            f"be above 0 and add up to {total}."
        )
    return np.concatenate([[0], np.cumsum(n)])


def _check_mesh(v: np.ndarray, f: np.ndarray, who: str) -> None:
    """Check that a mesh is closed, outward and exactly as Body.mesh would return it."""
    with warnings.catch_warnings():
        warnings.simplefilter("error", solid.BodyWarning)
        try:
            w, g = solid.closed(v, f, who)
        except solid.BodyWarning as turned:
            raise BodyError(f"{who}: its surface is inside-out.") from turned
    if w.shape != v.shape or g.shape != f.shape or not (w == v).all() or not (g == f).all():
        raise BodyError(
            f"{who}: it has vertices or faces that Body.mesh would have dropped, or in another "
            "order."
        )


def _check_convex(v: np.ndarray, f: np.ndarray, who: str) -> None:
    """Check that the faces close, use every vertex, and enclose the volume of the convex hull."""
    if len(np.unique(f)) != len(v):
        raise BodyError(f"{who}: {len(v) - len(np.unique(f))} of its vertices are on no face.")
    e = surface.Edges(f)
    if (e.uses != 2).any() or (e.unbalanced() > 0).any():
        raise BodyError(
            f"{who}: its surface is open, non-manifold or inconsistently oriented, so it is not a "
            "convex body."
        )
    hull = Body.convex(v)
    its = winding.signed_volume(hull.vertices, hull.faces)
    own = winding.signed_volume(v, f)
    if not abs(own - its) <= 1e-6 * its + 1e-13 * hull.size**3:
        raise BodyError(
            f"{who}: its faces enclose {own:.9g} and the hull of its vertices {its:.9g}: it is "
            "not convex."
        )
