# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Validation of solids: arrays and closed surfaces are checked, normalised or rejected."""

from __future__ import annotations

import warnings
from collections.abc import Sized

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial import cKDTree

from . import checks, exact, surface, winding

BLOCK = 64  #: neighbouring vertices that are compared with a plane together
ASKED = 64  #: faces of a shell at which winding numbers are evaluated


class BodyError(ValueError):
    """A mesh or file that cannot be a body; the message names it, the fault and the remedy."""


class BodyWarning(UserWarning):
    """A mesh was changed to make it a body: its faces were turned outward."""


def points(vertices: ArrayLike, who: str, least: int = 4) -> np.ndarray:
    """(n, 3) finite doubles, or BodyError."""
    try:
        v = checks.reals(vertices)
    except TypeError as error:
        raise BodyError(
            f"{who}: vertices are not an array of numbers ({error}); give at least four points as "
            "an (n, 3) array."
        ) from error
    if v.ndim != 2 or v.shape[1] != 3 or len(v) < least:
        raise BodyError(
            f"{who}: vertices have shape {v.shape}; give at least four points as an (n, 3) array."
        )
    bad = np.flatnonzero(~np.isfinite(v).all(axis=1))
    if len(bad):
        raise BodyError(
            f"{who}: vertex {bad[0]} is {v[bad[0]]}, which is not finite ({len(bad)} of {len(v)} "
            "are not). Remove or repair these vertices first."
        )
    return v


def triangles(faces: ArrayLike, n: int, who: str) -> np.ndarray:
    """(m, 3) int64 indices below n, or BodyError."""
    try:
        f = np.asarray(faces)
    except ValueError:
        f = np.empty(0, object)
    if f.ndim != 2 or f.shape[1] != 3 or not np.issubdtype(f.dtype, np.integer):
        raise BodyError(
            f"{who}: faces have shape {f.shape} and type {f.dtype}; give triangles as an (m, 3)"
            " array of vertex indices."
        )
    if not len(f):
        raise BodyError(
            f"{who}: there are {n} points and no faces, which enclose nothing. Give the faces, "
            "or take the hull of the points with Body.convex."
        )
    if f.min() < 0 or f.max() >= n:
        raise BodyError(
            f"{who}: a face names vertex {f.max() if f.max() >= n else f.min()}, but the vertices"
            f" are 0 to {n - 1}."
        )
    return f.astype(np.int64)


def closed(v: np.ndarray, f: np.ndarray, who: str) -> tuple[np.ndarray, np.ndarray]:
    """The closed outward surface of the same solid, or BodyError (README.md, "What a body may be").

    v: (n, 3), f: (m, 3), checked. Vertices at exactly the same place are merged and those without a
    face dropped; faces that cancel are dropped; the remaining faces without area come last. If all
    faces are inward, they are reversed, with a BodyWarning. Otherwise the order is kept.
    """
    v, f = surface.merged(v, f)
    require_balance(v, f, who)
    v, f = surface.settled(v, f)
    require_volume(f, who)
    return v, outward(v, f, who)


def require_volume(faces: Sized, who: str) -> None:
    """Raise BodyError if no faces are left."""
    if not len(faces):
        raise BodyError(
            f"{who}: its faces lie in planes and cancel each other, so they enclose nothing. A "
            "body needs a surface that encloses a volume; give a sheet a thickness."
        )


def require_balance(v: np.ndarray, f: np.ndarray, who: str) -> None:
    """Raise BodyError with the remedy unless each directed edge occurs as often as its reverse."""
    e = surface.Edges(f)
    lonely = e.unbalanced() > 0
    if not lonely.any():
        return
    holes = lonely & (e.uses % 2 == 1)
    if holes.any():
        length = closing_weld(v, f)
        remedy = (
            f"It closes if vertices up to {length:.0e} apart are merged: weld={length:.0e} of "
            "Body.from_file."
            if length
            else "Close it (trimesh.repair.fill_holes), or take its hull with Body.convex."
        )
        raise BodyError(
            f"{who}: the mesh is open; {len(np.unique(e.key[holes]))} of {e.key.max() + 1} edges"
            f" have no opposite partner. {remedy}"
        )
    raise BodyError(
        f"{who}: neighbouring faces disagree in orientation; {len(np.unique(e.key[lonely]))} of "
        f"{e.key.max() + 1} edges are traversed twice in one direction. Orient the faces "
        "consistently (trimesh.repair.fix_normals)."
    )


def closing_weld(v: np.ndarray, f: np.ndarray) -> float | None:
    """The least power of ten below 1e-3 of the size that welds a mesh shut; None if none does."""
    size = float(np.linalg.norm(np.ptp(v, axis=0)))
    if not size or len(f) > 300_000:  # the result is only a hint
        return None
    for power in range(int(np.floor(np.log10(size))) - 9, int(np.floor(np.log10(size))) - 3):
        length = 10.0**power
        try:
            w, g = surface.merged(*welded(v, f, length, ""))
        except BodyError:
            return None
        if 2 * len(g) > len(f) and not len(surface.open_edges(g)):
            return length
    return None


def welded(v: np.ndarray, f: np.ndarray, length: float, who: str) -> tuple[np.ndarray, np.ndarray]:
    """Merge vertices closer than `length` at the position of the first. BodyError if chains of
    such vertices would move one by more than twice the length.
    """
    try:
        fine = checks.number(length, "weld") >= 0
    except (TypeError, ValueError):
        fine = False
    if not fine:
        raise BodyError(
            f"{who}: weld = {checks.shown(length)}; give a length of 0 or more in the mesh's own"
            " unit."
        )
    if length == 0:
        return v, f
    size = float(np.linalg.norm(np.ptp(v, axis=0)))
    if length > 0.01 * size:
        raise BodyError(
            f"{who}: weld = {length:g} is more than a hundredth of the mesh's size, {size:.3g}. "
            "Give a length well below the mesh's own edges."
        )
    pairs = cKDTree(v).query_pairs(length, output_type="ndarray")
    place = np.arange(len(pairs))
    part = surface.groups(pairs.T.ravel(), np.tile(place, 2), len(v)).reshape(-1)
    first = np.unique(part, return_index=True)[1][part]
    far = np.linalg.norm(v - v[first], axis=1).max()
    if far > 2 * length:
        raise BodyError(
            f"{who}: weld = {length:g} joins vertices that are {far:.3g} apart through others "
            "between them. Give a length well below the mesh's own edges."
        )
    return v, first[f]


def outward(v: np.ndarray, f: np.ndarray, who: str) -> np.ndarray:
    """The faces oriented so that every winding number is 0 or more, or BodyError.

    A shell with negative volume is a cavity if the solid surrounds it: the winding numbers, which
    are exact, are then not negative. If all are reversed, the faces are turned.
    """
    shell = surface.shells(f)
    sign = np.array([exact.volume_sign(v, f[shell == i]) for i in range(shell.max() + 1)])
    if (sign == 0).any() and len(sign) == 1:
        raise BodyError(
            f"{who}: the mesh has as much volume inside-out as outward, so its signed volume is "
            "0. Orient its parts consistently (trimesh.repair.fix_normals)."
        )
    if (sign > 0).all():
        return f
    wrong = _wrong(v, f, shell, np.flatnonzero(sign <= 0), 1)
    if wrong is None:
        return f
    if (sign < 0).all() or _wrong(v, f, shell, np.flatnonzero(sign >= 0), -1) is None:
        notice_turned(who)
        return f[:, ::-1]
    raise BodyError(
        f"{who}: shell {wrong + 1} of {len(sign)} is inside-out and not a cavity of another; it "
        f"contains the vertex {v[f[shell == wrong][0, 0]]}. Orient the shells outward "
        "(trimesh.repair.fix_normals with multibody=True)."
    )


def notice_turned(who: str) -> None:
    """Issue the BodyWarning that a surface was turned."""
    warnings.warn(
        f"{who}: the mesh is inside-out; its faces were turned outward.", BodyWarning, stacklevel=6
    )


def _wrong(
    v: np.ndarray, f: np.ndarray, shell: np.ndarray, asked: np.ndarray, way: int
) -> int | None:
    """The first of the given shells where the winding number, times `way`, is below 0."""
    broad = ~exact.flat(v, f)
    for i in asked:
        faces = np.flatnonzero((shell == i) & broad)
        for face in faces[:: -(-len(faces) // ASKED)]:
            try:
                front, back, _ = winding.beside(v, f, int(face))
            except winding.Unclear:
                continue
            if min(way * front, way * back) < 0:
                return int(i)
    return None


def is_convex(v: np.ndarray, f: np.ndarray) -> bool:
    """Whether a closed outward surface bounds its own hull; exact, without a tolerance.

    It must be one closed part, with no edge of more than two faces, and every vertex must lie
    exactly on or behind the plane of every face. Such a surface lies on the hull's surface and
    covers it a whole number of times; the caller checks by volume that this number is 1.
    """
    e = surface.Edges(f)
    if (e.uses != 2).any() or surface.patches(f, e).max() > 0:
        return False
    order = np.argsort(e.key, kind="stable").reshape(-1, 2)
    broad = ~exact.flat(v, f)
    one, other = e.face[order].T
    both = broad[one] & broad[other]
    if not _behind(v, f[one[both]], f[other[both]]):  # cheap, and most meshes fail here
        return False
    return _all_behind(v, f, surface.coplanar(v, f, e).reshape(-1), broad)


def _all_behind(v: np.ndarray, f: np.ndarray, plane: np.ndarray, broad: np.ndarray) -> bool:
    """Whether every vertex is on or behind every plane. plane: (m,) a number for the plane of each
    face.

    Vertices are tested in blocks of neighbours: a block whose ball is behind a plane is done.
    """
    _, first = np.unique(plane[broad], return_index=True)
    of = np.flatnonzero(broad)[first]
    own = np.unique(plane[broad].repeat(3) * len(v) + f[broad].ravel())
    order = cKDTree(v, leafsize=BLOCK).indices
    blocks = [order[i : i + BLOCK] for i in range(0, len(v), BLOCK)]
    middle = np.array([v[b].mean(axis=0) for b in blocks])
    radius = np.array([np.linalg.norm(v[b] - c, axis=1).max() for b, c in zip(blocks, middle)])
    a, b, c = (v[f[of, k]] for k in range(3))
    normal = exact.cross(b - a, c - a)
    size = np.abs(v).max()
    long = np.abs(normal).sum(axis=1) + 8 * exact.UNIT * size * (np.abs(b - a) + np.abs(c - a)).sum(
        axis=1
    )
    offset = (a * normal).sum(axis=1)
    blur = 1e-13 * size * long  # far above rounding: vertices within it are tested exactly
    for block, m, r in zip(blocks, middle, radius):
        near = np.flatnonzero(normal @ m - offset + r * long + blur >= 0)
        for some in np.array_split(near, -(-len(near) // 4096)) if len(near) else ():
            height = v[block] @ normal[some].T - offset[some]
            vertex, at = np.nonzero(height >= -4 * blur[some])
            vertex, at = block[vertex], some[at]
            key = plane[of[at]] * len(v) + vertex
            foreign = own[np.searchsorted(own, key) % len(own)] != key
            at, vertex = at[foreign], vertex[foreign]
            if (exact.sides(a[at], b[at], c[at], v[vertex]) > 0).any():
                return False
    return True


def _behind(v: np.ndarray, f: np.ndarray, g: np.ndarray) -> bool:
    a, b, c = (v[f[:, k]] for k in range(3))
    return all((exact.sides(a, b, c, v[g[:, k]]) <= 0).all() for k in range(3))
