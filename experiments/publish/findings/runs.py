# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The runs of a folder, and the numbers computed from their rows, always by metrics.py."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
import pandas as pd

from experiments.analysis import costs, metrics, outcome
from experiments.analysis.tables import chosen
from experiments.run.folder.store import Store, StoreError
from experiments.studies import sizes

from . import ends

MISSES = 0.05  # a rate of misses is small if its interval lies below this, large if above it
LATE = 1e-3  # tolerated error of an estimate of the time of impact, as a share of the step
NOISY = "within the noise"  # instead of a ratio: see costs.ratios
HOLDS, PART, FAILS, OPEN, UNMEASURED = "holds", "holds in part", "fails", "open", "not measured"


class Missing(Exception):
    """A finding cannot be computed, because a run or rows of it are missing."""


class Runs:
    """The runs in a folder of results, each read on first use. Every method raises Missing if its
    run is missing.
    """

    def __init__(self, folder):
        self.folder = Path(folder)
        self._read: dict = {}

    def answers(self, run: str) -> pd.DataFrame:
        """outcome.outcomes of a run."""
        return self._once(("answers", run), lambda: outcome.outcomes(Store(self.folder / run)))

    def times(self, run: str) -> pd.DataFrame:
        """costs.case_costs of a run, with the scenario and level of each case."""
        cases = lambda: self.answers(run)[["case", "scenario", "level"]].drop_duplicates()  # noqa: E731
        return self._once(
            ("times", run),
            lambda: costs.case_costs(Store(self.folder / run)).merge(cases(), on="case"),
        )

    def bodies(self, run: str) -> pd.Series:
        """The kinds of the two bodies, such as "convex and mesh", by case."""
        return self._once(("bodies", run), lambda: kinds(Store(self.folder / run)))

    def known(self, run: str) -> pd.DataFrame:
        """ends.known of the cases of a run."""
        return self._once(("known", run), lambda: ends.known(Store(self.folder / run)))

    def file(self, name: str) -> pd.DataFrame:
        """A frame in the folder: sizes/sizes.parquet, native/rows.parquet, native/ratios.parquet
        or stepping/stepping.parquet.
        """
        read = pd.read_csv if name.endswith(".csv") else pd.read_parquet
        return self._once(("file", name), lambda: read(self.folder / name))

    @cached_property
    def board(self) -> str:
        """The run with every family: standard, or quick if standard is missing."""
        return next(
            (
                run
                for run in ("standard", "quick")
                if (self.folder / run / "observations.parquet").exists()
            ),
            "standard",
        )

    @cached_property
    def finished(self) -> list[str]:
        return sorted(p.parent.name for p in self.folder.glob("*/observations.parquet"))

    def link(self, path: str, name: str = "") -> str:
        """A link to a file in the folder; the default name is that of the file. Only the name if
        the file does not exist.
        """
        name = name or Path(path).stem
        return f"[{name}]({path})" if (self.folder / path).exists() else name

    def links(self, paths) -> str:
        """Links to several files; {board} in a path is the run with every family."""
        return ", ".join(self.link(p.format(board=self.board)) for p in paths)

    def _once(self, key, read):
        if key not in self._read:
            try:
                self._read[key] = read()
            except (StoreError, FileNotFoundError):
                run = key[1].split("/")[0]
                raise Missing(
                    f"run {run} is missing"
                    if not (self.folder / run).exists()
                    else f"run {run} is not finished, or has no times"
                ) from None
        return self._read[key]


@dataclass(frozen=True)
class Rate:
    count: int
    total: int
    low: float
    high: float

    def __str__(self) -> str:
        return f"{self.count}/{self.total} ({100 * self.low:.1f}-{100 * self.high:.1f} %)"

    @property
    def small(self) -> bool:
        return self.high <= MISSES

    @property
    def large(self) -> bool:
        return self.low > MISSES


def kinds(store: Store) -> pd.Series:
    """The kinds of the two bodies of each case of a run, in alphabetical order."""
    cases = store.read("cases.parquet")
    kind = store.read("bodies.parquet").set_index("body").kind
    pairs = zip(cases.body_a.map(kind), cases.body_b.map(kind))
    return pd.Series([" and ".join(sorted(pair)) for pair in pairs], cases.case)


def overall(verdicts) -> str:
    """The verdict on a claim from the verdicts on its parts."""
    found = set(verdicts)
    return found.pop() if len(found) == 1 else PART


def rows(frame: pd.DataFrame, **wanted) -> pd.DataFrame:
    """The rows whose columns have the wanted value, or one of several. Raises Missing if there are
    none.
    """
    for column, value in wanted.items():
        frame = frame[frame[column].isin(value if isinstance(value, (list, tuple)) else [value])]
    if frame.empty:
        raise Missing("no rows with " + ", ".join(f"{c} {v}" for c, v in wanted.items()))
    return frame


def rate(frame: pd.DataFrame, kind: str = "misses", **wanted) -> Rate:
    """The rate of misses, false alarms or tunnelled cases, by metrics.rates. Raises Missing if its
    total is 0.
    """
    count, total, interval, _ = chosen.COUNTS[kind]
    part = rows(frame, **wanted)
    found = metrics.rates(part.assign(all=0), ["all"]).iloc[0]
    if not found[total]:
        raise Missing(f"no certified {total} among {len(part)} rows")
    return Rate(
        int(found[count]), int(found[total]), found[f"{interval}_low"], found[f"{interval}_high"]
    )


def size_rates(runs: Runs, depth: str, k: int) -> dict[int, Rate]:
    """Rates of misses of the sizes study at a depth, by number of faces; only sizes above k."""
    found = rows(sizes.misses(runs.file("sizes/sizes.parquet")), depth=depth, k=k, repairs=False)
    found = rows(found[found.faces > k], depth=depth)
    return {r.faces: Rate(r.misses, r.hits, r.miss_low, r.miss_high) for r in found.itertuples()}


def are_small(rates) -> str:
    """The verdict on a claim that all rates are small."""
    rates = list(rates)
    if all(r.small for r in rates):
        return HOLDS
    if all(r.large for r in rates):
        return FAILS
    return PART if any(r.large for r in rates) else OPEN


def ratio(times: pd.DataFrame, method: str, reference: str, by) -> pd.DataFrame:
    """costs.ratios of one method, indexed by `by`: ratio, low, high, pairs, in_noise."""
    groups = [by] if isinstance(by, str) else by
    found = costs.ratios(rows(times, method=[method, reference]), reference, groups)
    return rows(found, method=method).set_index(by).sort_index()


def or_reason(find: Callable, *given, **named) -> str:
    """The result of find(*given, **named), or why it is missing. For text that accompanies a
    verdict without deciding it.
    """
    try:
        return str(find(*given, **named))
    except Missing as reason:
        return f"not measured ({reason})"


def ratios_listed(times: Callable[[], pd.DataFrame], method: str, reference: str, by: str) -> str:
    return or_reason(
        lambda: listed(
            (key, times_more(r)) for key, r in ratio(times(), method, reference, by).iterrows()
        )
    )


def listed(values, form: Callable = str) -> str:
    return "; ".join(
        (
            f"{key:g}: {form(value)}"
            if isinstance(key, (int, float, np.number))
            else f"{key}: {form(value)}"
        )
        for key, value in dict(values).items()
    )


def spread(rates: dict) -> str:
    """The lowest and the highest of several rates, with their keys."""
    named = {
        f"{key} faces" if isinstance(key, (int, np.integer)) else key: r for key, r in rates.items()
    }
    low, *_, high = sorted(
        named, key=lambda key: (named[key].count / named[key].total, named[key].total)
    ) * (2 if len(named) == 1 else 1)
    return f"{low} {named[low]}" if low == high else f"{low} {named[low]} to {high} {named[high]}"


def interval(r) -> str:
    """A ratio and its interval, with three digits each and no powers of ten."""
    if np.isnan(r.ratio):
        return NOISY
    value, low, high = (f"{v:.0f}" if v >= 100 else f"{v:.3g}" for v in (r.ratio, r.low, r.high))
    return f"{value} [{low}, {high}]"


def times_more(r) -> str:
    return NOISY if np.isnan(r.ratio) else f"{interval(r)}, n={r.pairs}"


def share_of(flags: pd.Series) -> Rate:
    """The share of true flags. Raises Missing if there are no flags."""
    if flags.empty:
        raise Missing("no such rows")
    count = int(flags.sum())
    return Rate(count, len(flags), *metrics.wilson(count, len(flags)))


def worst_families(found: pd.DataFrame, method: str, kind: str = "misses", n: int = 2) -> str:
    """The families with the highest rates of a method, among those with a count above 0."""
    each = by_family(found, method, kind)
    some = [name for name in each if each[name].count]
    worst = sorted(some, key=lambda name: each[name].count / each[name].total)[-n:]
    return listed({name: each[name] for name in reversed(worst)}) or "no family"


def by_family(found: pd.DataFrame, method: str, kind: str = "misses") -> dict[str, Rate]:
    """The rate of a method in each family with such cases."""
    label = "clear" if kind == "false alarms" else "hit"
    such = rows(found, method=method, label=label, status="ok")
    return {f"`{name}`": rate(part, kind) for name, part in such.groupby("scenario", sort=False)}


def wrong_rate(part: pd.DataFrame) -> Rate:
    """The rate of misses and false alarms, of the certified cases answered."""
    counts = metrics.rates(part.assign(all=0), ["all"]).iloc[0]
    count, total = int(counts.misses + counts.false_alarms), int(counts.hits + counts.clears)
    return Rate(count, total, *metrics.wilson(count, total))


def grid(made: list[dict]) -> str:
    """A Markdown table of the columns in which any row has an entry."""
    columns = [
        c
        for c in dict.fromkeys(c for row in made for c in row)
        if any(row.get(c, "-") != "-" for row in made)
    ]
    lines = [
        columns,
        ["---"] * len(columns),
        *([row.get(c, "-").replace("|", "\\|") for c in columns] for row in made),
    ]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)
