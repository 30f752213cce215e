"""The run folder: what is in it, written so that a kill at any moment loses at most the part being made."""

from __future__ import annotations

import os
from pathlib import Path

import pandas as pd

from . import given, record
from .config import RunConfig, parsed
from .inside import inside


class StoreError(RuntimeError):
    """A run folder that cannot be used; the message says why and what to do."""


class Store:
    """One run = one folder: config.json, manifest.json, cases.parquet, bodies.parquet, observations.parquet, timings.parquet,
    tables/, figures/; `parts/` holds finished pieces of an unfinished run and is removed at its end.
    """

    def __init__(self, folder):
        self.folder = Path(folder)

    def path(self, *names: str) -> Path:
        """Where to write. Outside where that is not in the folder: see `inside`."""
        path = inside(self.folder, *names)
        path.parent.mkdir(parents=True, exist_ok=True)
        return path

    def begin(self, config: RunConfig) -> None:
        """Claim the folder for this configuration, or go on with the same one. StoreError where another run is there."""
        if self.path("config.json").exists():
            if changed := ", ".join(config.differences(self.config)):
                raise StoreError(f"The folder {self.folder} holds a run of another configuration (it differs in: {changed}). "
                                 "Choose another folder with --out, or remove that one.")
        elif self.folder.exists() and any(self.folder.iterdir()):
            raise StoreError(f"The folder {self.folder} is not empty and holds no run. Choose another one with --out.")
        self.write_text(config.model_dump_json(indent=1) + "\n", "config.json")

    @property
    def config(self) -> RunConfig:
        if not (self.folder / "config.json").is_file():
            raise StoreError(f"{self.folder} is no run folder: it has no config.json. Make one with: ofg-bench run quick --out {self.folder}")
        return parsed(_of_now(given.text(self.folder / "config.json", "The file")), self.folder / "config.json")

    @property
    def facts(self) -> dict:
        """What manifest.json holds; nothing where there is none. StoreError where it is none."""
        path = self.folder / "manifest.json"
        return record.facts(path) if path.exists() else {}

    def has(self, *names: str) -> bool:
        return self.folder.joinpath(*names).exists()

    def write(self, frame: pd.DataFrame, *names: str) -> None:
        _replace(self.path(*names), lambda temporary: frame.to_parquet(temporary, index=False, compression="zstd"))

    def write_text(self, text: str, *names: str) -> None:
        _replace(self.path(*names), lambda temporary: temporary.write_text(text))

    def write_bytes(self, content: bytes, *names: str) -> None:
        _replace(self.path(*names), lambda temporary: temporary.write_bytes(content))

    def read(self, *names: str, checked: bool = True) -> pd.DataFrame:
        """The rows of a file. checked: with columns, types and ranges as record.COLUMNS says; RecordError if not."""
        path = self.folder.joinpath(*names)
        if not path.is_file():
            raise StoreError(f"{path} is missing: the run in {self.folder} is not finished. Finish it with: ofg-bench resume {self.folder}")
        frame = record.read(path, names[0] if checked and len(names) == 1 else "")
        if "method" in frame:
            frame["method"] = frame["method"].map(_of_now)
        return frame


#: parameters of methods that had another name when a run was recorded, as they stand in its labels
_RENAMED = {" selection=": " nearest=", " selections=": " selection_times="}


def _of_now(text: str) -> str:
    """Labels of methods as they are written now."""
    for then, now in _RENAMED.items():
        text = text.replace(then, now)
    return text


def _replace(path: Path, write) -> None:
    """Write beside the target and rename, so that a file is there whole or not at all."""
    temporary = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        temporary.unlink(missing_ok=True)  # a link there would be written through
        write(temporary)
        os.replace(temporary, path)
    except OSError as error:
        temporary.unlink(missing_ok=True)
        raise StoreError(f"{path} could not be written: {error.strerror or error}. What was finished before is kept; free some "
                         "space or choose another folder, then say: ofg-bench resume RUN") from error
