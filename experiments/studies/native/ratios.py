# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Verified OFG beside what it competes with, block by block, and how its time grows with size."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
import pandas as pd

from .classes import CLASSES, CONTROL, is_library, library, standing
from .measuring import CELL, CONTESTANT
from .summary import RATIO, errors, interval

VERIFIED, MPR = "ofg-verified", "ofg-mpr"
SCREENED = "ofg k=8 screen=True"
CACHE = ", cache"  #: ends the names of those that keep what they proved: coherent cells
SIZES = (80, 20480)  #: faces: the ends of the range over which growth is fitted
SAMPLES = 999  #: of the bootstrap


def ratios(times: pd.DataFrame, answers: pd.DataFrame) -> pd.DataFrame:
    """class, CELL, mode, against, over, RATIO: how many times the time of verified OFG others take.

    against: "engine", the fastest library that answers every case of the cell and none wrongly;
    "spheres", likewise of the engines behind OFG's spheres; "mpr", the portal without opposing
    faces, which has no batch; "screen", OFG as written with its screen. over: which that was.
    Batches are put over single calls, but for the screen's; in coherent cells OFG keeps a cache.
    Block by block: the median, with its 95 % bootstrap interval. No row where nothing stands.
    """
    wrong = errors(answers).set_index([*CELL, *CONTESTANT])[["misses", "false_alarms"]].sum(axis=1)
    right = times.join(wrong.rename("wrong"), on=[*CELL, *CONTESTANT]).fillna({"wrong": 0})
    made = []
    for name in CLASSES:
        stands = standing(right, name)
        alike = stands["mode"].replace("batch", "warm")  # asked the same queries
        for (*cell, _), rows in stands.groupby([*CELL, alike], sort=False):
            made += [{"class": name, **dict(zip(CELL, cell)), **row} for row in _of_cell(rows)]
    return pd.DataFrame(made, columns=["class", *CELL, "mode", "against", "over", *RATIO])


def _of_cell(rows: pd.DataFrame) -> Iterator[dict]:
    single = rows[rows["mode"] != "batch"]
    for mode in rows["mode"][rows.engine.isin([VERIFIED, VERIFIED + CACHE])].unique():
        kept = CACHE if mode == "coherent" else ""
        own = rows[(rows.engine == VERIFIED + kept) & (rows["mode"] == mode)].set_index("block").ns
        sure = single[single.wrong == 0]
        rivals = {
            "engine": _fastest(sure, is_library, len(own)),
            "spheres": _fastest(sure, lambda engine: library(engine) == CONTROL, len(own)),
            "mpr": single[(single.engine == MPR + kept) & (mode != "batch")],
            "screen": rows[(rows.engine == SCREENED) & (rows["mode"] == mode)],
        }
        for against, rival in rivals.items():
            if len(rival) and len(own):
                quotients = rival.set_index("block").ns / own
                over = rival.engine.iloc[0]
                yield {"mode": mode, "against": against, "over": over, **interval(quotients)}


def _fastest(rows: pd.DataFrame, takes: Callable[[str], bool], blocks: int) -> pd.DataFrame:
    """The rows of the contestant of least median time that took part in so many blocks."""
    rows = rows[rows.engine.map(takes).astype(bool)]
    each = rows.groupby("engine").ns.agg(["median", "size"])
    each = each[each["size"] == blocks]
    return rows[rows.engine == each["median"].idxmin()] if len(each) else each


def growths(times: pd.DataFrame) -> pd.DataFrame:
    """class, bodies, situation, mode, exponent, low, high: time ~ faces to the exponent.

    Of verified OFG in warm cells of shapes that have both SIZES: the slope of the straight line
    through the logarithms of the medians over blocks, by least squares, with the 95 % percentile
    bootstrap interval of resampled blocks.
    """
    rows = times[(times.engine == VERIFIED) & (times["mode"] == "warm")]
    rows = rows[rows.faces.astype(str).str.isdigit()]
    rows = rows.assign(faces=rows.faces.astype(int))
    rows = rows[rows.faces.between(*SIZES)]
    made = []
    for name, isa in CLASSES.items():
        own = rows[rows.isa == isa]
        for key, part in own.groupby(["bodies", "situation", "mode"], sort=False):
            if set(SIZES) <= set(part.faces):
                made.append((name, *key, *exponent(part)))
    columns = ["class", "bodies", "situation", "mode", "exponent", "low", "high"]
    return pd.DataFrame(made, columns=columns)


def exponent(part: pd.DataFrame) -> tuple[float, float, float]:
    """The exponent and its interval, of faces and ns of blocks (at least two sizes)."""
    rng = np.random.default_rng(0)
    each = {faces: group.ns.to_numpy() for faces, group in part.groupby("faces")}
    x = np.log(list(each))
    x = x - x.mean()
    medians = [[np.median(ns), *_resampled(rng, ns)] for ns in each.values()]
    slopes = x @ np.log(np.maximum(medians, 0.1)) / (x @ x)  # what the floor hides is 0 ns
    return float(slopes[0]), *map(float, np.percentile(slopes[1:], [2.5, 97.5]))


def _resampled(rng: np.random.Generator, ns: np.ndarray) -> np.ndarray:
    return np.median(rng.choice(ns, (SAMPLES, len(ns))), axis=1)
