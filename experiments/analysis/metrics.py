# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Counts and rates relative to certified labels, never to another method."""

from __future__ import annotations

import numpy as np
import pandas as pd
from scipy.stats import binomtest

from .outcome import JUDGED

#: columns of the count and its total, and the name of the rate
RATES = (
    ("misses", "hits", "miss"),
    ("false_alarms", "clears", "alarm"),
    ("tunnelled", "can_tunnel", "tunnel"),
    ("wrong", "judged", "wrong"),
    ("beyond", "judged", "beyond"),
)


def wilson(count: int, total: int) -> tuple[float, float]:
    """95 % Wilson score interval of a rate (scipy)."""
    if not total:
        return np.nan, np.nan
    interval = binomtest(int(count), int(total)).proportion_ci(method="wilson")
    return interval.low, interval.high


def rates(table: pd.DataFrame, by: list[str]) -> pd.DataFrame:
    """Counts per group of `by`, in order of first appearance: cases asked and answered, hits and
    misses, clears and false alarms, tunnelling.

    judged: certified cases that the method answered, without touching and contained cases. wrong:
    misses and false alarms among them. beyond: wrong answers outside the method's own tolerance.
    The denominators of the rates are in RATES; *_low and *_high are 95 % Wilson intervals.
    """
    judged = table.outcome.isin(JUDGED)
    touching = table.outcome == "touching"
    flags = pd.DataFrame(
        {
            "asked": 1,
            "answered": table.status == "ok",
            "unsupported": table.status == "unsupported",
            "failed": table.status.isin(["error", "timeout"]),
            "uncertain": table.label == "uncertain",
            "touching": touching,
            "touching_hits": touching & table.hit.fillna(False).astype(bool),
            "contained": table.outcome == "contained",
            "hits": judged & (table.label == "hit"),
            "misses": table.outcome == "miss",
            "clears": judged & (table.label == "clear"),
            "false_alarms": table.outcome == "false alarm",
            "judged": judged,
            "wrong": table.wrong,
            "within": table.within,
            "can_tunnel": table.can_tunnel,
            "tunnelled": table.tunnelled,
        }
    ).astype(int)
    counts = flags.groupby([table[name] for name in by], sort=False).sum().reset_index()
    counts["beyond"] = counts.wrong - counts.within
    for count, total, name in RATES:
        counts[f"{name}_rate"] = counts[count] / counts[total].where(counts[total] > 0)
        intervals = [wilson(c, t) for c, t in zip(counts[count], counts[total])]
        counts[f"{name}_low"], counts[f"{name}_high"] = zip(*intervals) if intervals else ((), ())
    return counts


def times_of_impact(table: pd.DataFrame, by: list[str]) -> pd.DataFrame:
    """Errors of the time of impact per group, as shares of the step: number, median and 95th
    percentile of the absolute error, and number and extreme of late and early errors.
    """
    found = table[table.error.notna()]
    grouped = found.groupby(by, sort=False).error
    return pd.DataFrame(
        {
            "times": grouped.size(),
            "median": grouped.agg(lambda e: e.abs().median()),
            "p95": grouped.agg(lambda e: e.abs().quantile(0.95)),
            "late": grouped.agg(lambda e: (e > 0).sum()),
            "worst_late": grouped.agg(lambda e: max(e.max(), 0.0)),
            "early": grouped.agg(lambda e: (e < 0).sum()),
            "worst_early": grouped.agg(lambda e: min(e.min(), 0.0)),
        }
    ).reset_index()
