# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Read mesh files as arrays, within a size limit, or report why a file cannot be read."""

from __future__ import annotations

import bz2
import gzip
import io
import json
import os
import re
import zipfile
from pathlib import Path

import numpy as np
import trimesh

from . import checks, plainfile
from .plainfile import Part
from .solid import BodyError

MOST_BYTES = 512 * 2**20  #: maximum size when unpacked: some ten million triangles in a binary STL
READ = ("obj", "stl", "ply", "off", "glb")  #: the formats named in error messages
REMEDY = "Give a triangle mesh as OBJ, STL, PLY, OFF or GLB."

# Unsupported formats, and formats without triangles, by a name that users know.
FOREIGN = {
    "a CAD file of exact surfaces, which contains no triangles": (
        "step stp iges igs brep brp sat sab x_t x_b jt sldprt "
        "sldasm ipt iam catpart catproduct prt 3dm f3d fcstd ifc dwg scad"
    ),
    "a drawing of curves, which contains no triangles": "dxf svg",
    "a point cloud, which has no faces": "xyz pcd las laz e57 pts ptx",
    "a packed file of an unsupported format": "tar tgz 7z rar xz zst",
    "a scene or mesh file of an unsupported format": (
        "fbx blend max usd usda usdc usdz wrl x3d vtk vtp vtu msh 3ds lwo ma mb amf"
    ),
}
# Packages that trimesh needs for formats that it does not read by itself.
NEEDS = {
    "3mf": "networkx lxml",
    "3dxml": "networkx lxml pillow",
    "dae": "pycollada",
    "zae": "pycollada",
}


def read(path: Path, most: int = MOST_BYTES) -> list[Part]:
    """(vertices (n, 3), faces (m, 3)) of each object in a mesh file, in the frame of its scene.

    most: maximum size in bytes when unpacked. Raises BodyError for a file that cannot be read.
    """
    who = f"Mesh file {path}"
    most = checks.whole("most", most, 1, 2**63 - 1)
    if path.is_dir():
        raise BodyError(f"{who} is a folder; give the path of a mesh file. {REMEDY}")
    if not path.is_file():
        raise BodyError(
            f"{who} does not exist; give the path of a mesh file that trimesh can read."
        )
    kind = path.suffix.lower().lstrip(".")
    _require_known(kind, who)
    try:
        _require_size(path.stat().st_size, most, who)
        if kind in ("gz", "bz2"):
            unpacked, kind = (
                (gzip.open if kind == "gz" else bz2.open),
                Path(path.stem).suffix.lower().lstrip("."),
            )
            _require_known(kind, who)
            with unpacked(path, "rb") as stream:
                data = stream.read(most + 1)
            _require_size(len(data), most, who)
        else:
            data = path.read_bytes()
        if data[:4] == b"PK\3\4":
            _require_zip_size(data, most, who)
        if kind == "zip":
            return _unzipped(data, who)
        if kind == "gltf":
            return _loaded(None, kind, who, path, most)
        return _loaded(data, kind, who)
    except (OSError, EOFError, zipfile.BadZipFile) as error:
        raise _unreadable(who, error) from error


def path_of(path: str | os.PathLike[str]) -> Path:
    """Convert to a Path. TypeError for anything that is not a path."""
    if isinstance(path, (str, os.PathLike)):
        return Path(path)
    raise TypeError(f"path = {path!r} must be the path of a mesh file: a string or a Path.")


def name_of(path: Path) -> str:
    """The file's name without its suffixes."""
    return Path(path.stem).stem if path.suffix.lower() in (".gz", ".bz2") else path.stem


def parts_of(mesh: object, who: str) -> list[Part]:
    """(vertices, faces) of a Trimesh, or of each object in a Scene as placed, or BodyError."""
    if isinstance(mesh, trimesh.Trimesh):
        return [(np.array(mesh.vertices), np.array(mesh.faces))]
    if isinstance(mesh, trimesh.PointCloud):
        raise _cloud(len(mesh.vertices), who)
    if not isinstance(mesh, trimesh.Scene):
        raise BodyError(
            f"{who}: {type(mesh).__name__} is not supported; give a trimesh.Trimesh, or arrays to "
            "Body.mesh."
        )
    out, clouds = [], 0
    for node in sorted(mesh.graph.nodes_geometry, key=_natural):
        matrix, name = mesh.graph[node]
        geometry = mesh.geometry[name]
        if isinstance(geometry, trimesh.Trimesh) and len(geometry.faces):
            out.append(_placed(np.array(geometry.vertices), np.array(geometry.faces), matrix))
        else:
            clouds += len(getattr(geometry, "vertices", ()))
    if not out:
        raise _no_faces(clouds, who)
    return out


def _with_faces(parts: list[Part], who: str) -> list[Part]:
    """The parts that have faces; BodyError if none has."""
    out = [(v, f) for v, f in parts if len(f)]
    if not out:
        raise _no_faces(max((len(v) for v, _ in parts), default=0), who)
    return out


def _no_faces(points: int, who: str) -> BodyError:
    return _cloud(points, who) if points else BodyError(f"{who} contains no faces. {REMEDY}")


def _placed(v: np.ndarray, f: np.ndarray, matrix: np.ndarray) -> Part:
    if np.array_equal(matrix, np.eye(4)):
        return v, f
    mirrored = np.linalg.det(matrix[:3, :3]) < 0
    return v @ matrix[:3, :3].T + matrix[:3, 3], f[:, ::-1] if mirrored else f


def _natural(name: object) -> list[tuple[int, str]]:
    """A sort key that puts part10 after part9."""
    return [(int(x), "") if x.isdigit() else (0, x) for x in re.split(r"(\d+)", str(name))]


def _loaded(
    data: bytes | None, kind: str, who: str, path: Path | None = None, most: int = 0
) -> list[Part]:
    """The mesh as in the file: nothing merged, dropped or repaired."""
    if data is not None and data.lstrip()[:12] == b"ISO-10303-21":
        _require_known("step", who)
    try:
        if kind in plainfile.KINDS and data is not None:
            return _with_faces(plainfile.parts(data, kind), who)
        if path is not None:
            _require_buffers(path, most, who)
            scene = trimesh.load_scene(path, process=False)
        else:
            scene = trimesh.load_scene(io.BytesIO(data or b""), file_type=kind, process=False)
    except ImportError as error:
        if kind not in NEEDS:
            raise _unreadable(who, error) from error
        raise BodyError(
            f"{who}: {kind.upper()} files need Python packages that are not installed: pip install"
            f" {NEEDS[kind]}. Or export the mesh in another format. {REMEDY}"
        ) from error
    except BodyError:
        raise
    except Exception as error:
        raise _unreadable(who, error) from error
    return parts_of(scene, who)


def _unzipped(data: bytes, who: str) -> list[Part]:
    out: list[Part] = []
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        for name in sorted(archive.namelist(), key=_natural):
            kind = Path(name).suffix.lower().lstrip(".")
            if kind in READ and not Path(name).name.startswith("."):
                out += _loaded(archive.read(name), kind, f"{who}, {name}")
    if not out:
        raise BodyError(f"{who}: the archive contains no mesh file. {REMEDY}")
    return out


def _require_known(kind: str, who: str) -> None:
    for what, kinds in FOREIGN.items():
        if kind in kinds.split():
            remedy = (
                "Unpack it and give the mesh file in it."
                if "packed" in what
                else f"Export a mesh from it. {REMEDY}"
            )
            if "cloud" in what:
                remedy = (
                    "Take the hull of the points with Body.convex, or reconstruct a surface first."
                )
            raise BodyError(f"{who} is {what}. {remedy}")


def _require_size(size: int, most: int, who: str) -> None:
    if size > most:
        raise BodyError(
            f"{who} contains more than {most / 2**20:.0f} MiB when unpacked, which is the limit. "
            "Simplify the mesh, or give from_file a larger limit: most=BYTES."
        )


def _require_zip_size(data: bytes, most: int, who: str) -> None:
    """Check the size in the archive's directory before anything is unpacked."""
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        _require_size(sum(entry.file_size for entry in archive.infolist()), most, who)


def _require_buffers(path: Path, most: int, who: str) -> None:
    """Check the size of a GLTF file together with the files that it names."""
    named = [
        b.get("uri", "") for b in json.loads(path.read_text(errors="replace")).get("buffers", ())
    ]
    files = [path.parent / uri for uri in named if uri and not uri.startswith("data:")]
    _require_size(
        path.stat().st_size + sum(f.stat().st_size for f in files if f.is_file()), most, who
    )


def _cloud(n: int, who: str) -> BodyError:
    return BodyError(
        f"{who} contains {n} points and no faces: a point cloud, which encloses nothing. Take the "
        "hull of the points with Body.convex, or reconstruct a surface first."
    )


def _unreadable(who: str, error: Exception) -> BodyError:
    first = str(error).strip().split("\n")[0][:150] or type(error).__name__
    return BodyError(f"{who} cannot be read ({first}). {REMEDY}")
