# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Query time: nanoseconds per group, and paired ratios between methods."""

from __future__ import annotations

import numpy as np
import pandas as pd
from scipy.stats import bootstrap

from experiments.run.folder.store import Store
from experiments.run.timing import FLOOR, LOST, PROBE


def costs(store: Store, by=("question", "faces", "situation")) -> pd.DataFrame:
    """Nanoseconds per query for each group of `by` and method: gross (median over cases of the
    median over rounds), floor, and net = max(gross - floor, 0).

    low, high: 95 % bootstrap interval of gross over cases (scipy). build: the longest `prepare` of
    the group, with cold caches.
    """
    times = _timed(store)
    rows = []
    for key, group in times.groupby([*by, "method"], sort=False):
        floor, real = group.ns[group.case == FLOOR], group.ns[group.case != FLOOR].to_numpy()
        if len(real):
            least = float(floor.median()) if len(floor) else np.nan
            low, high = _bootstrap(real)
            rows.append(
                {
                    **dict(zip([*by, "method"], key)),
                    "cases": len(real),
                    "gross": np.median(real),
                    "low": low,
                    "high": high,
                    "floor": least,
                    "net": max(np.median(real) - least, 0.0),
                    "build": float(group.build_ns.max()),
                }
            )
    return pd.DataFrame(
        rows, columns=[*by, "method", "cases", "gross", "low", "high", "floor", "net", "build"]
    )


def paired_ratios(store: Store, reference: str) -> pd.DataFrame:
    """Ratio of the net time of each method to that of `reference`, case by case on the cases that
    both answered: median and bootstrap interval.

    Groups without a ratio are omitted: see `ratios`.
    """
    bins = ["question", "faces", "situation"]
    return ratios(case_costs(store), reference, bins).dropna(subset=["ratio"])


def case_costs(store: Store) -> pd.DataFrame:
    """A row per timed case and method: ns (median over rounds), floor of its bin, net =
    max(ns - floor, 0), build_ns.

    noise: the interquartile range of all rounds of the floor in the bin, ns.
    """
    key = ["question", "faces", "situation", "method"]
    times = _timed(store)
    floors = times[times.case == FLOOR].groupby(key)
    floor = floors.agg(floor=("ns", "median"), noise=("rounds_ns", _spread))
    found = times[times.case != FLOOR].join(floor, on=key)
    return found.assign(net=lambda t: (t.ns - t.floor).clip(lower=0))


def _spread(rounds: pd.Series) -> float:
    low, high = np.percentile(np.concatenate(rounds.to_list()), [25, 75])
    return float(high - low)


def told(times: pd.DataFrame, side: str = "") -> pd.Series:
    """Whether the net time of each row of case_costs is distinguishable from zero: it exceeds the
    noise of the subtracted floor."""
    return times[f"net{side}"] > times[f"noise{side}"]


def medians(values: pd.DataFrame, column: str, by: list[str]) -> pd.DataFrame:
    """Median of `column` per group of `by`, its 95 % bootstrap interval (low, high) and the number
    of cases.
    """
    rows = []
    for key, group in values.groupby(by, sort=False):
        found = group[column].to_numpy()
        low, high = _bootstrap(found)
        rows.append(
            {
                **dict(zip(by, key)),
                "median": float(np.median(found)),
                "low": low,
                "high": high,
                "cases": len(found),
            }
        )
    return pd.DataFrame(rows, columns=[*by, "median", "low", "high", "cases"])


def ratios(times: pd.DataFrame, reference: str, by: list[str]) -> pd.DataFrame:
    """`paired_ratios` of rows of case_costs, for each group of `by` and method.

    Cases in which the reference's net time lies within the noise of its floor (see `told`) are not
    used as denominators: `in_noise` counts them, `pairs` counts the rest. If they are half of a
    group or more, its ratio is NaN, since the median would be biased towards slow cases.
    """
    base = times[times.method == reference][["case", "net", "noise"]]
    both, rows = times.merge(base, on="case", suffixes=("", "_reference")), []
    for key, group in both.groupby([*by, "method"], sort=False):
        sure = group[told(group, "_reference")]
        ratio = (sure.net / sure.net_reference).to_numpy()
        enough = 2 * len(sure) > len(group)
        low, high = _bootstrap(ratio) if enough else (np.nan, np.nan)
        value = np.median(ratio) if enough else np.nan
        counts = {"pairs": len(sure), "in_noise": len(group) - len(sure)}
        rows.append(dict(zip([*by, "method"], key), ratio=value, low=low, high=high, **counts))
    return pd.DataFrame(rows, columns=[*by, "method", "ratio", "low", "high", "pairs", "in_noise"])


def _timed(store: Store) -> pd.DataFrame:
    """timings.parquet without the noise probe and lost timings; ns: the median over rounds."""
    times = store.read("timings.parquet")
    times = times[~times.method.isin([PROBE, LOST])]
    return times.assign(ns=[float(np.median(r)) for r in times.rounds_ns])


def lost(store: Store) -> list[str]:
    """Timings lost because the process died or hung: the method, its bin and the reason."""
    rows = store.read("timings.parquet").query("method == @LOST")
    return [f"{r.case} ({r.question}, {r.faces} faces, {r.situation})" for r in rows.itertuples()]


def noise(store: Store) -> float:
    """Relative excess of the probe's 90th percentile over its median, in the worst bin: 0.05
    indicates a quiet machine, 0.3 a disturbed one.
    """
    probe = store.read("timings.parquet").query("method == @PROBE").rounds_ns
    return max(
        (float(np.percentile(r, 90) / np.median(r) - 1) for r in probe), default=float("nan")
    )


def _bootstrap(values: np.ndarray) -> tuple[float, float]:
    if len(values) < 2 or np.ptp(values) == 0:
        return float(values[0]), float(values[0])
    interval = bootstrap(
        (values,), np.median, n_resamples=999, method="percentile", rng=np.random.default_rng(0)
    ).confidence_interval
    return float(interval.low), float(interval.high)
