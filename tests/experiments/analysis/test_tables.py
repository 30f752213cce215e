# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Tables of an experiment: counts worked out by hand, columns in order, LaTeX that closes what it
opens.
"""

import re

import numpy as np
import pandas as pd
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from experiments.analysis import metrics, outcome, tables
from experiments.analysis.tables import accuracy, chosen, labels
from experiments.analysis.tables.table import latex
from experiments.cli.screen import _strips, _width, console
from experiments.run.config import RunConfig, TableChoice

from .cubes import BODIES, placed

nan = np.nan


class Run:
    """A run in memory: two scenarios' levels, one method that misses at level 2, one that does not
    answer.
    """

    config = RunConfig(
        seed=1,
        methods=["ofg"],
        scenarios=[{"name": "deep", "cases": 1}],
        timing={"reference": "ofg k=8"},
    )

    def __init__(self):
        cases = [
            ("a", 1.0, "hit", "face"),
            ("b", 2.0, "hit", "edge"),
            ("c", 2.0, "hit", "edge"),
            ("d", 10.0, "clear", "face"),
            ("e", 10.0, "uncertain", "edge"),
        ]
        self.cases = pd.DataFrame(
            [
                {
                    "case": c,
                    "scenario": "deep",
                    "level": level,
                    "question": "overlap",
                    "label": label,
                    "start": "uncertain",
                    "end": "uncertain",
                    "gap": 0.5 if label == "clear" else -0.5,
                    "t_lo": nan,
                    "t_hi": nan,
                    "size": 1.0,
                    "faces": 12,
                    "certificate": "",
                    "tags": f'{{"feature": "{tag}"}}',
                }
                for c, level, label, tag in cases
            ]
        )
        rows = [("ofg k=8", c, "ok", c != "b", nan, "") for c in "abcde"] + [
            ("brute-force", c, "unsupported", None, nan, "takes no such body") for c in "abcde"
        ]
        self.observations = pd.DataFrame(
            rows, columns=["method", "case", "status", "hit", "time", "detail"]
        ).astype({"hit": "boolean"})
        times = [
            ("overlap", "to 24", "deep", m, c, build, ns)
            for m, scale in (("ofg k=8", 1), ("brute-force", 4))
            for c, build, ns in (
                ("(floor)", 0, [100] * 3),
                ("a", 5000, [100 + 1000 * scale] * 3),
                ("b", 5000, [100 + 2000 * scale] * 3),
            )
        ]
        times.append(("overlap", "to 24", "deep", "(noise probe)", "", 0, [10, 10, 10]))
        self.timings = pd.DataFrame(
            times,
            columns=["question", "faces", "situation", "method", "case", "build_ns", "rounds_ns"],
        )

        self.cases, self.bodies = placed(self.cases), BODIES

    def has(self, name):
        return hasattr(self, name.removesuffix(".parquet"))

    def read(self, name):
        return getattr(self, name.removesuffix(".parquet"))


def made(value, **more):
    run = Run()
    return chosen.chosen_table(
        run, outcome.outcomes(run), TableChoice(name="t", title="T.", value=value, **more)
    )


@pytest.mark.parametrize(
    "value, columns, expected",
    [
        ("misses", "level", {"1": "0/1", "2": "1/2"}),
        ("misses", "feature", {"edge": "1/2", "face": "0/1"}),
        ("false alarms", "level", {"10": "1/1"}),
        ("wrong", "level", {"1": "0/1", "2": "1/2", "10": "1/1"}),
        ("wrong", "question", {"overlap": "2/4"}),
        ("wrong", "faces", {"to 24": "2/4"}),
        ("misses", "situation", {"deep": "1/3"}),
        ("net time", "level", {"1": "1.00", "2": "2.00"}),
        ("gross time", "level", {"1": "1.10", "2": "2.10"}),
        ("build time", "level", {"1": "5.00", "2": "5.00"}),
    ],
)
def test_cells_by_hand(value, columns, expected):
    row = made(value, columns=columns).text.set_index("method").loc["ofg k=8"]
    assert {k: v for k, v in row.items() if v != "-"} == expected


def test_columns_stand_in_the_order_of_their_numbers():
    assert list(made("answered").text.columns) == ["method", "1", "2", "10"]


def test_who_answers_nothing_is_counted_as_such_and_never_as_wrong():
    assert list(made("answered").text.set_index("method").loc["brute-force"]) == [
        "0/1",
        "0/2",
        "0/2",
    ]
    assert list(made("wrong").text.method) == ["ofg k=8"]


def test_intervals_are_in_the_csv():
    numbers = made("misses").numbers.set_index(["method", "level"])
    assert tuple(numbers.loc[("ofg k=8", "2"), ["miss_low", "miss_high"]]) == metrics.wilson(1, 2)
    wrong = made("wrong", columns="question").numbers.set_index("method").loc["ofg k=8"]
    assert (wrong.wrong_low, wrong.wrong_high) == metrics.wilson(2, 4)


def test_ratios_are_net_and_paired():
    run = Run()
    run.observations["status"], run.observations["hit"] = "ok", True
    table = chosen.chosen_table(
        run, outcome.outcomes(run), TableChoice(name="t", title="T.", value="ratio")
    )
    assert table.text.set_index("method").loc["brute-force", "1"] == "4 [4, 4]"


WORDS = st.text(
    st.characters(codec="utf-8", exclude_categories=("C", "Z")), min_size=1, max_size=12
)


@settings(deadline=None)
@given(WORDS, WORDS, st.lists(WORDS, min_size=1, max_size=4, unique=True))
def test_latex_closes_what_it_opens_and_lets_nothing_through(title, caption, cells):
    frame = pd.DataFrame([cells], columns=[f"c{i}" for i in range(len(cells))])
    check_latex(latex(tables.Table("name", title, caption, frame, frame)), len(cells))


def check_latex(text: str, columns: int) -> None:
    opened = []
    for kind, name in re.findall(r"\\(begin|end)\{(\w+)\}", text):
        if kind == "begin":
            opened.append(name)
        else:
            assert opened.pop() == name
    assert (
        not opened
        and text.count(r"\toprule") == text.count(r"\midrule") == text.count(r"\bottomrule") == 1
    )
    bare = text.replace(r"\\", "").replace(r"\{", "").replace(r"\}", "")
    assert bare.count("{") == bare.count("}")
    rows = [line for line in text.splitlines() if line.endswith(r"\\")]
    assert rows and all(len(re.findall(r"(?<!\\)&", row)) == columns - 1 for row in rows)
    assert not re.search(r"(?<!\\)[%#$_]", text.replace("\\label{tab:name}", ""))


def test_latex_of_a_real_table():
    check_latex(latex(made("misses")).replace("{tab:t}", "{tab:name}"), 4)


def test_a_wide_table_is_printed_in_strips_that_fit(monkeypatch):
    monkeypatch.setattr(console, "_width", 60)
    text = pd.DataFrame(
        {"method": ["ofg k=8"], **{f"column {i}": ["1234567890"] for i in range(12)}}
    )
    strips = _strips(text)
    assert len(strips) > 1 and [c for strip in strips for c in strip[1:]] == list(text.columns[1:])
    assert all(strip[0] == "method" and _width(text[strip]) <= console.width for strip in strips)


def test_the_leaderboard_counts_all_questions_and_puts_the_least_share_of_errors_first():
    run = Run()
    swept = run.cases.assign(
        case=run.cases.case + "2", question="translation", start="clear", end="clear"
    )
    run.cases = pd.concat([run.cases, swept], ignore_index=True)
    more = [("ofg k=8", c + "2", "ok", c in "abc", nan, "") for c in "abcde"] + [
        ("brute-force", c, "ok", c in "abc", nan, "") for c in "abcde"
    ]
    more = pd.DataFrame(more, columns=run.observations.columns).astype({"hit": "boolean"})
    run.observations = pd.concat(
        [run.observations[run.observations.method == "ofg k=8"], more], ignore_index=True
    )
    found = outcome.outcomes(run)
    text = accuracy.leaderboards(found)[0].text.set_index("method")
    assert list(text.index) == ["brute-force", "ofg k=8"]  # 0 of 4; 2 of 8
    own = text.loc["ofg k=8"]
    assert (
        own.wrong,
        own["overlap missed"],
        own["overlap false"],
        own["translation missed"],
        own["translation false"],
    ) == ("2/8", "1/3", "1/1", "0/3", "0/1")
    assert (text.loc["brute-force", "wrong"], text.loc["brute-force", "translation missed"]) == (
        "0/4",
        "-",
    )
    assert own["95 %"] == "{:.1f}-{:.1f}".format(*(100 * b for b in metrics.wilson(2, 8)))


def asked_in(precision):
    """mujoco, which holds float32 vertices, and fcl-convex, on one hit of this precision."""
    run = Run()
    run.cases = run.cases[:1].assign(precision=precision)
    rows = [(m, "a", "ok", True, nan, "") for m in ("mujoco", "fcl-convex")]
    columns = ["method", "case", "status", "hit", "time", "detail"]
    run.observations = pd.DataFrame(rows, columns=columns).astype({"hit": "boolean"})
    return outcome.outcomes(run)


def test_single_precision_is_marked_where_cases_are_not_rounded_to_it():
    for make in (
        lambda found: accuracy.accuracy_table(found, "overlap"),
        lambda found: accuracy.common_table(found, "overlap"),
    ):
        plain, marked = make(asked_in("float32")), make(asked_in("float64"))
        assert set(plain.text.method) == {"mujoco", "fcl-convex"} and "\u2020" not in plain.caption
        assert set(marked.text.method) == {"mujoco \u2020", "fcl-convex"}
        assert "\u2020: the method computes or stores bodies in single" in marked.caption
        assert set(marked.numbers.method) == {"mujoco", "fcl-convex"}
        check_latex(
            latex(marked).replace(f"{{tab:{marked.name}}}", "{tab:name}"),
            marked.text.shape[1],
        )


def test_a_run_from_before_precisions_counts_as_float32():
    run = Run()
    assert "precision" not in run.cases
    assert not outcome.out_of_their_depth(outcome.outcomes(run))


def test_touching_cases_have_a_table_of_their_own():
    run = Run()
    assert labels.touching_table(outcome.outcomes(run), "overlap").text.empty
    run.cases = run.cases.assign(touching=run.cases.case == "d")
    found = outcome.outcomes(run)
    text = labels.touching_table(found, "overlap").text.set_index("method")
    assert text.loc["ofg k=8"].to_dict() == {
        "cases": "1",
        "answered": "1",
        "said hit": "1",
        "said clear": "0",
    }
    (row,) = metrics.rates(found[found.method == "ofg k=8"], ["method"]).to_dict("records")
    assert row["clears"] == 0 and row["false_alarms"] == 0


def test_the_truth_table_counts_what_touches_where_there_is_any():
    run = Run()
    run.cases = run.cases.assign(attempt=0)
    assert (
        "touching" not in labels.truth_table(run).text
        and "Touching" not in labels.truth_table(run).caption
    )
    run.cases = run.cases.assign(touching=run.cases.case == "d")
    table = labels.truth_table(run)
    assert table.text.touching.tolist() == ["1"] and "enter no rate" in table.caption
