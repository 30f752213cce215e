"""A concave mesh as a union of convex pieces, by CoACD, kept on disk by content."""

from __future__ import annotations

import hashlib
import json
import os
import tempfile
import zipfile
from pathlib import Path

import numpy as np
import platformdirs

from .body import Body, BodyError


def decompose(body: Body, *, threshold: float = 0.05, max_pieces: int = -1, seed: int = 0, thin: int = 0) -> Body:
    """A union of convex pieces that approximates a mesh body. A convex body or a union is returned as it is.

    threshold: CoACD's concavity, 0.01 (many pieces) to 1. max_pieces: -1 for no limit. seed: the same seed gives the same pieces.
    thin: if positive, each piece is reduced to the vertices that support it in that many directions (the thinned piece lies inside it).
    The result is kept in the user's cache folder, or in $OFG_CACHE, by the content of the mesh and all parameters.
    Raises BodyError where CoACD finds no pieces with a volume. Source: Wei et al., "Approximate convex decomposition for 3D meshes with
    collision-aware concavity and tree search", SIGGRAPH 2022.
    """
    if body.kind != "mesh":
        return body
    if not 0.01 <= threshold <= 1:
        raise ValueError(f"threshold = {threshold} must lie in [0.01, 1]: CoACD's concavity, small for many pieces.")
    path = kept_at(body, threshold=threshold, max_pieces=max_pieces, seed=seed, thin=thin)
    hulls = _load(path)
    if hulls is None:
        hulls = _coacd(body, threshold, max_pieces, seed)
        if thin:
            hulls = [supports(v, thin) for v in hulls]
        _store(path, hulls)
    pieces = [Body.convex(v, f"{body.name}#{i}") for i, v in enumerate(hulls)]
    return Body.union(pieces, body.name)


def kept_at(body: Body, *, threshold: float = 0.05, max_pieces: int = -1, seed: int = 0, thin: int = 0) -> Path:
    """Where `decompose` with the same arguments keeps its result; the file exists once it was asked for."""
    parameters = {"threshold": threshold, "max_pieces": max_pieces, "seed": seed, "thin": thin, "coacd": _coacd_version()}
    key = hashlib.sha256((body.digest + json.dumps(parameters, sort_keys=True)).encode()).hexdigest()[:24]
    return cache_folder() / f"pieces-{key}.npz"


def cache_folder() -> Path:
    """$OFG_CACHE if set, else the user's cache folder for ofg."""
    return Path(os.environ.get("OFG_CACHE") or platformdirs.user_cache_dir("ofg"))


def supports(vertices: np.ndarray, directions: int) -> np.ndarray:
    """(m, 3): those of (n, 3) points that are farthest in one of about `directions` directions, spread on a Fibonacci sphere."""
    i = np.arange(directions) + 0.5
    z, turn = 1 - 2 * i / directions, np.pi * (1 + 5**0.5) * i
    r = np.sqrt(1 - z * z)
    sphere = np.stack([r * np.cos(turn), r * np.sin(turn), z], axis=1)
    axes = np.concatenate([np.eye(3), -np.eye(3)])
    return vertices[np.unique(np.argmax(vertices @ np.concatenate([axes, sphere]).T, axis=0))]


def _coacd(body: Body, threshold: float, max_pieces: int, seed: int) -> list[np.ndarray]:
    import coacd  # here: it takes a second to import, and most sessions never decompose

    coacd.set_log_level("error")
    parts = coacd.run_coacd(coacd.Mesh(body.vertices, body.faces), threshold=threshold, max_convex_hull=max_pieces, seed=seed)
    hulls = []
    for vertices, _ in parts:
        try:
            hulls.append(Body.convex(vertices).vertices)
        except BodyError:
            continue  # a piece as flat as a sheet has no interior to collide with
    if not hulls:
        raise BodyError(
            f"Body '{body.name}': CoACD found no piece with a volume. Repair the mesh (trimesh.repair), or take its hull with Body.convex."
        )
    return hulls


def _coacd_version() -> str:
    from importlib.metadata import version

    return version("coacd")


def _load(path: Path) -> list[np.ndarray] | None:
    try:
        with np.load(path, allow_pickle=False) as stored:
            return np.split(stored["vertices"], stored["splits"])
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile):  # missing, or a file cut short: made anew
        return None


def _store(path: Path, hulls: list[np.ndarray]) -> None:
    """Written beside and moved into place, so that nobody ever reads half a file."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.NamedTemporaryFile(dir=path.parent, suffix=".npz", delete=False) as file:
        np.savez(file, vertices=np.concatenate(hulls), splits=np.cumsum([len(h) for h in hulls])[:-1])
    os.replace(file.name, path)
