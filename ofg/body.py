# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""A rigid body: a convex hull, a closed triangle mesh, or a union of convex pieces."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import trimesh
from numpy.typing import ArrayLike
from scipy.spatial import ConvexHull, QhullError

from . import checks, exact, meshfile, solid, surface, volume, winding
from .frozen import Frozen
from .plainfile import Part
from .solid import BodyError, BodyWarning

__all__ = ["Body", "BodyError", "BodyWarning"]


@dataclass(frozen=True, eq=False)
class Body(Frozen):
    """A rigid body. Create one with Body.convex, mesh, union, from_trimesh or from_file, not
    directly.

    kind: the type of solid. "convex": the convex hull of `vertices`; "mesh": the volume enclosed by
    the closed surface (vertices, faces); "union": the union of the convex `pieces`.
    vertices: (n, 3) float64, in the body's frame (rotations are about its origin).
    faces: (m, 3) int32, outward (counter-clockwise from outside). For a union: the faces of all its
    pieces, one piece after another.
    pieces: the convex bodies of a union; a convex body is its own only piece; a mesh has none (see
    `decompose`).
    """

    kind: str
    vertices: np.ndarray
    faces: np.ndarray
    pieces: tuple[Body, ...]
    name: str = "body"

    @classmethod
    def convex(cls, vertices: ArrayLike, name: str = "body") -> Body:
        """The convex hull of (n, 3) points; interior points are dropped. BodyError if flat."""
        v = solid.points(vertices, f"Body '{name}'")
        try:
            hull = ConvexHull(v, qhull_options="QbB Qt Pp")
        except QhullError as error:
            raise BodyError(
                f"Body '{name}': its {len(v)} vertices have no volume ({_first_line(error)}). A"
                " convex body needs at least four vertices that are not all in one plane."
            ) from error
        used, faces = np.unique(_wound_alike(hull.simplices, hull.neighbors), return_inverse=True)
        v, faces = v[used], faces.reshape(-1, 3)
        return cls.unchecked(
            "convex", v, faces if _volume(v, faces) > 0 else faces[:, ::-1], (), name
        )

    @classmethod
    def mesh(cls, vertices: ArrayLike, faces: ArrayLike, name: str = "body") -> Body:
        """The solid enclosed by a closed triangle mesh: the points with a non-zero winding number.

        vertices: (n, 3) numbers. faces: (m, 3) indices, outward. Vertices at exactly the same place
        are merged and unused vertices dropped; faces that cancel in pairs are dropped; faces
        without area come last. If all faces are inward, they are reversed, with a BodyWarning.
        Raises BodyError if the mesh is open, not finite, flat, or partly inside-out.
        """
        who = f"Body '{name}'"
        v = solid.points(vertices, who)
        return cls.unchecked(
            "mesh", *solid.closed(v, solid.triangles(faces, len(v), who), who), (), name
        )

    @classmethod
    def union(cls, pieces: Iterable[Body], name: str = "body") -> Body:
        """The union of convex bodies, which may overlap and share a frame. BodyError for other
        bodies.
        """
        try:
            pieces = tuple(pieces)
        except TypeError as error:
            raise BodyError(
                f"Body '{name}': a union needs a list of convex bodies, not"
                f" {type(pieces).__name__}; make each with Body.convex."
            ) from error
        wrong = [p for p in pieces if not isinstance(p, Body) or p.kind != "convex"]
        if not pieces or wrong:
            what = f"was given {_what(wrong[0])}" if wrong else "was given none"
            raise BodyError(
                f"Body '{name}': a union needs one convex piece or more, but {what}; make each "
                "with Body.convex."
            )
        first = np.cumsum([0] + [len(p.vertices) for p in pieces])
        faces = np.concatenate([p.faces + offset for p, offset in zip(pieces, first)])
        return cls.unchecked(
            "union", np.concatenate([p.vertices for p in pieces]), faces, pieces, name
        )

    @classmethod
    def from_trimesh(
        cls, mesh: object, name: str | None = None, *, split: bool = False, weld: float = 0.0
    ) -> Body:
        """A convex body if convexity is proved, else a mesh body. mesh: a Trimesh or Scene.

        Convex means that every vertex lies exactly on or behind the plane of every face; a mesh
        that is concave only by a rounding error becomes a mesh body (Body.convex makes its hull).
        split: keep objects and shells apart, as the convex pieces of a union; BodyError if one is
        concave or a cavity. weld: first merge vertices up to this distance apart. Otherwise as
        Body.mesh.
        """
        given = (getattr(mesh, "metadata", None) or {}).get("name")
        if name is None:
            name = given if isinstance(given, str) and given else "trimesh"
        who = f"Body '{name}'"
        return cls._from_parts(meshfile.parts_of(mesh, who), name, who, split, weld)

    @classmethod
    def from_file(
        cls,
        path: str | os.PathLike[str],
        name: str | None = None,
        *,
        split: bool = False,
        weld: float = 0.0,
        most: int = meshfile.MOST_BYTES,
    ) -> Body:
        """The body in a triangle mesh file: OBJ, STL, PLY, OFF, GLB, and others that trimesh reads.

        Kind, split and weld as for from_trimesh. The file may be compressed with gzip or bzip2, or
        be in a ZIP archive. most: maximum size in bytes when unpacked. BodyError names the file,
        the fault and the remedy.
        """
        path = meshfile.path_of(path)
        return cls._from_parts(
            meshfile.read(path, most),
            meshfile.name_of(path) if name is None else name,
            f"Mesh file {path}",
            split,
            weld,
        )

    @classmethod
    def _from_parts(cls, parts: list[Part], name: str, who: str, split: bool, weld: float) -> Body:
        split = checks.truth("split", split)
        parts = [(solid.points(v, who, 1), f) for v, f in parts]
        parts = [solid.welded(v, solid.triangles(f, len(v), who), weld, who) for v, f in parts]
        first = np.cumsum([0] + [len(v) for v, _ in parts])
        v, f = (
            np.concatenate([v for v, _ in parts]),
            np.concatenate([f + n for (_, f), n in zip(parts, first)]),
        )
        if split:
            solid.require_balance(*surface.merged(v, f), who)
            return cls._split(parts, name, who)
        v, f = solid.closed(v, f, who)
        return cls._proved_convex(v, f, name, who) or cls.unchecked("mesh", v, f, (), name)

    @classmethod
    def _proved_convex(cls, v: np.ndarray, f: np.ndarray, name: str, who: str) -> Body | None:
        """The convex body bounded by a closed outward surface; None if convexity is not proved."""
        if not solid.is_convex(v, f):
            return None
        hull = cls.convex(v, name)
        own, its = winding.signed_volume(v, f), winding.signed_volume(hull.vertices, hull.faces)
        if own > 1.5 * its:  # the surface covers its hull twice or more
            return None
        if abs(own - its) > 1e-6 * its + 1e-13 * hull.size**3:
            raise BodyError(
                f"{who}: the mesh is convex with the volume {own:.9g}, but its hull has "
                f"{its:.9g}. Give Body.convex the intended points."
            )
        return hull

    @classmethod
    def _split(cls, parts: list[Part], name: str, who: str) -> Body:
        shells = [shell for part in parts for shell in surface.apart(*part)]
        for i, (v, f) in enumerate(shells):
            solid.require_balance(v, f, f"{who}, part {i + 1} of {len(shells)} by itself")
        solid.require_volume(shells, who)
        signs = [exact.volume_sign(v, f) for v, f in shells]
        if all(sign < 0 for sign in signs):
            solid.notice_turned(who)
            shells, signs = [(v, f[:, ::-1]) for v, f in shells], [1] * len(shells)
        pieces = []
        for i, ((v, f), sign) in enumerate(zip(shells, signs)):
            of = f"{who}, part {i + 1} of {len(shells)}"
            piece = cls._proved_convex(v, f, f"{name}#{i}", of) if sign > 0 else None
            if piece is None:
                raise BodyError(
                    f"{of} is {'concave' if sign > 0 else 'inside-out or a cavity'}, but a union "
                    "consists of convex pieces. Read the file without split, as a mesh, and "
                    "divide that into pieces with ofg.decompose."
                )
            pieces.append(piece)
        return cls.union(pieces, name)

    @classmethod
    def unchecked(
        cls,
        kind: str,
        vertices: np.ndarray,
        faces: np.ndarray,
        pieces: tuple[Body, ...],
        name: str,
    ) -> Body:
        """A body of arrays already checked: a copy with other numbers, or one read back.

        kind: "convex", "union" or "mesh". vertices: (n, 3); faces: (m, 3), outward; pieces: of a
        union, convex. Only the name is checked.
        """
        vertices, faces = (
            np.array(vertices, np.float64, order="C"),
            np.array(faces, np.int32, order="C"),
        )
        vertices.setflags(write=False)
        faces.setflags(write=False)
        body = cls(kind, vertices, faces, pieces, checks.word(name, "name"))
        if kind == "convex":
            object.__setattr__(body, "pieces", (body,))
        return body

    @cached_property
    def digest(self) -> str:
        """Content hash (hex): equal for bodies of equal kind and arrays, regardless of name."""
        h = hashlib.sha256(self.kind.encode())
        for part in self.pieces if self.kind == "union" else (self,):
            h.update(np.array([len(part.vertices), len(part.faces)], np.int64).tobytes())
            h.update(part.vertices.tobytes())
            h.update(part.faces.tobytes())
        return h.hexdigest()[:24]

    @cached_property
    def centre(self) -> np.ndarray:
        """(3,) mean of the vertices; for a union, the mean of its pieces' centres."""
        points = [p.centre for p in self.pieces] if self.kind == "union" else self.vertices
        mean: np.ndarray = np.mean(points, axis=0)
        return mean

    @cached_property
    def radius(self) -> float:
        """Largest distance from the body frame's origin to a vertex."""
        return float(np.linalg.norm(self.vertices, axis=1).max())

    @cached_property
    def volume(self) -> float:
        """Volume of the solid in cubed units: of the points with a non-zero winding number.

        Where shells are nested, overlap or intersect, each point counts once; so do the points of a
        union's pieces. Which side of a face is solid is decided exactly; the sum is in doubles.
        Raises BodyError if more than a few thousand pairs of faces intersect.
        """
        if self.kind == "convex":
            return winding.signed_volume(self.vertices, self.faces)
        try:
            return volume.solid_volume(*surface.settled(*surface.merged(self.vertices, self.faces)))
        except volume.TooManyCuts as error:
            raise BodyError(
                f"Body '{self.name}': its volume cannot be computed, because {error}."
            ) from error

    @cached_property
    def broad_faces(self) -> np.ndarray:
        """(m, 3) faces with an area: everything that can be touched.

        Faces without area, which come last, close a mesh where a vertex lies on an edge; they add
        no point to it.
        """
        broad = (
            ~exact.flat(self.vertices, self.faces)
            if self.kind == "mesh"
            else np.ones(len(self.faces), bool)
        )
        return self.faces[: np.flatnonzero(broad)[-1] + 1] if broad.any() else self.faces

    @cached_property
    def size(self) -> float:
        """Diagonal of the bounding box: the length that relative gaps refer to."""
        return float(np.linalg.norm(np.ptp(self.vertices, axis=0)))

    def to_trimesh(self) -> trimesh.Trimesh:
        """The unchanged vertices and faces as a Trimesh, in the body's frame."""
        return trimesh.Trimesh(self.vertices, self.faces, process=False)

    def __repr__(self) -> str:
        pieces = f", {len(self.pieces)} pieces" if self.kind == "union" else ""
        return (
            f"Body('{self.name}', {self.kind}, {len(self.vertices)} vertices, {len(self.faces)}"
            f" faces{pieces})"
        )


def _what(thing: object) -> str:
    return f"{thing!r}" if isinstance(thing, Body) else f"a {type(thing).__name__}"


def _volume(v: np.ndarray, f: np.ndarray) -> float:
    a, b, c = (v[f[:, i]] - v.mean(axis=0) for i in range(3))
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6)


def _wound_alike(triangles: np.ndarray, neighbours: np.ndarray) -> np.ndarray:
    """Qhull's triangles, oriented so that neighbours traverse their common edge in opposite
    directions.

    Uses adjacency rather than normals, and avoids trimesh, which merges vertices closer than 1e-8
    at any scale: bodies of 1e-6, walls of 1e-9 and triangles without area are preserved.
    """
    wound = triangles.tolist()
    seen, front = {0}, [0]
    while front:
        i = front.pop()
        a, b, c = wound[i]
        edges = {(a, b), (b, c), (c, a)}
        for j in neighbours[i].tolist():
            if j not in seen:
                a, b, c = wound[j]
                if edges & {(a, b), (b, c), (c, a)}:
                    wound[j] = [c, b, a]
                seen.add(j)
                front.append(j)
    return np.array(wound)


def _first_line(error: Exception) -> str:
    return str(error).strip().split("\n")[0] or type(error).__name__
