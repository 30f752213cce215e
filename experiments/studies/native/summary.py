# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""From rows of blocks and answers to a row per cell, class and contestant."""

from __future__ import annotations

import numpy as np
import pandas as pd
from scipy.stats import bootstrap

from .classes import CLASSES, is_library, library, standing
from .measuring import BUILT, CELL, CONTESTANT

OURS = "ofg k=8"  #: what engines are put over, call by call, in the instruction set of the class
COUNTS = ("misses", "hits", "false_alarms", "clears")
RATIO = ("ratio", "low", "high")


def summary(times: pd.DataFrame, answers: pd.DataFrame) -> pd.DataFrame:
    """class, CELL, CONTESTANT, ns, over, RATIO, blocks, BUILT, COUNTS.

    ns: per query, median over blocks. ratio: an engine's time over that of OURS, and OFG's over
    that of the engine which took least in the cell; block by block, the median and its 95 %
    bootstrap interval, low to high. over: which that was. Who answers in one call is put over
    single calls. The counts are of certified cases. Of the class AVX-512 there is OFG alone.
    """
    parts = []
    for name in CLASSES:
        stands = standing(times, name)
        alike = stands["mode"].replace("batch", "warm")  # asked the same queries
        for (*cell, _), rows in stands.groupby([*CELL, alike], sort=False):
            made = _rows(rows)
            if name == "AVX-512":
                made = [row for row in made if library(row["engine"]) == "OFG"]
            parts += [{"class": name, **dict(zip(CELL, cell)), **row} for row in made]
    return pd.DataFrame(parts).merge(errors(answers), on=[*CELL, *CONTESTANT], how="left")


def _rows(rows: pd.DataFrame) -> list[dict]:
    single = rows[rows["mode"] != "batch"].set_index("block")
    ours, engines = single[single.engine == OURS], single[single.engine.map(is_library)]
    medians = engines.groupby("engine").ns.median()
    quickest = engines[engines.engine == medians.idxmin()] if len(medians) else engines
    made = []
    for key, own in rows.groupby(CONTESTANT, sort=False):
        base = quickest if library(key[0]) == "OFG" else ours
        made.append(
            {
                **dict(zip(CONTESTANT, key)),
                "ns": own.ns.median(),
                "over": base.engine.iloc[0] if len(base) else "",
                **interval(own.set_index("block").ns / base.ns),
                "blocks": len(own),
                **own[BUILT].iloc[0],
            }
        )
    return made


def interval(quotients: pd.Series) -> dict[str, float]:
    """ratio, low, high: the median and its 95 % bootstrap interval (scipy); NaN of nothing."""
    values = quotients.replace([np.inf, -np.inf], np.nan).dropna().to_numpy()
    if not len(values):
        return dict.fromkeys(RATIO, np.nan)
    middle = float(np.median(values))
    if len(values) < 2 or np.ptp(values) == 0:
        return {"ratio": middle, "low": middle, "high": middle}
    found = bootstrap(
        (values,), np.median, n_resamples=999, method="percentile", rng=np.random.default_rng(0)
    ).confidence_interval
    return {"ratio": middle, "low": float(found.low), "high": float(found.high)}


def errors(answers: pd.DataFrame) -> pd.DataFrame:
    """Per cell and contestant: misses of certified hits, false alarms of certified clears."""
    known = answers[answers.label != "uncertain"]
    hit = known.label == "hit"
    counted = known.assign(
        hits=hit, clears=~hit, misses=hit & ~known.hit, false_alarms=~hit & known.hit
    )
    return counted.groupby([*CELL, *CONTESTANT], sort=False)[list(COUNTS)].sum().reset_index()


def steps(rows: pd.DataFrame, name: str) -> pd.DataFrame:
    """ns of the steps of OFG in a class: differences of what stops after a step, one pair's poses.

    rows: as `summary` gives them. bodies, faces, situation, k, precision, a column for each group
    of steps, and all of them.
    """
    rows = rows[(rows["class"] == name) & (rows["mode"] == "warm")]
    pattern = r"ofg k=(?P<k>\d+)(?: to step (?P<last>\d))?(?P<float> precision=float)?"
    found = rows.engine.astype(str).str.extract(f"^{pattern}$")
    rows = rows.assign(
        k=found.k,
        last=found["last"].fillna("8"),
        precision=found.float.notna().map({True: "float", False: "double"}),
    )
    key = ["bodies", "faces", "situation", "k", "precision"]
    rows = rows[rows.k.notna()].astype(dict.fromkeys(key, str))
    to = rows.pivot_table(index=key, columns="last", values="ns", sort=False)
    return pd.DataFrame(
        {
            "1 spheres": to["1"],
            "2-3 select A": to["3"] - to["1"],
            "4-6 select B": to["6"] - to["3"],
            "7-8 face pairs": to["8"] - to["6"],
            "all": to["8"],
        }
    ).reset_index()
