"""The run folder: what is in it, written so that a kill at any moment loses at most the part being
made.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

import pandas as pd

from experiments.run import ownfile
from experiments.run.config import RunConfig, parsed
from experiments.run.processes.machine import ERRNOS, MachineError
from experiments.run.progress import say
from ofg import wholefile

from . import given, lock, record
from .inside import inside
from .shard import Shard, key

#: what a run makes before its config.json, or all that is left where that file was lost
_OURS = {lock.NAME, ownfile.FOLDER, "parts", "workers.log", "manifest.json"}


class StoreError(RuntimeError):
    """A run folder that cannot be used; the message says why and what to do."""


class Store:
    """One run = one folder: config.json, manifest.json, cases.parquet, bodies.parquet,
    observations.parquet, timings.parquet, pieces.parquet and pieces-bodies.parquet (where a method
    decomposes meshes), tables/, figures/, own/ (copies of a reader's own files); `parts/` holds
    shards of an unfinished run and is removed at its end.
    """

    def __init__(self, folder):
        self.folder = Path(folder)

    def path(self, *names: str) -> Path:
        """Where to write. Outside where that is not in the folder: see `inside`."""
        path = inside(self.folder, *names)
        with self._machine(path):
            path.parent.mkdir(parents=True, exist_ok=True)
        return path

    @contextlib.contextmanager
    def held(self, config: RunConfig) -> Iterator[None]:
        """The folder is this run's alone: locked, claimed for `config`, and rid of what kills left.

        StoreError where another run or runner is there, or the folder cannot be made or written.
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
        """Claim the folder for this configuration, or go on with the same one. StoreError where
        another run is there.
        """
        self._refuse_foreign()
        known = self._sound("config.json")
        if known:
            if changed := ", ".join(config.differences(self.config)):
                raise StoreError(
                    f"The folder {self.folder} holds a run of another configuration (it differs in:"
                    f" {changed}). Choose another folder with --out, or remove that one."
                )
            if changed := ownfile.changed(config, self.folder):
                raise StoreError(changed)
        if not (known and self._sound("manifest.json")):
            # whose tables these are is not known any more; shards are found by what they are
            self.folder.joinpath("manifest.json").unlink(missing_ok=True)
        # the copies first: where config.json is, they are
        for name, path in ownfile.copies(config).items():
            if not self.has(ownfile.FOLDER, name):
                self.write_file(
                    lambda to, path=path: shutil.copyfile(path, to), ownfile.FOLDER, name
                )
        self.write_text(config.model_dump_json(indent=1) + "\n", "config.json")

    @property
    def config(self) -> RunConfig:
        path = self.folder / "config.json"
        if not path.is_file():
            raise StoreError(
                f"{self.folder} is no run folder: it has no config.json. Make one with: ofg-bench"
                f" run quick --out {self.folder}"
            )
        return parsed(
            _of_now(given.text(self.folder / "config.json", "The file")),
            self.folder / "config.json",
        )

    @property
    def facts(self) -> dict:
        """What manifest.json holds; nothing where there is none. StoreError where it is none."""
        path = self.folder / "manifest.json"
        return record.facts(path) if path.exists() else {}

    def digest(self, *names: str) -> str:
        """SHA-256 of a file of the run."""
        return hashlib.sha256(self.folder.joinpath(*names).read_bytes()).hexdigest()

    def has(self, *names: str) -> bool:
        return self.folder.joinpath(*names).exists()

    def shard(self, kind: str, **made_of) -> Shard:
        """The piece of `kind` (a folder of parts/) that these facts determine."""
        return Shard(inside(self.folder, "parts", kind), key({"kind": kind, **made_of}))

    def write(self, frame: pd.DataFrame, name: str | Shard, *names: str) -> None:
        """A table of the run, or a shard. MachineError where the disk is full or fails."""
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
        """A file that is there whole or not at all. fill(path): writes it."""
        path = self.path(*names)
        with self._machine(path):
            wholefile.write(path, fill)

    def read(self, name: str | Shard, *names: str, checked: bool = True) -> pd.DataFrame:
        """The rows of a file, or of a shard. checked: with columns, types and ranges as
        record.COLUMNS says; RecordError if not.
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
        """StoreError where the folder is a file, or holds what no run makes."""
        if self.folder.exists() and not self.folder.is_dir():
            raise StoreError(f"{self.folder} is a file, not a folder. Choose a folder with --out.")
        if not self.has("config.json") and self.folder.exists():
            left = set(wholefile.leftovers(self.folder))
            if any(p.name not in _OURS for p in set(self.folder.iterdir()) - left):
                raise StoreError(
                    f"The folder {self.folder} is not empty and holds no run. Choose another one"
                    " with --out."
                )

    def _sound(self, name: str) -> bool:
        """Whether the file is there and JSON. One that is not is made again by `begin`, with a
        notice.
        """
        path = self.folder / name
        if not path.exists():
            return False
        try:
            json.loads(path.read_bytes())
            return True
        except (ValueError, RecursionError):
            say(f"{path} is damaged (empty, cut short or altered); it is made again.")
            return False

    @contextlib.contextmanager
    def _machine(self, path: Path) -> Iterator[None]:
        try:
            yield
        except OSError as error:
            raise MachineError(
                f"{path} could not be written: {error.strerror or error}. What was finished before"
                " is kept; free some space or make the folder writable, then say: ofg-bench resume"
                f" {self.folder}"
            ) from error

    def _unusable(self, error: OSError) -> StoreError | MachineError:
        kind, remedy = (
            (MachineError, "Free some space, then say the same command again")
            if error.errno in ERRNOS
            else (StoreError, "Choose a folder that can be written with --out")
        )
        return kind(
            f"The folder {self.folder} cannot be used: {error.strerror or error}. {remedy}."
        )


#: parameters of methods that had another name when a run was recorded, as they stand in its labels
_RENAMED = {" selection=": " nearest=", " selections=": " selection_times="}


def _of_now(text: str) -> str:
    """Labels of methods as they are written now; what is no text stays as it is, for the reader to
    refuse.
    """
    if not isinstance(text, str):
        return text
    for then, now in _RENAMED.items():
        text = text.replace(then, now)
    return text
