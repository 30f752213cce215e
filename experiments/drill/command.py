# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""`ofg-bench run CONFIG --out FOLDER` as a user types it: started, watched, ended."""

from __future__ import annotations

import os
import subprocess
import time
import uuid
from dataclasses import dataclass
from pathlib import Path

import psutil

from . import kin

GRACE = 0.5  # seconds after the runner's end within which its processes must be gone
HANG = 240.0  # seconds beyond twenty times its undisturbed duration, because limits have to expire

OURS = f"{os.getpid()}-"  # prefix of this drill's marks


@dataclass(frozen=True)
class Ending:
    """How a command ended. code: None if it hung and was killed. text: its whole output.
    orphans: the processes that it left.
    """

    code: int | None
    text: str
    orphans: tuple[str, ...] = ()
    seconds: float = 0.0

    @property
    def reason(self) -> str:
        """The last line of its output."""
        lines = [line.strip() for line in self.text.splitlines() if line.strip()]
        return " ".join(lines[-3:])[:300]


class Running:
    """A started command."""

    def __init__(self, words: list[str], place: Path, temporary: Path):
        self.mark, self.begun = f"{OURS}{uuid.uuid4().hex}", time.monotonic()
        self.output = place / f"{self.mark}.log"
        environment = {
            **os.environ,
            kin.MARK: self.mark,
            "TMPDIR": str(temporary),
            "COLUMNS": "200",
        }
        with self.output.open("wb") as stream:
            self.process = subprocess.Popen(
                words,
                stdin=subprocess.DEVNULL,
                stdout=stream,
                stderr=stream,
                cwd=place,
                env=environment,
                start_new_session=True,
            )

    @property
    def age(self) -> float:
        """Seconds since its start."""
        return time.monotonic() - self.begun

    @property
    def over(self) -> bool:
        return self.process.poll() is not None

    def limit(self, *which) -> None:
        """Set a limit of the runner, which all its processes inherit: psutil.RLIMIT_FSIZE,
        bytes.
        """
        kind, size = which
        psutil.Process(self.process.pid).rlimit(kind, (size, size))

    def reach(self, age: float) -> bool:
        """Wait until it is `age` seconds old; False if it ended before."""
        while self.age < age and not self.over:
            time.sleep(0.005)
        return not self.over

    def runner(self) -> list[psutil.Process]:
        """Its first process; [] if it has ended."""
        try:
            return [psutil.Process(self.process.pid)]
        except psutil.NoSuchProcess:  # poll() reaps it between two checks
            return []

    def below(self, role: str) -> list[psutil.Process]:
        return kin.below(self.process.pid, role)

    def everything(self) -> list[psutil.Process]:
        return kin.marked(self.mark)

    def finish(self, seconds: float) -> Ending:
        """Wait for the end, at most `seconds`; then find orphans, and kill them."""
        try:
            code = self.process.wait(seconds)
        except subprocess.TimeoutExpired:
            code = None
        took = self.age
        if code is None:
            kin.end(self.everything())
            self.process.wait()
        time.sleep(GRACE)
        left = self.everything()
        orphans = tuple(map(kin.describe, left))
        kin.end(left)
        return Ending(code, self.output.read_text(errors="replace"), orphans, took)


@dataclass(frozen=True)
class Bench:
    """The subject of the drill. program: the words that start it. seconds: duration of the
    undisturbed run. busy: the interval in which it had workers. sums: digests of the files of
    accuracy of the undisturbed run. size: bytes of its folder.
    """

    program: tuple[str, ...]
    config: Path
    seconds: float = 60.0
    busy: tuple[float, float] = (0.0, 60.0)
    sums: tuple[str, ...] = ()
    size: int = 0

    @property
    def patience(self) -> float:
        return HANG + 20 * self.seconds


class Attempt:
    """One run folder and one TMPDIR below `place`, and the command for them."""

    def __init__(self, bench: Bench, place: Path, workers: int = 2):
        self.bench, self.place, self.workers = bench, place, workers
        self.disk, self.temporary = place / "disk", place / "tmp"
        self.folder = self.disk / "run"
        for folder in (self.disk, self.temporary):
            folder.mkdir(parents=True)

    def start(self) -> Running:
        words = [
            *self.bench.program,
            "run",
            str(self.bench.config),
            "--out",
            str(self.folder),
            "--workers",
            str(self.workers),
        ]
        return Running(words, self.place, self.temporary)

    def say(self) -> Ending:
        """The command, from start to end, undisturbed."""
        return self.start().finish(self.bench.patience)
