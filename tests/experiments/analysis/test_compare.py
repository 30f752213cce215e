# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""compare sees every kind of change, and no change where there is none."""

import subprocess
import sys
from dataclasses import replace

import pandas as pd
import pytest

from experiments.analysis import compare
from experiments.cli import runner
from experiments.run.config import RunConfig
from experiments.run.folder.store import Store

CONFIG = RunConfig(
    seed=3,
    methods=["ofg k=4,8", "fcl-convex"],
    timing={"cases": 0},
    scenarios=[
        {"name": "feature_gap", "cases": 3, "levels": [0.01, -0.01]},
        {"name": "thin_wall", "cases": 3, "levels": [10.0]},
    ],
)


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    folder = tmp_path_factory.mktemp("compare") / "run"
    runner.run(CONFIG, folder)
    return Store(folder)


def changed(run, folder, frame="observations.parquet", change=lambda t: t):
    """A copy of what the reference of a run holds, changed."""
    copy = Store(folder)
    compare.reference(run, copy)
    copy.write(change(copy.read(frame)), frame)
    return copy


def set_at(column, value, pick=lambda t: t.status == "ok"):
    def change(table):
        table = table.copy()
        table.loc[table.index[pick(table)][0], column] = value(table) if callable(value) else value
        return table

    return change


def test_a_run_and_its_reference_are_identical(run, tmp_path):
    found = compare.compare(run, changed(run, tmp_path / "same"))
    assert found.identical and found.compared == 9 * 3 and found.times.empty


def flipped(table):
    return not table[table.status == "ok"].hit.iloc[0]


def timed(table):
    return (table.status == "ok") & table.time.notna()


@pytest.mark.parametrize(
    "change",
    [
        set_at("hit", flipped),
        set_at("status", "error"),
        set_at("time", lambda t: t[timed(t)].time.iloc[0] + 1e-6, timed),
    ],
)
def test_one_answer_that_moves_is_found(run, tmp_path, change):
    found = compare.compare(run, changed(run, tmp_path / "moved", change=change))
    assert not found.identical and len(found.answers) == 1 and found.same_content


def test_a_case_that_touches_now_is_a_label_that_moved(run, tmp_path):
    change = set_at("touching", True, lambda t: t.label == "clear")
    found = compare.compare(run, changed(run, tmp_path / "touching", "cases.parquet", change))
    assert found.labels[["before", "after"]].values.tolist() == [["clear", "clear, touching"]]
    assert not found.identical and (found.answers.after.str.contains("touching")).all()


def test_the_last_bit_of_a_time_is_no_change(run, tmp_path):
    other = changed(
        run,
        tmp_path / "bit",
        change=set_at("time", lambda t: t[timed(t)].time.iloc[0] * (1 + 2e-16), timed),
    )
    assert compare.compare(run, other).identical


def test_a_label_that_moves_is_found(run, tmp_path):
    other = changed(
        run,
        tmp_path / "label",
        "cases.parquet",
        set_at("label", "uncertain", lambda t: t.label == "hit"),
    )
    found = compare.compare(run, other)
    assert (
        not found.identical
        and list(found.labels.after) == ["uncertain"]
        and len(found.answers)
        and len(found.rates)
    )


@pytest.mark.parametrize("column, names", [("case", "only_cases"), ("method", "only_methods")])
def test_what_only_one_run_has_is_said(run, tmp_path, column, names):
    other = changed(run, tmp_path / "less", change=lambda t: t[t[column] != t[column].iloc[0]])
    found = compare.compare(run, other)
    assert (
        not found.identical
        and [len(side) for side in getattr(found, names)] == [1, 0]
        and found.answers.empty
    )


def moved_away(cases):
    cases = cases.copy()
    cases["angle"] = [9.0, *cases.angle[1:]]
    return cases


def test_a_case_that_asks_another_question_is_not_compared(run, tmp_path):
    other = changed(run, tmp_path / "remade", "cases.parquet", moved_away)
    found = compare.compare(run, other)
    assert len(found.remade) == 1 and found.compared == 8 * 3 and found.answers.empty
    assert not found.identical, "one of nine is more than a tenth"


def nudged(cases):
    """By a step of float32: what another processor's sines may do."""
    cases = cases.copy()
    cases["position_b"] = [cases.position_b[0] * (1 + 6e-8), *cases.position_b[1:]]
    return cases


@pytest.mark.parametrize("change, identical", [(nudged, True), (moved_away, False)])
def test_a_case_made_another_is_no_accuracy_kept(run, tmp_path, change, identical):
    """Up to a tenth of the cases could be made trivial, were left out, and accuracy was
    identical.
    """
    found = compare.compare(run, changed(run, tmp_path / "other", "cases.parquet", change))
    assert len(found.remade) == 1
    assert replace(found, mostly_remade=False).identical == identical, "as if one of many"


def test_time_is_paired_by_case(run, tmp_path):
    def timings(store, factor):
        rows = [
            ("overlap", "to 24", "near", "fcl-convex", case, 10, [int(factor * 1000 * (i + 1))] * 3)
            for i, case in enumerate("abcd")
        ]
        store.write(
            pd.DataFrame(
                rows,
                columns=[
                    "question",
                    "faces",
                    "situation",
                    "method",
                    "case",
                    "build_ns",
                    "rounds_ns",
                ],
            ),
            "timings.parquet",
        )
        return store

    first, second = (
        timings(changed(run, tmp_path / name), factor) for name, factor in (("x", 1), ("y", 3))
    )
    (row,) = compare.compare(first, second).times.to_dict("records")
    assert row["ratio"] == row["low"] == row["high"] == 3 and row["pairs"] == 4


def test_the_command_says_it_and_exits_accordingly(run, tmp_path):
    def ask(*words):
        return subprocess.run(
            [sys.executable, "-m", "experiments.cli", "compare", *map(str, words)],
            capture_output=True,
            text=True,
        )

    reference = tmp_path / "reference"
    assert ask(reference, run.folder, "--accept").returncode == 0
    same = ask(reference, run.folder)
    assert same.returncode == 0 and "Accuracy is identical" in same.stdout, same.stderr
    moved = ask(changed(run, tmp_path / "moved", change=set_at("hit", flipped)).folder, run.folder)
    assert moved.returncode == 1 and "NOT identical: 1 of 27 answers changed" in moved.stdout
    assert ask(reference, tmp_path / "nowhere").returncode == 2
