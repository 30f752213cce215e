# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The findings page: it is what the committed runs make, and what is missing is said."""

import re
from pathlib import Path

import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st

from experiments.analysis import metrics
from experiments.publish.findings import objections
from experiments.publish.findings import page as page_of
from experiments.publish.findings.claims import CLAIMS
from experiments.publish.findings.engines import QUESTIONS
from experiments.publish.findings.runs import (
    FAILS,
    HOLDS,
    OPEN,
    PART,
    UNMEASURED,
    Rate,
    Runs,
    are_small,
)
from experiments.run import piece_truth

from .fake_runs import said

RESULTS = Path(__file__).parents[3] / "results"
RATES = st.lists(
    st.tuples(st.integers(0, 60), st.integers(0, 60)).map(lambda t: (t[0], t[0] + t[1] + 1)),
    min_size=1,
    max_size=4,
)


@given(RATES, st.data())
def test_one_more_miss_makes_no_verdict_better(counts, data):
    def judged(counts):
        return are_small([Rate(c, n, *metrics.wilson(c, n)) for c, n in counts])

    i = data.draw(st.integers(0, len(counts) - 1))
    c, n = counts[i]
    worse = [*counts[:i], (min(c + 1, n), n), *counts[i + 1 :]]
    order = [HOLDS, OPEN, PART, FAILS]
    assert order.index(judged(worse)) >= order.index(judged(counts))


def test_few_cases_say_nothing():
    assert are_small([Rate(0, 3, *metrics.wilson(0, 3))]) == OPEN


def test_what_is_missing_is_said(tmp_path):
    text = page_of(tmp_path)
    assert text.count(f"| **{UNMEASURED}** |") == len(CLAIMS)
    for run in ("k", "faces", "rotation", "standard", "sizes", "native"):
        assert f"run {run} is missing" in text


def test_a_run_cut_short_is_said(tmp_path):
    (tmp_path / "rotation").mkdir()
    assert said("Linearised", Runs(tmp_path)) == UNMEASURED
    assert "run rotation is not finished" in page_of(tmp_path)


@pytest.fixture(scope="module")
def page():
    return page_of(RESULTS)


def test_the_committed_page_is_what_the_committed_runs_make(page):
    assert (RESULTS / "README.md").read_text() == page, (
        "build it anew: ofg-bench findings results --into results/README.md"
    )


def test_it_is_short_and_its_links_lead_somewhere(page):
    assert len(page.splitlines()) < 340  # a line for each method that an engine has
    for target in re.findall(r"\]\(([^)#]+)\)", page):
        assert (RESULTS / target).exists(), target
    for target in re.findall(r"\]\(#([^)]+)\)", page):
        assert f'id="{target}"' in page or f"## {target.replace('-', ' ')}\n" in page.lower(), (
            target
        )


def test_its_engine_tables_are_the_accuracy_tables(page):
    board = Runs(RESULTS).board
    for question in QUESTIONS:
        csv = RESULTS / board / "tables" / f"accuracy-{question}.csv"
        if not csv.exists():
            pytest.skip("no run has every family")
        for row in pd.read_csv(csv).itertuples():
            if row.answered and row.method != piece_truth.NAME:  # no engine
                cell = str(Rate(row.misses, row.hits, row.miss_low, row.miss_high))
                assert any(
                    line.startswith(f"| {row.method} |") and cell in line
                    for line in page.splitlines()
                ), (
                    row.method,
                    cell,
                )


def test_the_committed_objections_are_what_the_committed_runs_make():
    assert (RESULTS / "OBJECTIONS.md").read_text() == objections.page(Runs(RESULTS))


def test_each_of_the_ten_objections_is_measured():
    page = objections.page(Runs(RESULTS))
    assert (
        len(objections.OBJECTIONS) == 10
        and page.count("Command: `") == 10
        and "not measured" not in page
    )


def test_an_objection_without_its_run_says_so(tmp_path):
    assert "not measured" in objections.page(Runs(tmp_path))
