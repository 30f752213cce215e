# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The user's own files of a run: copied unchanged to RUN/own, so that changes are detected."""

from __future__ import annotations

import hashlib
from pathlib import Path

from .config import RunConfig

FOLDER = "own"
_KINDS = {"method_files": "method", "scenario_files": "scenario"}


def copies(config: RunConfig) -> dict[str, Path]:
    """Name of the copy in RUN/own -> the file. Numbered, because two files may have the same
    name.
    """
    return {
        f"{kind}-{i}-{Path(path).name}": Path(path)
        for field, kind in _KINDS.items()
        for i, path in enumerate(getattr(config, field))
    }


def digests(paths: tuple[str, ...]) -> list[str]:
    """SHA-256 of each file, in order. OSError if one cannot be read."""
    return [hashlib.sha256(Path(path).read_bytes()).hexdigest() for path in paths]


def changed(config: RunConfig, folder: Path) -> str | None:
    """The fault and remedy for the first file that differs from its copy in `folder`/own; None if
    there is none.

    A run of an earlier version has no copies; a file that cannot be compared is accepted.
    """
    for name, path in copies(config).items():
        copy = folder / FOLDER / name
        if not copy.is_file():
            continue
        what = f"The {name.split('-')[0]} file {path}"
        remedy = (
            f"Restore it (a copy is {copy}), or choose another folder with --out for a run of the "
            "new one."
        )
        if not path.is_file():
            return f"{what} of the run in {folder} no longer exists. {remedy}"
        if path.read_bytes() != copy.read_bytes():
            return f"{what} has changed since the run in {folder} began. {remedy}"
    return None
