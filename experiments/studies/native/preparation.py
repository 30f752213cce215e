# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""What verified OFG works out for each body beforehand, and after how many queries it pays."""

from __future__ import annotations

import numpy as np
import pandas as pd

from .classes import V3
from .measuring import CELL
from .ratios import VERIFIED

PLACE = [*CELL, "mode"]
LEGEND = (
    "Time and memory to prepare a body, tables included: of the builds for each instruction set,"
    " which prepare a body once each, the one of least time. mpr's queries: preparing a pair for"
    f" {VERIFIED} takes as long as so many queries of mpr save with it; mpr's own preparation is"
    " not subtracted. Engine's queries: likewise for the time that it takes longer to prepare a"
    " pair than the fastest engine without an error; 0 where it takes less. -: the interval of the"
    " ratio does not lie above 1, so that it never pays for certain."
)


def table(rows: pd.DataFrame, ratios: pd.DataFrame) -> pd.DataFrame:
    """A row per cold and warm cell of verified OFG with AVX2: preparation, and queries that repay.

    rows: as `summary` gives them. ratios: as `ratios` gives them.
    """
    rows, ratios = (
        frame[frame["mode"].isin(["cold", "warm"])].astype(dict.fromkeys(PLACE, str))
        for frame in (rows, ratios)
    )
    rows = rows.astype({"engine": str})
    least = rows.groupby([*PLACE, "engine"], sort=False).build_ns.min()
    ratios = ratios[ratios["class"] == V3].set_index([*PLACE, "against"])
    own = rows[(rows["class"] == V3) & (rows.engine == VERIFIED)]
    return pd.DataFrame([_row(row, least, ratios) for _, row in own.iterrows()])


def _row(own: pd.Series, least: pd.Series, ratios: pd.DataFrame) -> dict[str, str]:
    place = tuple(own[PLACE])
    built = least[(*place, VERIFIED)]
    row = {
        **own.drop("question")[[name for name in PLACE if name != "question"]],
        "µs per body": f"{built / own.built / 1e3:,.0f}",
        "KiB per body": f"{own.bytes / own.built / 1024:,.0f}" if own.bytes >= 0 else "-",
        "mpr's queries": "-",
        "engine": "-",
        "its µs per body": "-",
        "engine's queries": "-",
    }
    pairs = max(own.built / 2, 1)  # of a body and itself one is built
    if (*place, "mpr") in ratios.index:
        row["mpr's queries"] = _queries(built / pairs, own.ns, ratios.loc[(*place, "mpr")])
    if (*place, "engine") in ratios.index:
        found = ratios.loc[(*place, "engine")]
        theirs = least[(*place, found.over)]
        row["engine"], row["its µs per body"] = found.over, f"{theirs / own.built / 1e3:,.0f}"
        row["engine's queries"] = _queries((built - theirs) / pairs, own.ns, found)
    return row


def _queries(ns: float, own: float, found: pd.Series) -> str:
    """How many queries save so many nanoseconds, each `own` of them long, to two digits."""
    if not found.low > 1:
        return "-"
    queries = max(ns, 0.0) / (own * (found.ratio - 1))
    return f"{float(f'{queries:.2g}'):,.0f}" if np.isfinite(queries) else "-"
