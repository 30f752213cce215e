# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""A shard: a finished part of an unfinished run, named by what determines it and by its bytes."""

from __future__ import annotations

import contextlib
import hashlib
import json
from dataclasses import dataclass
from pathlib import Path

import pandas as pd

from experiments.run.progress import say
from ofg import wholefile

FORMAT = 1  # incremented when the columns of a shard or their meaning change
LENGTH = 32  # hexadecimal digits of a key, and of a digest


def key(made_of: dict[str, object]) -> str:
    """The name determined by these facts (anything that JSON supports)."""
    text = json.dumps({"format": FORMAT, **made_of}, sort_keys=True, default=str)
    return hashlib.sha256(text.encode()).hexdigest()[:LENGTH]


@dataclass(frozen=True)
class Shard:
    """folder/KEY.DIGEST.parquet. The name contains the digest, because two files cannot be
    renamed atomically.
    """

    folder: Path
    key: str

    def ready(self) -> bool:
        """Whether it exists and is complete. A broken shard is removed, with a notice."""
        found = False
        for path in self._files():
            if _digest(path) == path.name.split(".")[1]:
                found = True
                continue
            say(f"{path} is damaged (truncated, altered or unreadable); it is made again.")
            path.unlink()
        return found

    def read(self) -> pd.DataFrame:
        """Its rows. FileNotFoundError if it is not `ready`."""
        if not self.ready():
            raise FileNotFoundError(2, "a part of the run is missing or damaged", str(self.folder))
        return pd.read_parquet(self._files()[0])

    def write(self, frame: pd.DataFrame) -> None:
        """Write it. OSError if that fails; no file is left then."""
        self.folder.mkdir(parents=True, exist_ok=True)
        temporary = wholefile.temporary_of(self.folder / self.key)
        try:
            frame.to_parquet(temporary, index=False, compression="zstd")
            digest = _digest(temporary)
            wholefile.place(temporary, self.folder / f"{self.key}.{digest}.parquet")
        finally:
            with contextlib.suppress(OSError):
                temporary.unlink(missing_ok=True)

    def _files(self) -> list[Path]:
        return sorted(self.folder.glob(f"{self.key}.*.parquet"))


def _digest(path: Path) -> str:
    try:
        return hashlib.sha256(path.read_bytes()).hexdigest()[:LENGTH]
    except OSError:
        return ""
