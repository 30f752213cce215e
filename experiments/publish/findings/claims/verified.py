# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The claim of the project on verified OFG, which is not in the article."""

from __future__ import annotations

import numpy as np
import pandas as pd

from experiments.publish.findings.runs import FAILS, HOLDS, PART, Missing, Runs, interval, listed
from experiments.studies.native.classes import CLASSES, V3
from experiments.studies.native.measuring import CELL
from experiments.studies.native.ratios import CACHE, VERIFIED

from .claim import claim

#: classes of builds, as the text names them
BUILDS = {"generic": "SSE2", V3: "AVX2", "AVX-512": "AVX-512"}


@claim(
    "Verified OFG never misses and is the fastest method without an error at one pose (a claim of"
    " this project, not of the article)",
    "-",
    "in every cell of the native study (shape, size, situation, mode and class of build) verified"
    " OFG gives no wrong answer, and the interval of the ratio of the fastest engine without a"
    " wrong answer in the cell to it lies above 1 (in part: no wrong answer anywhere, and in more"
    " than half of the cells)",
    "native/native.md",
    "Wrong answers are counted on the certified cases of the study, once for each mode and"
    " instruction set. An engine with a wrong answer"
    " in a cell is left out of that cell, however fast it is, and so are engines behind OFG's"
    " bounding and inscribed spheres, which the text compares apart. Batches of OFG are compared"
    " with single calls, as no engine accepts many poses in one call; in coherent cells OFG keeps"
    " what it proved, and the engines what they keep. OFG with AVX2 and AVX-512 is compared with"
    f" builds for {V3}, where they exist.",
)
def verified_speed(runs: Runs):
    ratios, wrong = runs.file("native/ratios.parquet"), _wrong(runs.file("native/rows.parquet"))
    engine = _against(ratios, "engine")
    if engine.empty:
        raise Missing("run native has no cells of verified OFG")
    wins = int((engine.low > 1).sum())
    failed = int(wrong["wrong"].sum())
    if failed or 2 * wins <= len(engine):
        verdict = FAILS
    else:
        verdict = HOLDS if wins == len(engine) else PART
    spheres = _against(ratios, "spheres")
    number = (
        f"{failed} wrong answers of {int(wrong.known.sum())}; faster in {wins} of {len(engine)}"
        f" cells; ratio of the fastest engine without an error to it, geometric mean"
        f" {_mean(engine)}; engines behind OFG's spheres are faster than it in"
        f" {(spheres.high < 1).sum()} of {len(spheres)} cells"
    )
    ends = [engine.loc[engine.ratio.idxmin()], engine.loc[engine.ratio.idxmax()]]
    text = (
        f"By instruction set: {_by_class(engine)}. By mode and situation: {_by_place(engine)}."
        f" From {_cell(ends[0])} to {_cell(ends[1])}. {_lost(engine)}"
        " Ratio of the fastest engine behind OFG's spheres, of those without an error:"
        f" {_by_class(spheres)}. What opposing faces bring, the ratio of the portal without them:"
        f" {_by_class(_against(ratios, 'mpr'))}."
    )
    return verdict, number, text


def _wrong(rows: pd.DataFrame) -> pd.DataFrame:
    """wrong and known answers of verified OFG, once for each cell, mode and instruction set."""
    own = rows[rows.engine.isin([VERIFIED, VERIFIED + CACHE])]
    own = own.drop_duplicates([*CELL, "engine", "isa", "mode"])
    return pd.DataFrame(
        {"wrong": own.misses + own.false_alarms, "known": own.hits + own.clears}
    ).astype(float)


def _against(ratios: pd.DataFrame, what: str) -> pd.DataFrame:
    return ratios[(ratios.against == what) & ratios.ratio.notna()]


def _mean(rows: pd.DataFrame) -> str:
    """The geometric mean of ratios."""
    return f"{np.exp(np.log(rows.ratio.astype(float)).mean()):.3g}" if len(rows) else "-"


def _by_class(rows: pd.DataFrame) -> str:
    """For each class the geometric mean, and in how many cells the others are slower or faster."""
    parts = {name: rows[rows["class"] == name] for name in CLASSES}
    return listed(
        {
            BUILDS[name]: (
                f"{_mean(part)}, above 1 in {(part.low > 1).sum()} and below 1 in"
                f" {(part.high < 1).sum()} of {len(part)} cells"
            )
            for name, part in parts.items()
            if len(part)
        }
    )


def _by_place(rows: pd.DataFrame) -> str:
    """The geometric mean of each mode and situation."""
    places = rows.groupby([rows["mode"].astype(str), rows.situation.astype(str)], sort=False)
    return listed({f"{mode} {situation}": _mean(part) for (mode, situation), part in places})


def _lost(engine: pd.DataFrame) -> str:
    """The cells in which its lead is not shown."""
    lost = engine[~(engine.low > 1)].sort_values("ratio")
    if lost.empty:
        return "No cell in which this is not shown."
    shown = "; ".join(_cell(row) for _, row in lost.head(12).iterrows())
    more = f"; and {len(lost) - 12} more" if len(lost) > 12 else ""
    return f"Not faster for certain: {shown}{more}."


def _cell(row: pd.Series) -> str:
    place = f"{row.bodies} {row.faces} {row.situation} {row['mode']}, {BUILDS[row['class']]}"
    return f"{interval(row)} ({place}, {row.over})"
