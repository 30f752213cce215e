# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""What a cell gives: a row per contestant and block of its time, and of what it answered."""

from __future__ import annotations

import numpy as np
import pandas as pd

from baselines import native

from .cell import Cell

PROBE = "(noise probe)"  #: the engine of `lane` that does the same arithmetic every time
#: what tells a row of a cell apart from all others
CONTESTANT = ["engine", "isa", "build", "mode"]
CELL = ["bodies", "faces", "question", "situation"]
#: nanoseconds to build all bodies and cases of a cell; how many bodies; their bytes, -1 if unknown
BUILT = ["build_ns", "built", "bytes"]


def measure(cell: Cell, rounds: int, warmup: int, core: int | None) -> tuple:
    """(times, answers, noise) of a cell.

    times: CELL, CONTESTANT, block, ns (per query: median over rounds, less the floor's), BUILT.
    answers: CELL, CONTESTANT, case, hit, time, label. noise: how far
    the 90th percentile of the probe's rounds lies above their median.
    """
    taken = native.run(cell.queries, cell.modes, cell.block, rounds, warmup, core)
    times, answers = _times(taken, cell), _answers(taken, cell)
    for frame in (times, answers):
        for at, name in enumerate(CELL):
            frame.insert(at, name, getattr(cell, name))
    return times, answers, _noise(taken)


def _times(taken: native.Taken, cell: Cell) -> pd.DataFrame:
    rows = taken.times.join(taken.contestants, on="id")
    rows["ns"] = rows.filter(like="round").median(axis=1) / rows.queries
    floor = rows[rows.engine == native.FLOOR].groupby("mode").ns.median()
    rows["ns"] = (rows.ns - rows["mode"].map(floor)).clip(lower=0)
    return rows[_real(rows)][[*CONTESTANT, "block", "ns", *BUILT]].reset_index(drop=True)


def _answers(taken: native.Taken, cell: Cell) -> pd.DataFrame:
    rows = taken.answers.join(taken.contestants, on="id")
    rows = rows[_real(rows)]
    labels, names = np.array(cell.labels), np.array(cell.cases)
    rows = rows.assign(hit=rows.hit.astype(bool), label=labels[rows.case], case=names[rows.case])
    return rows[[*CONTESTANT, "case", "hit", "time", "label"]].reset_index(drop=True)


def _real(rows: pd.DataFrame) -> pd.Series:
    return ~rows.engine.isin([native.FLOOR, PROBE])


def _noise(taken: native.Taken) -> float:
    probes = taken.contestants.index[taken.contestants.engine == PROBE]
    rounds = taken.times[taken.times.id.isin(probes)].filter(like="round").to_numpy()
    return float(np.percentile(rounds, 90) / np.median(rounds) - 1) if rounds.size else np.nan
