# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""ofg-verified never contradicts a certified sweep and is never late: all families of translation
and motion of convex bodies and unions, and the labels of the published runs.
"""

import json
from pathlib import Path

import pandas as pd
import pytest

import ofg
from baselines import registry
from experiments.cases.families import get, own_modules, scenarios
from experiments.truth import label, label_many

ROOT = Path(__file__).parents[2]
SOLID = {"convex", "union"}
FAMILIES = sorted(name for name in own_modules() if scenarios()[name].question != "overlap")
A_LEVEL = 3
BRACKET = 1e-9


def fits(query):
    return {query.a.kind, query.b.kind} <= SOLID


def fault(query, truth):
    """What is said against the label; "" where only touching or nobody knows."""
    if truth.label == "uncertain" or truth.touching:
        return ""
    x = ofg.verified_sweep(
        query.a, query.b, query.pose_a, query.pose_b, query.motion, query.motion_b
    )
    if x.hit != (truth.label == "hit"):
        return f"{truth.label}, but {x}"
    if not x.hit:
        return "" if x.proved else "a clear that is not proved"
    if x.time > truth.t_hi:
        return f"late: {x}, not {truth.t_hi}"
    if x.proved and not (x.latest >= truth.t_lo and x.latest - x.time <= BRACKET):
        return f"a bracket that does not hold [{truth.t_lo}, {truth.t_hi}]: {x}"
    return ""


@pytest.mark.parametrize("family", FAMILIES)
def test_every_certified_label_is_answered(family):
    scenario = get(family)
    queries = [
        scenario.case(616, level, index).query
        for level in scenario.levels
        for index in range(A_LEVEL)
    ]
    queries = [q for q in queries if fits(q)]
    truths = label_many(queries)
    method = registry.methods()["ofg-verified"]()
    for query, truth in zip(queries, truths):
        assert not fault(query, truth)
        assert not fault(query.swapped(), truth)
        if truth.label == "uncertain" or truth.touching:
            continue
        said = method.ready(query)()
        assert said.hit == (truth.label == "hit")
        assert not said.hit or said.time <= truth.t_hi


def certified(run):
    """The sweeps of a published run, drawn anew, and their labels."""
    folder = ROOT / "results" / run
    seed = json.loads((folder / "config.json").read_text())["seed"]
    rows = pd.read_parquet(folder / "cases.parquet")
    for row in rows[rows["case"].str.split("/").str[0].isin(FAMILIES)].itertuples():
        name, level, index = row.case.split("/")
        scenario = get(name)
        nearest = min(scenario.levels, key=lambda x: abs(x - float(level)))  # names are rounded
        yield row, scenario, seed, nearest, int(index)


@pytest.mark.parametrize("run, least", [("quick", 500), ("standard", 2000)])
def test_the_labels_of_published_runs_are_answered(run, least):
    asked = 0
    for row, scenario, seed, level, index in certified(run):
        query = scenario.case(seed, level, index, row.attempt).query
        if fits(query):
            asked += 1
            assert not fault(query, row), row.case
    assert asked > least


def test_the_labels_of_the_reference_of_ci_are_answered():
    asked = 0
    for row, scenario, seed, level, index in certified("ci-reference"):
        attempt, truth = 0, None
        while truth is None or scenario.useless(truth):
            query = scenario.case(seed, level, index, attempt).query
            truth, attempt = label(query), attempt + 1
        if fits(query):
            asked += 1
            assert truth.label == row.label and not fault(query, truth), row.case
    assert asked > 20
