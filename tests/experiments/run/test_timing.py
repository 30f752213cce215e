# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""What a method that dies while it is timed takes with it: its own times, and no other's."""

import pandas as pd
import psutil
import pytest

from experiments.analysis import costs
from experiments.analysis.tables import cost
from experiments.cases.families import get
from experiments.run.bins import Bin
from experiments.run.config import RunConfig
from experiments.run.folder.store import Store
from experiments.run.timing import COLUMNS, LOST, measure_bin

METHODS = """
import os
import numpy as np
from baselines.contract import Method, Verdict


class Frail(Method):
    name, engine, imports, configuration, guarantee = "frail", "numpy", "numpy", "default", "none"
    questions, bodies = frozenset({"overlap"}), frozenset({"convex", "union", "mesh"})
    solid, parameters = True, {"lives": 1000}
    asked = 0

    def prepare(self, query):
        return self.ask

    def ask(self):
        self.asked += 1
        if self.asked > self.parameters["lives"]:
            os.abort()
        return Verdict(False)


class Greedy(Frail):
    name, parameters = "greedy", {}

    def prepare(self, query):
        reserved = np.empty(3 << 30, np.uint8)
        return lambda: Verdict(bool(len(reserved) == 0))


METHODS = [Frail, Greedy]
"""


def timed(folder, *labels):
    """The run's folder, and the times of two cases by the methods of these labels."""
    (folder / "frail.py").write_text(METHODS)
    config = RunConfig(
        seed=1,
        methods=list(labels),
        scenarios=[{"name": "deep", "cases": 1}],
        timing={"cases": 2, "rounds": 3},
        method_files=[str(folder / "frail.py")],
    )
    cases = [get("deep").case(1, get("deep").levels[0], i) for i in range(2)]
    everything = {case.id for case in cases}
    bin_ = Bin("overlap", "to 24", "deep", cases, dict.fromkeys(labels, everything))
    store = Store(folder / "run")
    return store, pd.DataFrame(measure_bin(store, config, bin_, 120.0), columns=COLUMNS)


def test_a_method_that_dies_loses_its_own_times_alone(tmp_path):
    store, found = timed(tmp_path, "ofg k=8", "frail lives=3", "frail lives=1000")
    assert set(found.method) == {"ofg k=8", "frail lives=1000", "(noise probe)", LOST}
    assert all(len(rounds) == 3 for rounds in found[found.method != LOST].rounds_ns)
    store.write(found, "timings.parquet")
    (words,) = costs.lost(store)
    assert words.startswith(
        "frail lives=3: error, killed twice, alone: SIGABRT"
    ) and words in cost.state_of(store)
    assert set(costs.case_costs(store).method) == {"ofg k=8", "frail lives=1000"}


# MuJoCo reserves 28 MB for each prepared pair and touches little of it: `standard` lost 43 of its
# times to a limit that suits a worker, which keeps one pair.
@pytest.mark.skipif(
    psutil.virtual_memory().total < 10 << 30, reason="prepared cases reserve 9 GB here"
)
def test_memory_that_prepared_cases_reserve_together_loses_no_time(tmp_path):
    _, found = timed(tmp_path, "greedy")
    assert set(found.method) == {"greedy", "(noise probe)"}
