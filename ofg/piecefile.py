# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Convex pieces cached on disk: verified by a digest when read, readable by all permitted users."""

from __future__ import annotations

import contextlib
import hashlib
import io
import warnings
import zipfile
from pathlib import Path

import numpy as np

from . import wholefile

DAY = 86400.0  #: seconds after which another writer's temporary file is considered abandoned
NOT_KEPT = (
    "Convex pieces cannot be cached in {folder} ({reason}); they are computed again in each "
    "process, which takes longer and changes no answer. Set OFG_CACHE to a writable folder."
)
#: The exceptions that numpy and zipfile raise for a file that is not an archive.
_BROKEN = (
    OSError,
    ValueError,
    KeyError,
    EOFError,
    MemoryError,
    NotImplementedError,
    zipfile.BadZipFile,
)
_kept_here: dict[
    Path, bytes
] = {}  # pieces that could not be written, kept for the rest of this process


def packed(hulls: list[np.ndarray]) -> bytes:
    """A list of (n, 3) float64 arrays as one .npz archive with their digest."""
    vertices = np.concatenate(hulls) if hulls else np.empty((0, 3))
    splits = np.cumsum([len(h) for h in hulls], dtype=np.int64)[:-1]
    stream = io.BytesIO()
    np.savez(stream, vertices=vertices, splits=splits, digest=_digest(vertices, splits))
    return stream.getvalue()


def unpacked(archive: bytes) -> list[np.ndarray] | None:
    """The arrays given to `packed`; None if the archive is truncated, altered or of another
    kind.
    """
    try:
        with np.load(io.BytesIO(archive), allow_pickle=False) as stored:
            vertices, splits, digest = stored["vertices"], stored["splits"], stored["digest"]
    except _BROKEN:
        return None
    if (vertices.dtype, splits.dtype) != (np.float64, np.int64) or vertices.shape[1:] != (3,):
        return None
    if not np.array_equal(digest, _digest(vertices, splits)):
        return None
    return np.split(vertices, splits)


def load(path: Path) -> list[np.ndarray] | None:
    """The pieces cached at `path`; None if there are none, or they are unreadable or altered."""
    try:
        return unpacked(_kept_here[path] if path in _kept_here else path.read_bytes())
    except OSError:
        return None


def store(path: Path, hulls: list[np.ndarray]) -> None:
    """Cache the pieces at `path`. If that fails, keep them for this process only, and warn once."""
    archive = packed(hulls)
    try:
        _write(path, archive)
    except OSError as error:
        _kept_here[path] = archive
        said = NOT_KEPT.format(folder=path.parent, reason=error.strerror or error)
        warnings.warn(said, RuntimeWarning, stacklevel=2)


def fault(folder: Path) -> str | None:
    """Why `folder` cannot hold a cache, in a sentence with the remedy; None if it can."""
    try:
        probe = folder / "probe"
        _write(probe, b"")
        probe.unlink(missing_ok=True)
    except OSError as error:
        return NOT_KEPT.format(folder=folder, reason=error.strerror or error)
    return None


def _write(path: Path, archive: bytes) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    for stale in wholefile.leftovers(path.parent, DAY):
        with contextlib.suppress(OSError):
            stale.unlink()
    wholefile.write(path, lambda temporary: temporary.write_bytes(archive))


def _digest(vertices: np.ndarray, splits: np.ndarray) -> np.ndarray:
    """(32,) uint8: SHA-256 of the shape and the numbers."""
    found = hashlib.sha256(repr((vertices.shape, splits.tolist())).encode())
    found.update(np.ascontiguousarray(vertices).tobytes())
    return np.frombuffer(found.digest(), np.uint8)
