"""A rigid body: a convex hull, a closed triangle mesh, or a union of convex pieces."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
import trimesh
from scipy.spatial import ConvexHull, QhullError


class BodyError(ValueError):
    """A mesh that cannot be a body; the message names the body, the fault and the remedy."""


@dataclass(frozen=True, eq=False)
class Body:
    """Make one with Body.convex, Body.mesh, Body.union, Body.from_trimesh or Body.from_file, not directly.

    kind: what the solid is. "convex": the convex hull of `vertices`; "mesh": what the closed surface (vertices, faces)
    encloses; "union": the union of the convex `pieces`.
    vertices: (n, 3) float64, in the body's frame (rotations turn about its origin).
    faces: (m, 3) int32, outward (counter-clockwise from outside). Of a union: those of all its pieces, one after another.
    pieces: the convex bodies of a union; a convex body is its own only piece; a mesh has none (see `decompose`).
    """

    kind: str
    vertices: np.ndarray
    faces: np.ndarray
    pieces: tuple["Body", ...]
    name: str = "body"

    @classmethod
    def convex(cls, vertices, name: str = "body") -> "Body":
        """The convex hull of (n, 3) points. Points inside the hull are dropped. BodyError if flat or not finite."""
        v = _points(vertices, name)
        try:
            hull = ConvexHull(v, qhull_options="QbB Qt Pp")
        except QhullError as error:
            raise BodyError(f"Body '{name}': its {len(v)} vertices have no volume ({_first_line(error)}). A convex body "
                            "needs at least four vertices that are not all in one plane.") from error
        used, faces = np.unique(_wound_alike(hull.simplices, hull.neighbors), return_inverse=True)
        v, faces = v[used], faces.reshape(-1, 3)
        return cls._of("convex", v, faces if _volume(v, faces) > 0 else faces[:, ::-1], (), name)

    @classmethod
    def mesh(cls, vertices, faces, name: str = "body") -> "Body":
        """A closed triangle mesh with outward faces, convex or not. BodyError if open, inside-out or not finite."""
        v, f = _points(vertices, name), _faces(faces, len(vertices), name)
        _require_closed(v, f, name)
        return cls._of("mesh", v, f, (), name)

    @classmethod
    def union(cls, pieces, name: str = "body") -> "Body":
        """The union of convex bodies, which may overlap and share a frame."""
        pieces = tuple(pieces)
        if not pieces or any(p.kind != "convex" for p in pieces):
            raise BodyError(f"Body '{name}': a union needs one convex piece or more; make each with Body.convex.")
        first = np.cumsum([0] + [len(p.vertices) for p in pieces])
        faces = np.concatenate([p.faces + offset for p, offset in zip(pieces, first)])
        return cls._of("union", np.concatenate([p.vertices for p in pieces]), faces, pieces, name)

    @classmethod
    def from_trimesh(cls, mesh: trimesh.Trimesh, name: str | None = None) -> "Body":
        """A convex body if the mesh is convex, else a closed mesh body."""
        name = name or mesh.metadata.get("name") or "trimesh"
        checked = cls.mesh(mesh.vertices, mesh.faces, name)
        return cls.convex(mesh.vertices, name) if mesh.is_convex else checked

    @classmethod
    def from_file(cls, path, name: str | None = None) -> "Body":
        """Any triangle mesh file that trimesh reads (OBJ, STL, PLY, OFF, GLB, ...); vertices at one place are merged."""
        path = Path(path)
        if not path.is_file():
            raise BodyError(f"Mesh file {path} does not exist; give the path of a mesh file that trimesh can read.")
        try:
            mesh = trimesh.load(path, force="mesh", process=True)
            mesh.merge_vertices(merge_tex=True, merge_norm=True)
        except Exception as error:
            raise BodyError(f"Mesh file {path} cannot be read ({_first_line(error)}). Give a triangle mesh in a format "
                            "that trimesh reads: OBJ, STL, PLY, OFF, GLB.") from error
        return cls.from_trimesh(mesh, name or path.stem)

    @classmethod
    def _of(cls, kind, vertices, faces, pieces, name) -> "Body":
        vertices, faces = np.array(vertices, np.float64, order="C"), np.array(faces, np.int32, order="C")
        vertices.setflags(write=False)
        faces.setflags(write=False)
        body = cls(kind, vertices, faces, pieces, name)
        if kind == "convex":
            object.__setattr__(body, "pieces", (body,))
        return body

    @cached_property
    def digest(self) -> str:
        """Content hash (hex): equal for bodies of equal kind, vertices, faces and pieces, whatever their names."""
        h = hashlib.sha256(self.kind.encode())
        for part in self.pieces if self.kind == "union" else (self,):
            h.update(np.int64([len(part.vertices), len(part.faces)]).tobytes())
            h.update(part.vertices.tobytes())
            h.update(part.faces.tobytes())
        return h.hexdigest()[:24]

    @cached_property
    def centre(self) -> np.ndarray:
        """(3,) mean of the vertices; of a union, the mean of its pieces' centres (OFG's object-level centre)."""
        points = [p.centre for p in self.pieces] if self.kind == "union" else self.vertices
        return np.mean(points, axis=0)

    @cached_property
    def radius(self) -> float:
        """Largest distance from the body frame's origin to a vertex."""
        return float(np.linalg.norm(self.vertices, axis=1).max())

    @cached_property
    def size(self) -> float:
        """Diagonal of the bounding box: the length that relative gaps refer to."""
        return float(np.linalg.norm(np.ptp(self.vertices, axis=0)))

    def to_trimesh(self) -> trimesh.Trimesh:
        return trimesh.Trimesh(self.vertices, self.faces, process=False)

    def __repr__(self) -> str:
        pieces = f", {len(self.pieces)} pieces" if self.kind == "union" else ""
        return f"Body('{self.name}', {self.kind}, {len(self.vertices)} vertices, {len(self.faces)} faces{pieces})"


def _points(vertices, name: str) -> np.ndarray:
    v = np.asarray(vertices, np.float64)
    if v.ndim != 2 or v.shape[1] != 3 or len(v) < 4:
        raise BodyError(f"Body '{name}': vertices have shape {v.shape}; give at least four points as an (n, 3) array.")
    bad = np.flatnonzero(~np.isfinite(v).all(axis=1))
    if len(bad):
        raise BodyError(f"Body '{name}': vertex {bad[0]} is {v[bad[0]]}, which is not finite ({len(bad)} such of {len(v)}). "
                        "Remove or repair these vertices before making a body of them.")
    return v


def _faces(faces, n: int, name: str) -> np.ndarray:
    f = np.asarray(faces)
    if f.ndim != 2 or f.shape[1] != 3 or len(f) < 4 or not np.issubdtype(f.dtype, np.integer):
        raise BodyError(f"Body '{name}': faces have shape {f.shape} and type {f.dtype}; give triangles as an (m, 3) array of "
                        "vertex indices.")
    if f.min() < 0 or f.max() >= n:
        raise BodyError(f"Body '{name}': a face names vertex {f.max() if f.max() >= n else f.min()}, but the vertices are 0 to {n - 1}.")
    return f


def _require_closed(v: np.ndarray, f: np.ndarray, name: str) -> None:
    """Every directed edge once and its reverse once; positive volume."""
    edges = np.concatenate([f[:, [0, 1]], f[:, [1, 2]], f[:, [2, 0]]]).astype(np.int64)
    key, reverse = edges[:, 0] * len(v) + edges[:, 1], edges[:, 1] * len(v) + edges[:, 0]
    lonely = int((~np.isin(key, reverse)).sum())
    if lonely:
        raise BodyError(f"Body '{name}': the mesh is open or its faces disagree in orientation; {lonely} of {len(edges)} edges "
                        "have no opposite partner. Close it and orient it outward (trimesh.repair.fill_holes, fix_normals; merge "
                        "doubled vertices first with merge_vertices), or take its hull with Body.convex.")
    if len(np.unique(key)) != len(key):
        raise BodyError(f"Body '{name}': the mesh is not a manifold; an edge belongs to more than two faces. Split it there, "
                        "decompose it into convex pieces (Body.union), or take its hull with Body.convex.")
    volume = _volume(v, f)
    if not volume > 0:
        fault = "inside-out" if volume < 0 else "without volume"
        raise BodyError(f"Body '{name}': the mesh is {fault} (signed volume {volume:.3g}). Faces must run counter-clockwise "
                        "seen from outside: reverse them with faces[:, ::-1].")


def _volume(v: np.ndarray, f: np.ndarray) -> float:
    a, b, c = (v[f[:, i]] - v.mean(axis=0) for i in range(3))
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6)


def _wound_alike(triangles: np.ndarray, neighbours: np.ndarray) -> np.ndarray:
    """Qhull's triangles, turned over where needed so that neighbours run through their common edge in opposite directions.

    By neighbourhood and not by normals, and without trimesh, which merges vertices closer than 1e-8 whatever the scale:
    bodies of 1e-6, walls of 1e-9 and triangles without area come out whole.
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
