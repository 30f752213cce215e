# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Every experiment of the catalogue can be run, and the committed runs are what the code makes of
their rows.
"""

import json
from pathlib import Path

import pytest

from baselines import registry
from experiments.analysis import tables
from experiments.cli import runner
from experiments.run import config, labelling
from experiments.run.folder.store import Store

ROOT = Path(__file__).parents[3]
COMMITTED = sorted(p.parent for p in (ROOT / "results").glob("*/manifest.json"))
RAW = (
    "cases.parquet",
    "bodies.parquet",
    "observations.parquet",
    "timings.parquet",
    "stepping.parquet",
)


@pytest.mark.parametrize("name", [*config.experiments(), *config.presets()])
def test_it_names_only_what_there_is(name):
    chosen = config.load(name)
    assert chosen.about
    for spec in chosen.asked:
        assert registry.make(spec)
    tables.check(chosen)
    assert chosen.stepping or labelling.slots(chosen)
    assert len({t.name for t in chosen.tables}) == len(chosen.tables)


@pytest.mark.parametrize("name", config.experiments())
def test_an_experiment_says_what_it_is_and_has_tables_of_its_own(name):
    chosen = config.load(name)
    assert chosen.title and (chosen.tables or chosen.stepping)
    assert all(t.name.startswith(name) for t in chosen.tables), (
        "the name of a table says where it is from"
    )


@pytest.mark.parametrize("name", config.experiments())
def test_an_absent_optional_engine_fails_no_experiment(name, monkeypatch):
    chosen = config.load(name)
    optional = {m.engine for spec in chosen.optional_methods for m in registry.make(spec)}
    core = {m.engine for spec in chosen.methods for m in registry.make(spec)}
    monkeypatch.setattr(
        runner.registry,
        "available",
        lambda cls: f"{cls.engine} is not installed" if cls.engine in optional else None,
    )
    assert (
        not optional & core
        and not runner.missing(chosen.methods)
        and len(runner.missing(chosen.optional_methods)) == len(optional)
    )


@pytest.mark.parametrize(
    "change, words",
    [
        ({"scenarios": ["deep"]}, "the scenario 'deep' is not in the run"),
        ({"question": "turning"}, "there is no question 'turning'"),
        ({"columns": "colour"}, "or a tag of its scenarios .aim, aligned, feature."),
        ({"value": "net time"}, "needs times"),
    ],
)
def test_a_table_that_cannot_be_made_is_said_before_anything_runs(change, words, tmp_path):
    chosen = config.RunConfig(
        seed=1,
        methods=["ofg"],
        scenarios=[{"name": "feature_gap", "cases": 1}],
        timing={"cases": 0},
        tables=[{"name": "t", "title": "T", "value": "misses", **change}],
    )
    with pytest.raises(config.ConfigError, match=words):
        runner.run(chosen, tmp_path / "run")
    assert not (tmp_path / "run").exists()


def test_rows_outlive_a_change_of_words(tmp_path):
    first = config.load("gap")
    Store(tmp_path).begin(first)
    Store(tmp_path).begin(first.model_copy(update={"title": "Another", "tables": ()}))
    assert Store(tmp_path).config.title == "Another"
    with pytest.raises(RuntimeError, match="differs in: seed"):
        Store(tmp_path).begin(first.model_copy(update={"seed": 1}))


@pytest.mark.skipif(not COMMITTED, reason="no run is committed")
@pytest.mark.parametrize("folder", COMMITTED, ids=lambda p: p.name)
def test_committed_tables_are_those_of_the_committed_rows(folder):
    store = Store(folder)
    for table in tables.build(store):
        for suffix, text in tables.texts(table).items():
            assert (folder / "tables" / f"{table.name}.{suffix}").read_bytes() == text.encode(), (
                f"{table.name}.{suffix}: build it anew with ofg-bench tables"
            )


@pytest.mark.skipif(not COMMITTED, reason="no run is committed")
def test_committed_runs_are_small_and_name_no_place_of_a_machine():
    assert (
        sum((f / name).stat().st_size for f in COMMITTED for name in RAW if (f / name).exists())
        < 20 * 2**20
    )
    for folder in COMMITTED:
        text = (
            json.dumps(json.loads((folder / "manifest.json").read_text()))
            + (folder / "config.json").read_text()
        )
        assert not any(place in text for place in ("/root", "/home", "/tmp", "/work", "/Users"))
