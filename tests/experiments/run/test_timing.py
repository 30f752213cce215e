# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""What a method that dies while it is timed takes with it: its own times, and no other's."""

import pandas as pd

from experiments.analysis import costs
from experiments.analysis.tables import cost
from experiments.cases.families import get
from experiments.run.config import RunConfig
from experiments.run.folder.store import Store
from experiments.run.timing import COLUMNS, LOST, Bin, measure_bin

METHODS = """
import os
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


METHODS = [Frail]
"""


def test_a_method_that_dies_loses_its_own_times_alone(tmp_path):
    (tmp_path / "frail.py").write_text(METHODS)
    config = RunConfig(
        seed=1,
        methods=["ofg k=8", "frail lives=3,1000"],
        scenarios=[{"name": "deep", "cases": 1}],
        timing={"cases": 2, "rounds": 3},
        method_files=[str(tmp_path / "frail.py")],
    )
    cases = [get("deep").case(1, get("deep").levels[0], i) for i in range(2)]
    everything = {case.id for case in cases}
    bin_ = Bin(
        "overlap",
        "to 24",
        "deep",
        cases,
        dict.fromkeys(("ofg k=8", "frail lives=3", "frail lives=1000"), everything),
    )
    store = Store(tmp_path / "run")
    found = pd.DataFrame(measure_bin(store, config, bin_, 120.0), columns=COLUMNS)
    assert set(found.method) == {"ofg k=8", "frail lives=1000", "(noise probe)", LOST}
    assert all(len(rounds) == 3 for rounds in found[found.method != LOST].rounds_ns)
    store.write(found, "timings.parquet")
    (words,) = costs.lost(store)
    assert words.startswith(
        "frail lives=3: error, killed twice, alone: SIGABRT"
    ) and words in cost.state_of(store)
    assert set(costs.case_costs(store).method) == {"ofg k=8", "frail lives=1000"}
