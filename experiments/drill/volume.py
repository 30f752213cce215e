# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""A disk that fills up or turns read-only: a small tmpfs if it may be mounted, else the nearest
substitute, which is reported.
"""

from __future__ import annotations

import contextlib
import subprocess
import tempfile
from collections.abc import Iterator
from functools import cache
from pathlib import Path


@cache
def mountable() -> bool:
    """Whether this process may mount a tmpfs."""
    with tempfile.TemporaryDirectory() as folder:
        if _said("mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", folder):
            return _said("umount", folder)
    return False


@contextlib.contextmanager
def small(folder: Path, size: int) -> Iterator[None]:
    """A tmpfs of `size` bytes at an empty folder. Unmounted at the end of the block, even if
    files on it are open. OSError if refused.
    """
    _do("mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", str(folder))
    try:
        yield
    finally:
        _do("umount", "-l", str(folder))


def resize(folder: Path, size: int) -> None:
    """Resize the tmpfs at `folder` to this many bytes. OSError if refused."""
    _do("mount", "-o", f"remount,size={size}", str(folder))


@contextlib.contextmanager
def read_only(folder: Path) -> Iterator[None]:
    """Make everything below `folder` read-only within the block: by a mount of itself, or by its
    modes if mounting is not permitted.
    """
    if mountable():
        _do("mount", "--bind", str(folder), str(folder))
        try:
            _do("mount", "-o", "remount,ro,bind", str(folder))
            yield
        finally:
            _do("umount", "-l", str(folder))
        return
    places = [folder, *(p for p in folder.rglob("*") if p.is_dir() and not p.is_symlink())]
    modes = [p.stat().st_mode for p in places]
    try:
        for place in places:
            place.chmod(0o555)
        yield
    finally:
        for place, mode in zip(places, modes):
            place.chmod(mode)


def _do(*words: str) -> None:
    if not _said(*words):
        raise OSError(f"'{' '.join(words)}' was refused")


def _said(*words: str) -> bool:
    try:
        return subprocess.run(words, capture_output=True).returncode == 0
    except FileNotFoundError:
        return False
