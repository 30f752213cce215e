"""Counts and rates against certified labels, never against another method."""

from __future__ import annotations

import numpy as np
import pandas as pd
from scipy.stats import binomtest

from baselines import registry

from . import piece_truth
from .rows import filled
from .store import Store, StoreError
from .timing import FLOOR, LOST, PROBE, situation_of

OUTCOMES = ("right", "miss", "false alarm", "conservative", "touching", "no label", "unsupported",
            "error", "timeout")


def outcomes(store: Store, by_pieces: bool = True) -> pd.DataFrame:
    """One row per case and method: the observation, the truth, and what came of it.

    outcome: "right"; "miss" (certified hit, answered clear); "false alarm" (certified clear, answered hit); "conservative" (a false
    alarm at a certified clearance within the method's documented margin); "touching" (the closed
    bodies share a point and no more, where neither answer is wrong: in no rate); "no label" (truth uncertain); or the status where it
    is not ok. tunnelled: a miss of a sweep whose start and end are certified clear. error: signed time of impact error, as a share
    of the step: beyond the certified bracket, positive late, negative early, 0 inside; NaN where there is none.
    truth: "pieces" where a method that decomposes was asked about a mesh: label, bracket and gap are then those of the pieces,
    relative_gap and situation stay the mesh's; else "mesh", and everywhere with by_pieces false.
    """
    said, cases = store.read("observations.parquet"), store.read("cases.parquet")
    unknown = said.case[~said.case.isin(cases.case)]
    if len(unknown):
        raise StoreError(f"{store.folder / 'observations.parquet'} has answers to the case '{unknown.iloc[0]}', which is not in cases.parquet. "
                         "The run was changed or is damaged; take it anew from where it was made, or make it again.")
    return judge(said, cases, piece_truth.read(store) if by_pieces else None)


def judge(observations: pd.DataFrame, cases: pd.DataFrame,
          pieces: pd.DataFrame | None = None) -> pd.DataFrame:
    """`outcomes` for rows of observations.parquet, of cases.parquet and of pieces.parquet."""
    cases = filled(cases)
    cases = cases.assign(touching=cases.touching.astype(bool))
    table = observations.merge(cases.drop(columns=["certificate"]), on="case", how="left", validate="many_to_one")
    table["relative_gap"], table["situation"] = table.gap / table["size"], situation_of(table)
    table = piece_truth.put(table, pieces)
    answered, hit = table.status == "ok", table.hit.fillna(False).astype(bool)
    margin = table.method.map(margins(table.method.unique()))
    clear, meets = table.label == "clear", table.label == "hit"
    alarm = answered & clear & hit
    table["outcome"] = np.select(
        [~answered, table.label == "uncertain", table.touching, meets & ~hit, alarm & (table.gap <= margin),
         alarm],
        [table.status, "no label", "touching", "miss", "conservative", "false alarm"], "right")
    sweep = table.question != "overlap"
    table["can_tunnel"] = answered & sweep & meets & (table.start == "clear") & (table.end == "clear")
    table["tunnelled"] = table.can_tunnel & ~hit
    late, early = (table.time - table.t_hi).clip(lower=0), (table.time - table.t_lo).clip(upper=0)
    timed = answered & sweep & meets & hit & table.time.notna() & (table.start == "clear")
    table["error"] = (late + early).where(timed)
    return table


def with_pieces(store: Store, found: pd.DataFrame) -> pd.DataFrame:
    """`outcomes`, and after them what the pieces say of the meshes, by the meshes' truth."""
    pieces = piece_truth.read(store)
    if pieces is None:
        return found
    cases = filled(store.read("cases.parquet"))
    own = judge(piece_truth.own_error(cases, pieces), cases)
    return pd.concat([found, own], ignore_index=True) if len(own) else found


def out_of_their_depth(table: pd.DataFrame) -> set[str]:
    """Labels of single-precision methods that answered cases given in double precision."""
    asked = table[(table.precision == "float64") & (table.status == "ok")].method.unique()
    return {label for label in asked if _precision(label) == "single"}


def _precision(label: str) -> str:
    """As the method declares it; "double" for one whose file is not there any more."""
    try:
        return registry.make(label)[0].precision
    except (ValueError, ImportError):
        return "double"


def margins(labels) -> dict[str, float]:
    """The documented margin (length) of each method label; 0 for one whose file is not there any more."""
    known = registry.methods()
    return {label: float(getattr(known.get(label.split()[0]), "margin", 0.0)) for label in labels}


def wilson(count: int, total: int) -> tuple[float, float]:
    """95 % Wilson score interval of a rate (scipy)."""
    if not total:
        return np.nan, np.nan
    interval = binomtest(int(count), int(total)).proportion_ci(method="wilson")
    return interval.low, interval.high


def rates(table: pd.DataFrame, by: list[str]) -> pd.DataFrame:
    """Counts per group of `by`, in order of first appearance: asked, answered, hits and misses, clears and false alarms, tunnelling.

    Rates are over the certified cases that the method answered; *_low, *_high are Wilson intervals.
    """
    labelled = table.outcome.isin(["right", "miss", "false alarm", "conservative"])
    touching = table.outcome == "touching"
    flags = pd.DataFrame({
        "asked": 1, "answered": table.status == "ok", "unsupported": table.status == "unsupported",
        "failed": table.status.isin(["error", "timeout"]), "uncertain": table.label == "uncertain",
        "touching": touching, "touching_hits": touching & table.hit.fillna(False).astype(bool),
        "hits": labelled & (table.label == "hit"), "misses": table.outcome == "miss",
        "clears": labelled & (table.label == "clear"), "false_alarms": table.outcome == "false alarm",
        "conservative": table.outcome == "conservative", "can_tunnel": table.can_tunnel, "tunnelled": table.tunnelled,
    }).astype(int)
    counts = flags.groupby([table[name] for name in by], sort=False).sum().reset_index()
    for count, total, name in (("misses", "hits", "miss"), ("false_alarms", "clears", "alarm"), ("tunnelled", "can_tunnel", "tunnel")):
        counts[f"{name}_rate"] = counts[count] / counts[total].where(counts[total] > 0)
        intervals = [wilson(c, t) for c, t in zip(counts[count], counts[total])]
        counts[f"{name}_low"], counts[f"{name}_high"] = zip(*intervals) if intervals else ((), ())
    return counts


def times_of_impact(table: pd.DataFrame, by: list[str]) -> pd.DataFrame:
    """Errors of the time of impact per group, as shares of the step: how many, median of the absolute error, worst late and early."""
    found = table[table.error.notna()]
    grouped = found.groupby(by, sort=False).error
    return pd.DataFrame({
        "times": grouped.size(), "median": grouped.agg(lambda e: e.abs().median()), "p95": grouped.agg(lambda e: e.abs().quantile(0.95)),
        "late": grouped.agg(lambda e: (e > 0).sum()), "worst_late": grouped.agg(lambda e: max(e.max(), 0.0)),
        "early": grouped.agg(lambda e: (e < 0).sum()), "worst_early": grouped.agg(lambda e: min(e.min(), 0.0)),
    }).reset_index()


def costs(store: Store, by=("question", "faces", "situation")) -> pd.DataFrame:
    """Nanoseconds per query for each group of `by` and method: gross (median over cases of the median over rounds), floor, net = gross - floor.

    low, high: 95 % bootstrap interval of gross over cases (scipy). build: the dearest `prepare` of the group, when caches are cold.
    """
    times = _timed(store)
    rows = []
    for key, group in times.groupby([*by, "method"], sort=False):
        floor, real = group.ns[group.case == FLOOR], group.ns[group.case != FLOOR].to_numpy()
        if len(real):
            least = float(floor.median()) if len(floor) else np.nan
            low, high = _bootstrap(real)
            rows.append({**dict(zip([*by, "method"], key)), "cases": len(real), "gross": np.median(real), "low": low, "high": high,
                         "floor": least, "net": max(np.median(real) - least, 0.0), "build": float(group.build_ns.max())})
    return pd.DataFrame(rows, columns=[*by, "method", "cases", "gross", "low", "high", "floor", "net", "build"])


def paired_ratios(store: Store, reference: str) -> pd.DataFrame:
    """Net time of each method over that of `reference`, case by case on the cases both answered: median ratio, bootstrap interval.

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
    """Median of `column` per group of `by`, its 95 % bootstrap interval (low, high) and the number of cases."""
    rows = []
    for key, group in values.groupby(by, sort=False):
        found = group[column].to_numpy()
        low, high = _bootstrap(found)
        rows.append({**dict(zip(by, key)), "median": float(np.median(found)), "low": low, "high": high, "cases": len(found)})
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
    """How far the 90th percentile of the probe lies above its median, worst bin: 0.05 is a quiet machine, 0.3 a disturbed one."""
    probe = store.read("timings.parquet").query("method == @PROBE").rounds_ns
    return max((float(np.percentile(r, 90) / np.median(r) - 1) for r in probe), default=float("nan"))


def _bootstrap(values: np.ndarray) -> tuple[float, float]:
    from scipy.stats import bootstrap

    if len(values) < 2 or np.ptp(values) == 0:
        return float(values[0]), float(values[0])
    interval = bootstrap((values,), np.median, n_resamples=999, method="percentile", rng=np.random.default_rng(0)).confidence_interval
    return float(interval.low), float(interval.high)
