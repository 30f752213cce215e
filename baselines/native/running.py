# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Running the native lane: what every engine says of some queries, and how long it takes."""

from __future__ import annotations

import os
import tempfile
from dataclasses import dataclass
from pathlib import Path

import pandas as pd

from ofg import Query

from .building import FOLDER, NativeError, command, plugins
from .casefile import write

FLOOR = "(floor)"  #: the engine that does nothing: two looks at the clock and a call
#: how a cell is asked: every pair of bodies once; many poses of one pair call by call; the same in
#: one call; poses along a trajectory, with what the engine remembers
MODES = ("cold", "warm", "batch", "coherent")


@dataclass(frozen=True)
class Taken:
    """What one start of `lane` gave. A contestant is an engine's build in a mode.

    contestants: index id; engine (named as the method of the Python lane that asks the same, where
    there is one), isa, build (who built it), mode, build_ns (of all bodies and cases), built (how
    many bodies), bytes (of all of them with their tables; -1 where unknown).
    answers: id, case (index of the query), hit, time.
    times: id, block (its first case), queries in it, round0, round1, ...: nanoseconds, gross; NaN
    but for three rounds where a contestant takes more than half a second for its turn.
    """

    contestants: pd.DataFrame
    answers: pd.DataFrame
    times: pd.DataFrame


def run(
    queries: list[Query],
    modes: tuple[str, ...] = ("cold",),
    block: int = 1,
    rounds: int = 15,
    warmup: int = 3,
    core: int | None = None,
    folder: Path = FOLDER,
) -> Taken:
    """Ask every engine that is built, each in those of `modes` that it knows.

    block: so many queries, one after the other, are timed together. core: run on this one.
    NativeError where the lane is not built or fails. Unsupported where both bodies turn.
    """
    if not (folder / "lane").is_file():
        raise NativeError("The native lane is not built; build it with: ofg-bench native --build")
    with tempfile.TemporaryDirectory() as scratch:
        cases = Path(scratch, "cases")
        write(cases, queries, block, apart="cold" in modes)
        numbers = [str(warmup), str(rounds), *map(str, plugins(folder))]
        pin = None if core is None else lambda: os.sched_setaffinity(0, {core})
        words = [str(folder / "lane"), str(cases), scratch, ",".join(modes), *numbers]
        command(words, preexec_fn=pin)
        read = [
            pd.read_csv(Path(scratch, f"{name}.csv"), keep_default_na=name != "contestants")
            for name in ("contestants", "answers", "times")
        ]
    return Taken(read[0].set_index("id"), *read[1:])
