# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""One small run with every kind of question, body and outcome, for all tests of the report. Some of
its clear cases are said to touch, though they do not: no scenario aims at that.
"""

import pytest

from experiments.cli import runner
from experiments.run.config import RunConfig
from experiments.run.folder.store import Store

CONFIG = RunConfig(
    title="Report",
    about="A run for the tests of the report.",
    seed=11,
    timing={"cases": 2, "rounds": 3, "warmup": 1},
    methods=[
        "ofg k=4,8",
        "ofg k=8 repairs=all",
        "brute-force",
        "fcl-convex",
        "bullet",
        "bullet-coacd",
        "fcl-convex-substeps n=1,4",
        "fcl-ccd-mesh",
        "fcl-naive-mesh",
    ],
    tables=[
        {"name": "by-level", "title": "Wrong by level.", "value": "wrong"},
        {"name": "by-form", "title": "Misses by form.", "value": "misses", "columns": "form"},
        {
            "name": "by-band",
            "title": "False alarms by band.",
            "value": "false alarms",
            "columns": "band",
            "question": "overlap",
        },
        {
            "name": "walls",
            "title": "Tunnelled.",
            "value": "tunnelled",
            "columns": "scenario",
            "scenarios": ["thin_wall", "spin_side"],
        },
        {"name": "by-faces", "title": "Net time.", "value": "net time", "columns": "faces"},
        {"name": "answers", "title": "Answered.", "value": "answered", "columns": "question"},
        {"name": "errors", "title": "Time error.", "value": "time error", "columns": "situation"},
    ],
    scenarios=[
        {"name": "feature_gap", "cases": 3, "levels": [1e-2, -1e-2]},
        {"name": "contained", "cases": 3, "levels": [0.1]},
        {"name": "deep", "cases": 3, "levels": [0.1]},
        {"name": "hooked_ls", "cases": 2},
        {"name": "linked_tori", "cases": 8, "levels": [1e-5]},
        {"name": "thin_wall", "cases": 4, "levels": [10.0]},
        {"name": "spin_side", "cases": 4, "levels": [1.0]},
    ],
)


@pytest.fixture(scope="session")
def run(tmp_path_factory) -> Store:
    folder = tmp_path_factory.mktemp("report") / "run"
    runner.run(CONFIG, folder, workers=2)
    store = Store(folder)
    cases = store.read("cases.parquet")
    store.write(
        cases.assign(touching=(cases.label == "clear") & (cases["index"] == 0)), "cases.parquet"
    )
    return store
