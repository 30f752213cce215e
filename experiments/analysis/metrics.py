"""Counts and rates against certified labels, never against another method."""

from __future__ import annotations

import numpy as np
import pandas as pd
from scipy.stats import binomtest

from experiments.run.folder.store import Store
from experiments.run.timing import FLOOR, LOST, PROBE

from .outcome import JUDGED, judge, out_of_their_depth, outcomes, with_pieces  # noqa: F401

#: count, total and the name of their rate
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
    """Counts per group of `by`, in order of first appearance: asked, answered, hits and misses,
    clears and false alarms, tunnelling.

    judged: the certified cases that the method answered, touching and contained ones left out.
    wrong: misses and false alarms of them. beyond: those of the wrong ones that are beyond the
    method's own tolerance. Rates are over the judged;
    *_low, *_high are Wilson intervals.
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
    """Errors of the time of impact per group, as shares of the step: how many, median of the
    absolute error, worst late and early.
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


def costs(store: Store, by=("question", "faces", "situation")) -> pd.DataFrame:
    """Nanoseconds per query for each group of `by` and method: gross (median over cases of the
    median over rounds), floor, net = gross - floor.

    low, high: 95 % bootstrap interval of gross over cases (scipy). build: the dearest `prepare` of
    the group, when caches are cold.
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
    """Net time of each method over that of `reference`, case by case on the cases both answered:
    median ratio, bootstrap interval.

    Without the groups that have no ratio: see `ratios`.
    """
    bins = ["question", "faces", "situation"]
    return ratios(case_costs(store), reference, bins).dropna(subset=["ratio"])


def case_costs(store: Store) -> pd.DataFrame:
    """A row per timed case and method: ns (median over rounds), floor of its bin, net = ns - floor
    or 0, build_ns.

    noise: of the floor, the interquartile range of all its rounds in the bin.
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
    """Whether the net time of each row of case_costs can be told from none: it is above the noise
    of the floor that was taken off."""
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

    Cases at which the reference's net time lies within the noise of its floor (see `told`) are no
    denominators: `in_noise` counts them, `pairs` the rest. A group of which they are half or more
    has no ratio (NaN), as its median would be of those that happened to take long.
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
    """timings.parquet without the probe and what was lost; ns: the median over rounds."""
    times = store.read("timings.parquet")
    times = times[~times.method.isin([PROBE, LOST])]
    return times.assign(ns=[float(np.median(r)) for r in times.rounds_ns])


def lost(store: Store) -> list[str]:
    """What was not timed because its process died or hung: the method, its bin and the reason."""
    rows = store.read("timings.parquet").query("method == @LOST")
    return [f"{r.case} ({r.question}, {r.faces} faces, {r.situation})" for r in rows.itertuples()]


def noise(store: Store) -> float:
    """How far the 90th percentile of the probe lies above its median, worst bin: 0.05 is a quiet
    machine, 0.3 a disturbed one.
    """
    probe = store.read("timings.parquet").query("method == @PROBE").rounds_ns
    return max(
        (float(np.percentile(r, 90) / np.median(r) - 1) for r in probe), default=float("nan")
    )


def _bootstrap(values: np.ndarray) -> tuple[float, float]:
    from scipy.stats import bootstrap

    if len(values) < 2 or np.ptp(values) == 0:
        return float(values[0]), float(values[0])
    interval = bootstrap(
        (values,), np.median, n_resamples=999, method="percentile", rng=np.random.default_rng(0)
    ).confidence_interval
    return float(interval.low), float(interval.high)
