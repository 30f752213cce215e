"""Files that are there whole or not at all, also after a kill or a loss of power."""

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
    """Replace `path` by what fill(temporary) writes: beside it, synced, and then renamed.

    Its permissions are those of any new file (the umask's), so that others may read it where the
    folder lets them. Raises what `fill` raises, and OSError; the temporary file is then gone.
    """
    temporary = temporary_of(path)
    try:
        fill(temporary)
        place(temporary, path)
    finally:
        with contextlib.suppress(OSError):
            temporary.unlink(missing_ok=True)


def temporary_of(path: Path) -> Path:
    """A name beside `path` that `leftovers` knows and nobody else uses."""
    return path.with_name(f".{path.name}.{secrets.token_hex(4)}.unfinished")


def place(temporary: Path, path: Path) -> None:
    """Sync a finished file and give it its name. OSError."""
    _sync(temporary)
    os.replace(temporary, path)
    # a file system that cannot sync a folder has renamed the file all the same
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
