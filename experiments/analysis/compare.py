# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Compare two runs: accuracy case by case, time as ratios paired by case."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd

from experiments.run import piece_truth
from experiments.run.folder.rows import filled
from experiments.run.folder.store import Store
from experiments.run.progress import say

from . import costs, metrics, outcome

# Share of the step below which two times of impact count as equal, so that a difference in the last
# bit of libm is not a change.
SAME_TIME = 1e-9
ROUNDING = 1e-6  # a few units in the last place of float32
# The columns that define a query. The sines of another processor can move the last bit of a pose or
# vertex across a float32 boundary (7 bodies of 459 cases when AVX was masked); such a case is a
# different query, and its answers are not compared.
INPUT = (
    "body_a",
    "body_b",
    "quaternion_a",
    "position_a",
    "quaternion_b",
    "position_b",
    "displacement",
    "axis",
    "angle",
    "about",
    "displacement_b",
    "axis_b",
    "angle_b",
    "about_b",
)
REFERENCE = (
    *INPUT,
    "precision",
    "case",
    "scenario",
    "level",
    "question",
    "size",
    "faces",
    "tags",
    "label",
    "t_lo",
    "t_hi",
    "start",
    "end",
    "gap",
    "touching",
    "certificate",
)


@dataclass(frozen=True)
class Difference:
    """The differences between two runs.

    only_cases, only_methods: names that occur in one run only, (first, second). labels: cases whose
    certified truth changed. answers: rows (case, method, question, before, after) whose status,
    answer, outcome or time of impact changed. rates: accuracy per question and method before and
    after, where it changed. times: time ratios, second run to first, of the methods timed in both.
    compared: the number of pairs of case and method in both runs. remade: cases whose numbers
    differ in the second run; they are excluded from all of the above. mostly_remade: whether they
    are more than a tenth of the cases. changed: those of `remade` that differ by more than
    rounding; they are different queries, and the runs are not comparable.
    """

    only_cases: tuple[list[str], list[str]]
    only_methods: tuple[list[str], list[str]]
    labels: pd.DataFrame
    answers: pd.DataFrame
    rates: pd.DataFrame
    times: pd.DataFrame
    compared: int
    remade: list[str]
    mostly_remade: bool
    changed: list[str]

    @property
    def same_content(self) -> bool:
        return not any((*self.only_cases, *self.only_methods))

    @property
    def identical(self) -> bool:
        """Whether accuracy is the same, case by case, over the same cases and methods, and at most
        a tenth of the cases differ by rounding.
        """
        return (
            self.same_content
            and self.labels.empty
            and self.answers.empty
            and self.compared > 0
            and not self.mostly_remade
            and not self.changed
        )


def compare(first: Store, second: Store) -> Difference:
    """The differences between two runs. Raises StoreError for an unfinished run."""
    pieces = _judged_by_pieces(first, second)
    a, b = (
        outcome.outcomes(store, pieces, nested=False).drop(columns=list(INPUT), errors="ignore")
        for store in (first, second)
    )
    remade = _remade(first, second)
    both = a[~a.case.isin(remade)].merge(b, on=["case", "method"], suffixes=("_a", "_b"))
    labels = _labels(first, second)
    return Difference(
        _only(a.case, b.case),
        _only(a.method, b.method),
        labels[~labels.case.isin(remade)].reset_index(drop=True),
        _answers(both),
        _rates(both),
        _times(first, second),
        len(both),
        remade,
        len(remade) > 0.1 * a.case.nunique(),
        _changed(first, second, remade),
    )


def _judged_by_pieces(first: Store, second: Store) -> bool:
    """Whether both runs have certified pieces; prints a notice if only one has."""
    has = [store.has(piece_truth.FILES[0]) for store in (first, second)]
    if any(has) and not all(has):
        without = (first, second)[has.index(False)]
        say(
            f"{without.folder} has no {piece_truth.FILES[0]}, as it was made by an older version."
            " In both runs, methods that decompose meshes are judged by the labels of the meshes."
        )
    return all(has)


def _remade(first: Store, second: Store) -> list[str]:
    """Cases that occur in both runs with different bodies, poses or motions."""
    sides = [
        filled(store.read("cases.parquet"))
        .set_index("case")[list(INPUT)]
        .astype(str)
        .agg(" ".join, axis=1)
        for store in (first, second)
    ]
    before, after = sides[0].align(sides[1], join="inner")
    return list(before.index[before != after])


def _changed(first: Store, second: Store, remade: list[str]) -> list[str]:
    """The cases in `remade` that differ by more than rounding can explain."""
    sides = [
        filled(s.read("cases.parquet")).drop_duplicates("case").set_index("case")
        for s in (first, second)
    ]
    return [case for case in remade if not _rounded(*(side.loc[case] for side in sides))]


def _rounded(a: pd.Series, b: pd.Series) -> bool:
    """Whether two versions of a case differ only by rounding.

    Text and labels must be equal and numbers must agree within ROUNDING. Gaps may differ by half,
    since a small gap may result from rounding alone. Bodies are compared by size and number of
    faces, as a reference stores nothing else of them.
    """
    words = (
        "scenario",
        "level",
        "question",
        "precision",
        "faces",
        "tags",
        "label",
        "start",
        "end",
        "touching",
    )
    if any(a[c] != b[c] for c in words) or not np.isclose(
        a["size"], b["size"], rtol=ROUNDING, atol=0
    ):
        return False
    numbers = [c for c in INPUT if not c.startswith("body_")] + ["t_lo", "t_hi"]
    near = all(
        np.allclose(a[c], b[c], rtol=ROUNDING, atol=ROUNDING * a["size"], equal_nan=True)
        for c in numbers
    )
    return near and bool(np.isclose(a.gap, b.gap, rtol=0.5, atol=1e-12 * a["size"], equal_nan=True))


def reference(run: Store, into: Store) -> None:
    """Write to `into` what `compare` needs for accuracy: answers and labels, without bodies,
    certificates and times.
    """
    run.read("observations.parquet")
    cases = filled(run.read("cases.parquet")).assign(certificate="")
    into.write_text(run.config.model_dump_json(indent=1) + "\n", "config.json")
    into.write(cases[list(REFERENCE)], "cases.parquet")
    for name in piece_truth.FILES:
        into.path(name).unlink(missing_ok=True)
    if (pieces := piece_truth.read(run)) is not None:
        into.write(pieces.assign(certificate=""), piece_truth.FILES[0])
    into.write(
        run.read("observations.parquet").assign(detail=lambda t: t.detail.str.slice(0, 60)),
        "observations.parquet",
    )


def _only(a: pd.Series, b: pd.Series) -> tuple[list[str], list[str]]:
    left, right = dict.fromkeys(a), dict.fromkeys(b)
    return [x for x in left if x not in right], [x for x in right if x not in left]


def _labels(first: Store, second: Store) -> pd.DataFrame:
    columns = ["case", "label", "start", "end", "touching"]
    sides = [filled(store.read("cases.parquet"))[columns] for store in (first, second)]
    both = sides[0].merge(sides[1], on="case", suffixes=("_a", "_b"))
    moved = both[np.logical_or.reduce([both[f"{c}_a"] != both[f"{c}_b"] for c in columns[1:]])]
    words = {True: ", touching", False: ""}
    before, after = (moved[f"label_{s}"] + moved[f"touching_{s}"].map(words) for s in "ab")
    frame = pd.DataFrame({"case": moved.case, "before": before, "after": after})
    return frame.reset_index(drop=True)


def _answers(both: pd.DataFrame) -> pd.DataFrame:
    hits = [both[f"hit_{s}"].astype("boolean") for s in "ab"]
    verdict = ((hits[0] != hits[1]) | (hits[0].isna() != hits[1].isna())).fillna(False)
    late = ~np.isclose(both.time_a, both.time_b, rtol=0, atol=SAME_TIME, equal_nan=True)
    moved = both[
        verdict
        | late
        | (both.status_a != both.status_b)
        | (both.outcome_a != both.outcome_b)
        | (both.tunnelled_a != both.tunnelled_b)
    ]
    return pd.DataFrame(
        {
            "case": moved.case,
            "method": moved.method,
            "question": moved.question_a,
            "before": [_said(r, "a") for r in moved.to_dict("records")],
            "after": [_said(r, "b") for r in moved.to_dict("records")],
        }
    ).reset_index(drop=True)


def _said(row: dict, side: str) -> str:
    if row[f"status_{side}"] != "ok":
        return row[f"status_{side}"]
    time = row[f"time_{side}"]
    return (
        f"{'hit' if row[f'hit_{side}'] else 'clear'}{'' if np.isnan(time) else f' at {time:.9g}'}"
        f" ({row[f'outcome_{side}']})"
    )


def _rates(both: pd.DataFrame) -> pd.DataFrame:
    sides = []
    for s in "ab":
        names = (
            "outcome",
            "wrong",
            "within",
            "status",
            "label",
            "can_tunnel",
            "tunnelled",
            "question",
            "hit",
        )
        columns = {f"{c}_{s}": c for c in names}
        sides.append(metrics.rates(both.rename(columns=columns), ["question", "method"]))
    counts = [
        "answered",
        "hits",
        "misses",
        "clears",
        "false_alarms",
        "within",
        "contained",
        "touching",
        "tunnelled",
    ]
    table = sides[0].merge(sides[1], on=["question", "method"], suffixes=("_before", "_after"))
    moved = (
        table[[f"{c}_before" for c in counts]].to_numpy()
        != table[[f"{c}_after" for c in counts]].to_numpy()
    ).any(axis=1)
    return table.loc[
        moved,
        ["question", "method", *(f"{c}_{when}" for c in counts for when in ("before", "after"))],
    ].reset_index(drop=True)


def _times(first: Store, second: Store) -> pd.DataFrame:
    columns = ["question", "method", "ratio", "low", "high", "pairs"]
    if not (first.has("timings.parquet") and second.has("timings.parquet")):
        return pd.DataFrame(columns=columns)
    both = costs.case_costs(first).merge(
        costs.case_costs(second), on=["question", "method", "case"], suffixes=("_a", "_b")
    )
    both = both.assign(ratio=both.ns_b / both.ns_a)
    return costs.medians(both, "ratio", ["question", "method"]).rename(
        columns={"median": "ratio", "cases": "pairs"}
    )[columns]
