# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""ofg-verified never contradicts a certified label: all families of overlap, and the labels of the
published runs.
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
FAMILIES = sorted(name for name in own_modules() if scenarios()[name].question == "overlap")
A_LEVEL = 4


def wrong(query, truth, **options):
    """What is said against the label; nothing where only touching or nobody knows."""
    if truth.label == "uncertain" or truth.touching:
        return None
    answer = ofg.verified(query.a, query.b, query.pose_a, query.pose_b, **options)
    return answer if answer.hit != (truth.label == "hit") else None


@pytest.mark.parametrize("family", FAMILIES)
def test_every_certified_label_is_answered(family):
    scenario = get(family)
    queries = [
        scenario.case(515, level, index).query
        for level in scenario.levels
        for index in range(A_LEVEL)
    ]
    truths = label_many(queries)
    for query, truth in zip(queries, truths):
        assert not wrong(query, truth)
        assert not wrong(query.swapped(), truth)
    for cls in (registry.methods()["ofg-verified"], registry.methods()["ofg-mpr"]):
        for query, truth in list(zip(queries, truths))[::5]:
            if not {query.a.kind, query.b.kind} <= cls.bodies:
                continue
            said = cls().ready(query)()
            assert (
                truth.label == "uncertain" or truth.touching or said.hit == (truth.label == "hit")
            )


def certified(run):
    """The overlap cases of a published run, drawn anew, and their labels."""
    folder = ROOT / "results" / run
    seed = json.loads((folder / "config.json").read_text())["seed"]
    rows = pd.read_parquet(folder / "cases.parquet")
    for row in rows[rows["case"].str.split("/").str[0].isin(FAMILIES)].itertuples():
        name, level, index = row.case.split("/")
        yield row, get(name), seed, float(level), int(index)


def test_the_labels_of_the_run_quick_are_answered():
    asked = 0
    for row, scenario, seed, level, index in certified("quick"):
        query = scenario.case(seed, level, index, row.attempt).query
        asked += 1
        assert not wrong(query, row), row.case
    assert asked > 500


def test_the_labels_of_the_reference_of_ci_are_answered():
    asked = 0
    for row, scenario, seed, level, index in certified("ci-reference"):
        attempt, truth = 0, None
        while truth is None or scenario.useless(truth):
            query = scenario.case(seed, level, index, attempt).query
            truth, attempt = label(query), attempt + 1
        asked += 1
        assert truth.label == row.label and not wrong(query, truth), row.case
    assert asked > 50
