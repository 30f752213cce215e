# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The run folder: its content, written so that a kill at any moment loses at most the part in
progress.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import shutil
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

import pandas as pd

from experiments.run import ownfile
from experiments.run.config import RunConfig, parsed
from experiments.run.processes.machine import ERRNOS, MachineError
from experiments.run.progress import say
from ofg import wholefile

from . import given, lock, record
from .inside import inside
from .shard import Shard, key

#: written before the run's config.json, or all that is left if that file was lost
_OURS = {lock.NAME, ownfile.FOLDER, "parts", "workers.log", "manifest.json"}


class StoreError(RuntimeError):
    """A run folder that cannot be used; the message gives the reason and the remedy."""


class Store:
    """One run = one folder: config.json, manifest.json, cases.parquet, bodies.parquet,
    observations.parquet, timings.parquet, pieces.parquet and pieces-bodies.parquet (if a method
    decomposes meshes), tables/, figures/, own/ (copies of the user's own files); `parts/`
    contains shards of an unfinished run and is removed at its end.
    """

    def __init__(self, folder: str | Path):
        self.folder = Path(folder)

    def path(self, *names: str) -> Path:
        """Where to write. Outside if that is not in the folder: see `inside`."""
        path = inside(self.folder, *names)
        with self._machine(path):
            path.parent.mkdir(parents=True, exist_ok=True)
        return path

    @contextlib.contextmanager
    def held(self, config: RunConfig) -> Iterator[None]:
        """Hold the folder for this run alone: locked, claimed for `config`, and cleared of remains
        of killed runs.

        StoreError if it contains another run or is in use, or cannot be made or written.
        """
        holder = lock.Lock(self.folder)
        try:
            self._refuse_foreign()
            self.folder.mkdir(parents=True, exist_ok=True)
            holder.__enter__()
        except lock.Locked as error:
            raise StoreError(str(error)) from error
        except OSError as error:
            raise self._unusable(error) from error
        try:
            for left in wholefile.leftovers(self.folder):
                left.unlink(missing_ok=True)
            self.begin(config)
            yield
        finally:
            with contextlib.suppress(OSError):
                holder.__exit__()

    def begin(self, config: RunConfig) -> None:
        """Claim the folder for this configuration, or continue a run of the same one. StoreError
        if it contains another run.
        """
        self._refuse_foreign()
        known = self._sound("config.json")
        if known:
            if changed := ", ".join(config.differences(self.config)):
                raise StoreError(
                    f"The folder {self.folder} contains a run of another configuration (it "
                    f"differs in: {changed}). Choose another folder with --out, or remove that "
                    "one."
                )
            if fault := ownfile.changed(config, self.folder):
                raise StoreError(fault)
        if not (known and self._sound("manifest.json")):
            # the configuration of these tables is unknown; shards are identified by their content
            self.folder.joinpath("manifest.json").unlink(missing_ok=True)
        # the copies first: if config.json exists, so do they
        for name, path in ownfile.copies(config).items():
            if not self.has(ownfile.FOLDER, name):
                self.write_file(partial(shutil.copyfile, path), ownfile.FOLDER, name)
        self.write_text(config.model_dump_json(indent=1) + "\n", "config.json")

    @property
    def config(self) -> RunConfig:
        path = self.folder / "config.json"
        if not path.is_file():
            raise StoreError(
                f"{self.folder} is not a run folder: it has no config.json. Make one with: "
                f"ofg-bench run quick --out {self.folder}"
            )
        return parsed(
            _of_now(given.text(self.folder / "config.json", "The file")),
            self.folder / "config.json",
        )

    @property
    def facts(self) -> dict[str, Any]:
        """The content of manifest.json; empty if there is none. StoreError if it is invalid."""
        path = self.folder / "manifest.json"
        return record.facts(path) if path.exists() else {}

    def digest(self, *names: str) -> str:
        """SHA-256 of a file of the run."""
        return hashlib.sha256(self.folder.joinpath(*names).read_bytes()).hexdigest()

    def has(self, *names: str) -> bool:
        return self.folder.joinpath(*names).exists()

    def shard(self, kind: str, **made_of: object) -> Shard:
        """The part of `kind` (a folder of parts/) that these facts determine."""
        return Shard(inside(self.folder, "parts", kind), key({"kind": kind, **made_of}))

    def write(self, frame: pd.DataFrame, name: str | Shard, *names: str) -> None:
        """Write a table of the run, or a shard. MachineError if the disk is full or fails."""
        if isinstance(name, Shard):
            with self._machine(name.folder):
                name.write(frame)
            return
        self.write_file(
            lambda to: frame.to_parquet(to, index=False, compression="zstd"), name, *names
        )

    def write_text(self, text: str, *names: str) -> None:
        self.write_file(lambda temporary: temporary.write_text(text), *names)

    def write_bytes(self, content: bytes, *names: str) -> None:
        self.write_file(lambda temporary: temporary.write_bytes(content), *names)

    def write_file(self, fill: Callable[[Path], object], *names: str) -> None:
        """Write a file atomically. fill(path): writes it."""
        path = self.path(*names)
        with self._machine(path):
            wholefile.write(path, fill)

    def read(self, name: str | Shard, *names: str, checked: bool = True) -> pd.DataFrame:
        """The rows of a file, or of a shard. checked: with columns, types and ranges as in
        record.COLUMNS; RecordError if not.
        """
        path = name.folder if isinstance(name, Shard) else self.folder.joinpath(name, *names)
        if not (name.ready() if isinstance(name, Shard) else path.is_file()):
            raise StoreError(
                f"{path} is missing: the run in {self.folder} is not finished. Finish it with:"
                f" ofg-bench resume {self.folder}"
            )
        frame = (
            name.read()
            if isinstance(name, Shard)
            else record.read(path, name if checked and not names else "")
        )
        if "method" in frame:
            frame["method"] = frame["method"].map(_of_now)
        return frame

    def _refuse_foreign(self) -> None:
        """StoreError if the folder is a file, or contains files that no run writes."""
        if self.folder.exists() and not self.folder.is_dir():
            raise StoreError(f"{self.folder} is a file, not a folder. Choose a folder with --out.")
        if not self.has("config.json") and self.folder.exists():
            left = set(wholefile.leftovers(self.folder))
            if any(p.name not in _OURS for p in set(self.folder.iterdir()) - left):
                raise StoreError(
                    f"The folder {self.folder} is not empty and contains no run. Choose another "
                    "one with --out."
                )

    def _sound(self, name: str) -> bool:
        """Whether the file exists and is JSON. An invalid one is made again by `begin`, with a
        notice.
        """
        path = self.folder / name
        if not path.exists():
            return False
        try:
            json.loads(path.read_bytes())
            return True
        except (ValueError, RecursionError):
            say(f"{path} is damaged (empty, truncated or altered); it is made again.")
            return False

    @contextlib.contextmanager
    def _machine(self, path: Path) -> Iterator[None]:
        try:
            yield
        except OSError as error:
            raise MachineError(
                f"{path} could not be written: {error.strerror or error}. What was finished "
                "before is kept; free some space or make the folder writable, then run: "
                f"ofg-bench resume {self.folder}"
            ) from error

    def _unusable(self, error: OSError) -> StoreError | MachineError:
        kind, remedy = (
            (MachineError, "Free some space, then repeat the command")
            if error.errno in ERRNOS
            else (StoreError, "Choose a writable folder with --out")
        )
        return kind(
            f"The folder {self.folder} cannot be used: {error.strerror or error}. {remedy}."
        )


#: former names of method parameters, as in the labels of recorded runs
_RENAMED = {" selection=": " nearest=", " selections=": " selection_times="}


def _of_now(text: str) -> str:
    """Labels of methods in their current form; values that are not text are unchanged and
    refused by the reader.
    """
    if not isinstance(text, str):
        return text
    for then, now in _RENAMED.items():
        text = text.replace(then, now)
    return text
