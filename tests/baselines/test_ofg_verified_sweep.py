# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""ofg-verified never contradicts a certified sweep and is never late: all families of translation
and motion of convex bodies and unions, and the labels of the published runs.
"""

import json
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import ofg
from baselines import registry
from experiments.cases.families import get, own_modules, scenarios
from experiments.truth import label, label_many
from ofg import Body, Motion, Pose, Query

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


def turning(rng):
    """A query as no family draws it: long and flat bodies, up to three turns, rolling, screws,
    bodies of other sizes, contact near the start, both moving, far from the origin.
    """
    ratio = 10.0 ** rng.uniform(-4, 0) if rng.random() < 0.3 else 1.0
    thin = np.where(rng.random((2, 3)) < 0.3, 0.02, 1.0)
    a, b = (Body.convex(rng.normal(size=(rng.integers(4, 40), 3)) * t) for t in thin)
    a = Body.convex(a.vertices * ratio)
    size = a.radius if rng.random() < 0.5 else b.radius
    away = rng.normal(size=3)
    away *= (a.radius + b.radius) * rng.uniform(0.3, 1.2) / np.linalg.norm(away)
    far = rng.choice([0.0, 1e3, 1e5])

    def motion(share):
        axis, angle = rng.normal(size=3), rng.choice([0, 0.1, 1.5, 6, 2 * np.pi, 20])
        way = -away * share + rng.normal(size=3) * size * rng.uniform(0, 1)
        kind = rng.integers(5)
        if kind == 0:
            way = np.cross(axis, rng.normal(size=3)) * angle / np.linalg.norm(axis) * size
        elif kind == 1:
            way = axis * size
        about = rng.normal(size=3) * size * rng.integers(2)
        return Motion(way, axis, float(angle), about)

    start = [Pose(rng.normal(size=4), x + far) for x in (away, 0 * away)]
    return Query("motion", a, b, *start, motion(1), motion(-0.3 * rng.integers(2)))


def test_the_prover_agrees_about_motions_that_no_family_draws():
    rng = np.random.default_rng(17)
    queries = [turning(rng) for _ in range(400)]
    truths = label_many(queries)
    assert {t.label for t in truths} >= {"hit", "clear"}
    assert sum(t.label == "uncertain" for t in truths) < 40
    for query, truth in zip(queries, truths):
        assert not fault(query, truth)
        assert not fault(query.swapped(), truth)
