"""From rows of blocks and answers to a row per cell, class and contestant."""

from __future__ import annotations

import numpy as np
import pandas as pd
from scipy.stats import bootstrap

from .classes import CLASSES, standing
from .measuring import CELL, CONTESTANT

OURS = "ofg k=8"  #: what ratios are over, call by call, of the same class
#: the columns of a row, beside CELL and CONTESTANT
FIGURES = ("ns", "ratio", "low", "high", "blocks", "misses", "hits", "false_alarms", "clears")


def summary(times: pd.DataFrame, answers: pd.DataFrame) -> pd.DataFrame:
    """class, CELL, CONTESTANT, FIGURES, build_ns.

    ns: per query, median over blocks. ratio: over OURS block by block, median, with its 95 %
    bootstrap interval low to high; NaN where OURS is not asked. The counts are of certified cases.
    """
    parts = []
    for name in CLASSES:
        for cell, rows in standing(times, name).groupby(CELL, sort=False):
            parts += [{"class": name, **dict(zip(CELL, cell)), **row} for row in _rows(rows)]
    return pd.DataFrame(parts).merge(errors(answers), on=[*CELL, *CONTESTANT], how="left")


def _rows(rows: pd.DataFrame) -> list[dict]:
    base = rows[(rows.engine == OURS) & (rows["mode"] != "batch")].set_index("block").ns
    made = []
    for key, own in rows.groupby(CONTESTANT, sort=False):
        found = interval(own.set_index("block").ns / base)
        made.append({**dict(zip(CONTESTANT, key)), "ns": own.ns.median(), **found,
                     "blocks": len(own), "build_ns": own.build_ns.iloc[0]})
    return made


def interval(quotients: pd.Series) -> dict[str, float]:
    """ratio, low, high: the median and its 95 % bootstrap interval (scipy); NaN of nothing."""
    values = quotients.replace([np.inf, -np.inf], np.nan).dropna().to_numpy()
    if not len(values):
        return dict.fromkeys(("ratio", "low", "high"), np.nan)
    middle = float(np.median(values))
    if len(values) < 2 or np.ptp(values) == 0:
        return {"ratio": middle, "low": middle, "high": middle}
    found = bootstrap((values,), np.median, n_resamples=999, method="percentile",
                      rng=np.random.default_rng(0)).confidence_interval
    return {"ratio": middle, "low": float(found.low), "high": float(found.high)}


def errors(answers: pd.DataFrame) -> pd.DataFrame:
    """Per cell and contestant: misses of certified hits, false alarms of certified clears."""
    known = answers[answers.label != "uncertain"]
    hit = known.label == "hit"
    counted = known.assign(hits=hit, clears=~hit, misses=hit & ~known.hit,
                           false_alarms=~hit & known.hit)
    return counted.groupby([*CELL, *CONTESTANT], sort=False)[list(FIGURES[5:])].sum().reset_index()


def quotient(times: pd.DataFrame, cell: dict, own: tuple, rival: tuple) -> dict[str, float]:
    """`interval` of one contestant over another, (engine, isa, mode) each, in one cell."""
    rows = times[(times[list(cell)] == pd.Series(cell)).all(axis=1)].set_index("block")
    sides = [rows[(rows.engine == e) & (rows.isa == i) & (rows["mode"] == m)].ns
             for e, i, m in (own, rival)]
    return interval(sides[0] / sides[1])


def steps(times: pd.DataFrame, isa: str) -> pd.DataFrame:
    """ns of the steps of OFG in an instruction set: differences of runs that stop after a step.

    bodies, faces, situation, k, precision, and a column for each group of steps; medians over
    blocks of one pair.
    """
    rows = times[(times.isa == isa) & (times["mode"] == "warm")]
    pattern = r"ofg k=(?P<k>\d+)(?: to step (?P<last>\d))?(?P<float> precision=float)?"
    found = rows.engine.str.extract(f"^{pattern}$")
    rows = rows.assign(k=found.k, last=found["last"].fillna("8"),
                       precision=found.float.notna().map({True: "float", False: "double"}))
    rows = rows[rows.k.notna()]
    key = ["bodies", "faces", "situation", "k", "precision"]
    to = rows.pivot_table(index=[*key, "block"], columns="last", values="ns", sort=False)
    made = pd.DataFrame({"1 spheres": to["1"], "2-3 select A": to["3"] - to["1"],
                         "4-6 select B": to["6"] - to["3"], "7-8 face pairs": to["8"] - to["6"],
                         "all": to["8"]})
    return made.groupby(level=key, sort=False).median().reset_index()
