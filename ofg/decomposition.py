# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Convex decomposition of a concave mesh by CoACD, cached on disk by content."""

from __future__ import annotations

import hashlib
import io
import json
import os
import subprocess
import sys
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import platformdirs

from . import checks, exact, piecefile, surface, winding
from .body import Body, BodyError

SECONDS = 300.0  #: time limit of CoACD; most bodies need less than ten
SAMPLES = 400  #: points of the body at which it is compared with the pieces
COVERED = 0.9  #: share of these points that must lie in a piece; half of it for each shell
#: allowed range of the summed volume of the pieces, as a share of the body's volume
FULL = (
    0.85,
    3.0,
)


def decompose(
    body: Body,
    *,
    threshold: float = 0.05,
    max_pieces: int = -1,
    seed: int = 0,
    thin: int = 0,
    seconds: float = SECONDS,
) -> Body:
    """A union of convex pieces that approximates a mesh body; other bodies are returned unchanged.

    threshold: CoACD's concavity, 0.01 (many pieces) to 1. max_pieces: -1 for no limit. seed: the
    same seed gives the same pieces. thin: if positive, each piece is reduced to its support points
    in that many directions (the thinned piece lies inside it). seconds: time limit; CoACD runs in a
    separate process, which is then terminated.
    The result is cached in the user's cache folder, or in $OFG_CACHE, keyed by the content of the
    mesh and all parameters except the time limit. An altered cache file is computed again. If the
    folder is not writable, one RuntimeWarning is issued and the result is kept for this process
    only.
    Raises BodyError if CoACD exceeds the time limit, finds no pieces with a volume, or omits a part
    of the body (the pieces are compared with it by volume, and at points in each shell).
    Source: Wei et al., "Approximate convex decomposition for 3D meshes with collision-aware
    concavity and tree search", SIGGRAPH 2022.
    """
    checks.body(body, "body")
    threshold = checks.number(threshold, "threshold")
    seconds = checks.number(seconds, "seconds")
    max_pieces = checks.whole("max_pieces", max_pieces, -1)
    seed, thin = checks.whole("seed", seed, 0), checks.whole("thin", thin, 0)
    if body.kind != "mesh":
        return body
    if not 0.01 <= threshold <= 1:
        raise ValueError(
            f"threshold = {threshold} must lie in [0.01, 1]: CoACD's concavity, where small "
            "values give many pieces."
        )
    if not seconds > 0:
        raise ValueError(f"seconds = {seconds} must be more than 0: the time limit of CoACD.")
    path = kept_at(body, threshold=threshold, max_pieces=max_pieces, seed=seed, thin=thin)
    hulls = piecefile.load(path)
    if hulls is None:
        hulls = _coacd(body, threshold, max_pieces, seed, seconds)
        _require_alike(body, [Body.convex(v) for v in hulls])
        if thin:
            hulls = [supports(v, thin) for v in hulls]
        piecefile.store(path, hulls)
    pieces = [Body.convex(v, f"{body.name}#{i}") for i, v in enumerate(hulls)]
    return Body.union(pieces, body.name)


def kept_at(
    body: Body, *, threshold: float = 0.05, max_pieces: int = -1, seed: int = 0, thin: int = 0
) -> Path:
    """Path at which `decompose` with the same arguments caches its result."""
    parameters = {
        "threshold": threshold,
        "max_pieces": max_pieces,
        "seed": seed,
        "thin": thin,
        "coacd": _coacd_version(),
        "compared": 1,
    }
    key = hashlib.sha256(
        (body.digest + json.dumps(parameters, sort_keys=True)).encode()
    ).hexdigest()[:24]
    return cache_folder() / f"pieces-{key}.npz"


def cache_folder() -> Path:
    """$OFG_CACHE if set, else the user's cache folder for ofg."""
    return Path(os.environ.get("OFG_CACHE") or platformdirs.user_cache_dir("ofg"))


def supports(vertices: np.ndarray, directions: int) -> np.ndarray:
    """(m, 3): the support points of (n, 3) points in about `directions` directions.

    The directions are spread over a Fibonacci sphere.
    """
    i = np.arange(directions) + 0.5
    z, turn = 1 - 2 * i / directions, np.pi * (1 + 5**0.5) * i
    r = np.sqrt(1 - z * z)
    sphere = np.stack([r * np.cos(turn), r * np.sin(turn), z], axis=1)
    axes = np.concatenate([np.eye(3), -np.eye(3)])
    reached = np.argmax(vertices @ np.concatenate([axes, sphere]).T, axis=0)
    farthest: np.ndarray = vertices[np.unique(reached)]
    return farthest


def _coacd(
    body: Body, threshold: float, max_pieces: int, seed: int, seconds: float
) -> list[np.ndarray]:
    v, f = _outside(body)
    hulls = []
    for part in _run_apart(
        body.name,
        seconds,
        vertices=v,
        faces=f,
        threshold=threshold,
        max_pieces=max_pieces,
        seed=seed,
    ):
        try:
            hulls.append(Body.convex(part).vertices)
        except BodyError:
            continue  # a flat piece has no interior to collide with
    if not hulls:
        raise BodyError(
            f"Body '{body.name}': CoACD found no piece with a volume. Repair the mesh"
            " (trimesh.repair), or take its hull with Body.convex."
        )
    return hulls


def _outside(body: Body) -> tuple[np.ndarray, np.ndarray]:
    """The surface without faces that have the solid on both sides, such as a shell inside another:
    CoACD spends minutes on those. Unchanged if there are none.
    """
    if surface.patches(body.faces).max() == 0:
        return body.vertices, body.faces
    try:
        sides = winding.bounding(body.vertices, body.faces)
    except winding.Unclear:
        return body.vertices, body.faces
    f = body.faces[(sides != 0) | exact.flat(body.vertices, body.faces)]
    if len(f) == len(body.faces) or not len(f) or len(surface.open_edges(f)):
        return body.vertices, body.faces
    return surface.compact(body.vertices, f)


def _run_apart(name: str, seconds: float, **given: Any) -> list[np.ndarray]:
    """CoACD's pieces as arrays of points, computed in a separate process. It communicates through
    pipes, so a full temporary folder does not look like a fault of the body, and killing it leaves
    no files.
    """
    stream = io.BytesIO()
    np.savez(stream, **given)
    script = Path(__file__).with_name("coacd_child.py")
    command = [sys.executable, "-P", str(script), str(seconds)]
    try:
        done = subprocess.run(
            command, input=stream.getvalue(), capture_output=True, timeout=seconds
        )
    except subprocess.TimeoutExpired as error:  # the process has been killed
        raise BodyError(
            f"Body '{name}': CoACD took more than {seconds:g} s and was terminated. Simplify the "
            "mesh, give a larger threshold or more seconds, or use the mesh undivided."
        ) from error
    hulls = _made(done.stdout)
    if hulls is None:
        said = done.stderr.decode(errors="replace").strip().splitlines()
        last = (said or [f"exit code {done.returncode}"])[-1][:150]
        raise BodyError(
            f"Body '{name}': CoACD failed ({last}). Repair the mesh (trimesh.repair), or use it "
            "undivided."
        )
    return hulls


def _made(archive: bytes) -> list[np.ndarray] | None:
    """The pieces written by coacd_child.py; None if it ended before it was done."""
    try:
        with np.load(io.BytesIO(archive), allow_pickle=False) as made:
            return np.split(made["vertices"], made["splits"])
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile):
        return None


def _require_alike(body: Body, pieces: list[Body]) -> None:
    """Raise BodyError if the pieces differ from the body in volume, or omit points of it."""
    remedy = (
        "Give a smaller threshold or another seed, keep intersecting shells apart (split=True of "
        "Body.from_file), or use the mesh undivided."
    )
    share = sum(p.volume for p in pieces) / body.volume
    if not FULL[0] <= share <= FULL[1]:
        raise BodyError(
            f"Body '{body.name}': the volume of CoACD's pieces is {share:.2f} of the body's "
            f"volume, so they are another body. {remedy}"
        )
    points, shell = _inner_points(body)
    held = np.zeros(len(points), bool)
    for p in pieces:
        n, d = _planes(p)
        held |= (points @ n.T <= d + 1e-9 * body.size).all(axis=1)
    of_shell = np.bincount(shell, held) / np.maximum(np.bincount(shell), 1)
    lost = np.flatnonzero((of_shell < COVERED / 2) & (np.bincount(shell) > 0))
    if len(lost) or held.mean() < COVERED:
        what = f"shell {lost[0] + 1}" if len(lost) else f"{1 - held.mean():.0%} of the body"
        raise BodyError(f"Body '{body.name}': CoACD's pieces omit {what}. {remedy}")


def _inner_points(body: Body) -> tuple[np.ndarray, np.ndarray]:
    """((n, 3) points in the body, (n,) the shell near each): below faces spread over it."""
    v, f = body.vertices, body.broad_faces
    shell = surface.shells(body.faces)[: len(f)]
    size = np.array(
        [
            np.linalg.norm(np.ptp(v[f[shell == i]].reshape(-1, 3), axis=0))
            for i in range(shell.max() + 1)
        ]
    )
    per = max(4, SAMPLES // len(size))
    chosen = np.concatenate(
        [
            np.flatnonzero(shell == i)[:: -(-int((shell == i).sum()) // per)]
            for i in range(len(size))
        ]
    )
    corners = v[f[chosen]]
    n = exact.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    below = (
        corners.mean(axis=1)
        - 0.02 * size[shell[chosen], None] * n / np.linalg.norm(n, axis=1)[:, None]
    )
    inside = winding.at(v, f, below) != 0
    return below[inside], shell[chosen][inside]


def _planes(piece: Body) -> tuple[np.ndarray, np.ndarray]:
    a, b, c = (piece.vertices[piece.faces[:, i]] for i in range(3))
    n = exact.cross(b - a, c - a)
    n = n / np.maximum(np.linalg.norm(n, axis=1), 1e-300)[:, None]
    return n, (n * a).sum(axis=1)


def _coacd_version() -> str:
    from importlib.metadata import version

    return version("coacd")
