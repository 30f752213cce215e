# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Views of the outcomes: bands of the gap, the cases common to all methods, and ranks on them."""

from __future__ import annotations

import numpy as np
import pandas as pd

from . import metrics

BANDS = (1e-2, 1e-4, 1e-7)  # bounds of |gap| / size by which tables are split
LEAST = 0.5  # a method that answers a smaller share is left out of the common cases


def gap_bands(relative_gap: pd.Series) -> tuple[pd.Series, list[str]]:
    """The band of each signed relative gap, and the bands in order from deep to far."""
    edges = [-np.inf, *(-b for b in BANDS), 0.0, *reversed(BANDS), np.inf]
    bounds = [f"{e:.0e}".replace("e-0", "e-") if e else "0" for e in edges[1:-1]]
    names = [
        f"below {bounds[0]}",
        *(f"{low} to {high}" for low, high in zip(bounds, bounds[1:])),
        f"above {bounds[-1]}",
    ]
    return pd.cut(relative_gap, edges, labels=names).astype(object), names


def closeness(relative_gap: pd.Series) -> tuple[pd.Series, list[str]]:
    """The band of the absolute value of each relative gap, and the bands in order from far to
    close.
    """
    edges = [0.0, *reversed(BANDS), np.inf]
    bounds = [f"{b:.0e}".replace("e-0", "e-") for b in reversed(BANDS)]
    names = [
        f"to {bounds[0]}",
        *(f"{low} to {high}" for low, high in zip(bounds, bounds[1:])),
        f"over {bounds[-1]}",
    ]
    return (
        pd.cut(relative_gap.abs(), edges, labels=names, include_lowest=True).astype(object),
        names[::-1],
    )


def common(found: pd.DataFrame) -> tuple[pd.DataFrame, list[str]]:
    """The rows of one question for the cases that all methods answered, and the methods left out.

    A method that answers less than half of the cases is left out, since otherwise few cases would
    be common.
    """
    answered = (found.status == "ok").groupby(found.method, sort=False).mean()
    left_out = list(answered.index[answered < LEAST])
    part = found[~found.method.isin(left_out)]
    whole = (part.status == "ok").groupby(part.case, sort=False).all()
    return part[part.case.isin(whole.index[whole])], left_out


def ranked(counts: pd.DataFrame, by: list[str] = ()) -> pd.Series:
    """The rank by number of wrong answers within each group of `by`, 1 for the fewest; methods with
    equal numbers share the best of their ranks.
    """
    wrong = counts.groupby(by, sort=False).wrong if by else counts.wrong
    return wrong.rank(method="min").astype(int)


def by_closeness(part: pd.DataFrame) -> tuple[pd.DataFrame, list[str]]:
    """Counts and ranks on common cases per band of |gap| / size."""
    bands, order = closeness(part.relative_gap)
    counts = metrics.rates(part.assign(band=bands).dropna(subset=["band"]), ["method", "band"])
    counts = counts[counts.judged > 0]
    return counts.assign(rank=ranked(counts, ["band"])), order


def by_scenario(part: pd.DataFrame) -> pd.DataFrame:
    """Per method, the mean over scenarios of the share of wrong answers (each scenario has the same
    weight), and the rank by it.
    """
    counts = metrics.rates(part, ["method", "scenario"])
    counts = counts[counts.judged > 0]
    means = (counts.wrong / counts.judged).groupby(counts.method, sort=False).mean()
    return pd.DataFrame(
        {
            "method": means.index,
            "weighted": means.to_numpy(),
            "weighted_rank": means.rank(method="min").astype(int).to_numpy(),
        }
    )
