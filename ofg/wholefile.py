# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Atomic file writes: a file is complete or absent, even after a kill or a loss of power."""

from __future__ import annotations

import contextlib
import os
import re
import secrets
import time
from collections.abc import Callable, Iterator
from pathlib import Path

_TEMPORARY = re.compile(r"\..+\.[0-9a-f]{8}\.unfinished")


def write(path: Path, fill: Callable[[Path], object]) -> None:
    """Replace `path` by the output of fill(temporary): written beside it, synced, then renamed.

    It gets the permissions of any new file (by the umask), so others may read it if the folder
    permits. Raises what `fill` raises, and OSError; the temporary file is then removed.
    """
    temporary = temporary_of(path)
    try:
        fill(temporary)
        place(temporary, path)
    finally:
        with contextlib.suppress(OSError):
            temporary.unlink(missing_ok=True)


def temporary_of(path: Path) -> Path:
    """A unique name beside `path` that `leftovers` recognises."""
    return path.with_name(f".{path.name}.{secrets.token_hex(4)}.unfinished")


def place(temporary: Path, path: Path) -> None:
    """Sync a finished file and give it its name. Raises OSError."""
    _sync(temporary)
    os.replace(temporary, path)
    # A file system that cannot sync a folder has still renamed the file.
    with contextlib.suppress(OSError):
        _sync(path.parent)


def leftovers(folder: Path, age: float = 0.0) -> Iterator[Path]:
    """Temporary files of killed writers in `folder` and below, not changed for `age` seconds.

    Links to folders are not followed.
    """
    for parent, _, names in os.walk(folder):
        for name in filter(_TEMPORARY.fullmatch, names):
            path = Path(parent, name)
            with contextlib.suppress(OSError):
                if not age or time.time() - path.lstat().st_mtime > age:
                    yield path


def _sync(path: Path) -> None:
    handle = os.open(path, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)
