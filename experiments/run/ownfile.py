"""A reader's own files of a run: kept in RUN/own as they were, so that a change is found."""

from __future__ import annotations

import hashlib
from pathlib import Path

from .config import RunConfig

FOLDER = "own"
_KINDS = {"method_files": "method", "scenario_files": "scenario"}


def copies(config: RunConfig) -> dict[str, Path]:
    """Name of the copy in RUN/own -> the file. Numbered, as two files may have one name."""
    return {
        f"{kind}-{i}-{Path(path).name}": Path(path)
        for field, kind in _KINDS.items()
        for i, path in enumerate(getattr(config, field))
    }


def digests(paths: tuple[str, ...]) -> list[str]:
    """SHA-256 of each file, in order. OSError where one cannot be read."""
    return [hashlib.sha256(Path(path).read_bytes()).hexdigest() for path in paths]


def changed(config: RunConfig, folder: Path) -> str | None:
    """What to do about the first file that is not as its copy in `folder`/own; None if all are.

    A run of an earlier version has no copies; what cannot be compared is taken as it is.
    """
    for name, path in copies(config).items():
        copy = folder / FOLDER / name
        if not copy.is_file():
            continue
        what = f"The {name.split('-')[0]} file {path}"
        remedy = (
            f"Put it back as it was (a copy is {copy}), or choose another folder with --out "
            "for a run of the new one."
        )
        if not path.is_file():
            return f"{what} of the run in {folder} does not exist any more. {remedy}"
        if path.read_bytes() != copy.read_bytes():
            return f"{what} has changed since the run in {folder} was begun. {remedy}"
    return None
