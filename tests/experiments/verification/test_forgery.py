# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""A forger who recomputes every hash: each forgery is found, or stands in SILENT."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from experiments import verification
from experiments.cli import runner
from experiments.run.config import RunConfig
from experiments.run.folder import manifest
from experiments.run.folder.store import Store
from experiments.run.timing import LOST
from experiments.verification import verify

CONFIG = RunConfig(
    seed=3,
    methods=["ofg k=4"],
    timing={"cases": 1, "rounds": 3},
    scenarios=[
        {"name": "feature_gap", "cases": 3, "levels": [0.01, -0.01]},
        {"name": "thin_wall", "cases": 3, "levels": [10.0]},
        {"name": "hooked_ls", "cases": 1},
    ],
)

#: What verify cannot find by design (truth/README.md lists it in words), by table and column.
SILENT = {"timings": ("build_ns", "rounds_ns"), "observations": ("detail",)}
#: What only --ask finds.
ASKED = ("hit", "time", "status")


@pytest.fixture(scope="session")
def run(tmp_path_factory):
    folder = tmp_path_factory.mktemp("forgery") / "run"
    runner.run(CONFIG, folder, 1)
    return folder


def forged(run, folder, change=None, table="cases", config=None, rehash=True):
    """A copy of the run with one table changed, or its configuration, and every hash recomputed."""
    shutil.copytree(run, folder, ignore=shutil.ignore_patterns("figures", "report.html"))
    store = Store(folder)
    if change:
        frame = store.read(f"{table}.parquet")
        made = change(frame)
        store.write(frame if made is None else made, f"{table}.parquet")
    if config:
        store.write_text(config(store.config).model_dump_json(), "config.json")
    if rehash:
        runner.note(store, sha256=manifest.hashes(store.folder))
    return store


def put(column, value, label=None):
    """Set a cell of the first row, or of the first that has the label."""

    def change(frame):
        i = frame.index[frame.label == label][0] if label else 0
        frame[column] = frame[column].astype(object)
        frame.at[i, column] = value(frame.at[i, column]) if callable(value) else value
        if isinstance(frame.at[i, column], (int, float, bool, str)):
            frame[column] = frame[column].infer_objects()

    return change


def uncertain(frame):
    for column, value in (
        ("label", "uncertain"),
        ("start", "uncertain"),
        ("end", "uncertain"),
        ("t_lo", np.nan),
        ("t_hi", np.nan),
        ("gap", np.nan),
        ("reason", "?"),
        ("touching", False),
        ("certificate", "{}"),
    ):
        frame.loc[0, column] = value


def widened(frame):
    i = frame.index[(frame.label == "hit") & (frame.t_lo > 0)][0]
    certificate = json.loads(frame.certificate[i])
    certificate.pop("exact", None)
    frame.loc[i, ["t_lo", "certificate"]] = [0.0, json.dumps(certificate)]


def swapped(frame):
    kept = frame.loc[0, ["case", "index"]]
    frame.loc[0] = frame.loc[1]
    frame.loc[0, ["case", "index"]] = kept


def borrowed(frame):
    hit, clear = (
        frame.index[(frame.label == x) & (frame.question == "overlap")][0] for x in ("hit", "clear")
    )
    claims = ["label", "start", "end", "gap", "certificate", "touching"]
    frame.loc[hit, claims] = frame.loc[clear, claims]


FORGERIES = {
    "uncertain": uncertain,
    "deleted": lambda t: t.iloc[1:],
    "bracket": widened,
    "swapped": swapped,
    "doubled": lambda t: t.iloc[[0, *range(len(t))]],
    "other certificate": borrowed,
    "order": lambda t: t.iloc[::-1],
    "NaN gap": put("gap", np.nan),
    "gap of a hit": put("gap", lambda g: 2 * g, "hit"),
    "gap of a clear": put("gap", lambda g: g / 2, "clear"),
    "size": put("size", 9.0),
    "faces": put("faces", 7),
    "level": put("level", 0.5),
    "tags": put("tags", '{"feature": "none"}'),
    "index": put("index", 77),
    "attempt": put("attempt", 1),
    "touching": put("touching", lambda x: not x),
    "precision": put("precision", "float16"),
    "pose": put("position_b", lambda p: 2 * p),
    "end": put("end", "uncertain", "hit"),
    "garbage": put("certificate", "[" * 9999),
    "huge": put("certificate", lambda c: c.replace("0", "9" * 400)),
}


@pytest.mark.parametrize("name", FORGERIES)
def test_a_forged_case_is_found(run, tmp_path, name):
    assert not verify(forged(run, tmp_path / "f", FORGERIES[name]), workers=1).ok


def moved(frame):
    frame.at[0, "vertices"] = 1.5 * np.array(frame.vertices[0])


def opened(frame):
    frame.at[0, "faces"] = np.array(frame.faces[0])[3:]


@pytest.mark.parametrize(
    "change",
    [
        moved,
        opened,
        lambda t: t.iloc[1:],
        lambda t: t.iloc[[0, *range(len(t))]],
        put("name", "other"),
        put("kind", "mesh"),
        put("body", "0" * 64),
    ],
)
def test_a_forged_body_is_found(run, tmp_path, change):
    assert not verify(forged(run, tmp_path / "f", change, "bodies"), workers=1).ok


@pytest.mark.parametrize(
    "change",
    [
        lambda t: t.iloc[1:],
        lambda t: t.iloc[[0, *range(len(t))]],
        put("method", "ofg k=64"),
        put("status", "fine"),
        put("time", 7.0),
    ],
)
def test_forged_rows_of_answers_are_found(run, tmp_path, change):
    assert not verify(forged(run, tmp_path / "f", change, "observations"), workers=1).ok


def test_an_altered_answer_is_found_by_asking_again(run, tmp_path):
    store = forged(run, tmp_path / "f", put("hit", lambda hit: not hit), "observations")
    assert verify(store, workers=1).ok, "no other check sees it"
    found = verify(store, ask=-1, workers=1)
    assert len(found.refused) == 1 and "but repeated" in found.refused[0]


def test_an_untouched_run_is_accepted_and_its_answers_too(run, tmp_path):
    found = verify(forged(run, tmp_path / "f"), ask=-1, workers=1)
    assert found.ok, str(found)
    assert found.asked == found.labels.total()


def test_another_seed_is_found(run, tmp_path):
    store = forged(run, tmp_path / "f", config=lambda c: c.model_copy(update={"seed": 4}))
    assert not verify(store, workers=1).ok


def test_a_changed_file_is_named_and_a_run_without_hashes_says_so(run, tmp_path):
    changed = forged(
        run, tmp_path / "f", put("rounds_ns", lambda r: 2 * r), "timings", rehash=False
    )
    found = verify(changed, workers=1)
    assert len(found.refused) == 1 and found.refused[0].startswith(
        "timings.parquet: the file chang"
    )
    changed.path("timings.parquet").unlink()
    assert any("missing" in r for r in verify(changed, workers=1).refused)
    changed.path("manifest.json").write_text("{}")
    assert "This run records no hashes." in verify(changed, workers=1).notes


def test_times_are_found_by_no_check(run, tmp_path):
    store = forged(run, tmp_path / "f", put("rounds_ns", lambda r: 2 * r), "timings")
    assert verify(store, workers=1).ok and "rounds_ns" in SILENT["timings"]


def test_what_is_not_detectable_is_documented():
    text = (Path(verification.__file__).parents[1] / "truth" / "README.md").read_text()
    section = text.split("## What `ofg-bench verify` finds")[1].split("\n## ")[0]
    lines = {line.split("`")[1]: line for line in section.splitlines() if line.startswith("- `")}
    for table, columns in SILENT.items():
        assert all(f"`{column}`" in lines[table] for column in columns)
    assert all(f"`{column}`" in lines["observations"] for column in ASKED)


def test_a_smaller_configuration_is_said_to_be_none_of_the_package(run):
    assert any("not one of this package's" in note for note in verify(Store(run), workers=1).notes)


def test_a_finished_run_takes_other_words_and_nothing_else(run, tmp_path):
    """Its tables were built again with other titles, and its own verification then refused it."""
    folder = tmp_path / "reworded"
    shutil.copytree(run, folder)
    runner.run(CONFIG.model_copy(update={"title": "Reworded."}), folder, 1)
    assert Store(folder).config.title == "Reworded." and verify(Store(folder), workers=1).ok
    path = folder / "config.json"
    path.write_text(path.read_text().replace("Reworded.", "By hand."))
    runner.run(CONFIG.model_copy(update={"title": "Again."}), folder, 1)
    assert any("config.json" in found for found in verify(Store(folder), workers=1).refused)


@pytest.mark.parametrize(
    "case, ok",
    [("ofg k=4: killed", True), ("all methods: killed", True), ("nobody: killed", False)],
)
def test_a_method_that_lost_its_times_is_no_forgery(run, tmp_path, case, ok):
    """The committed run standard has 43 such rows, and all were refused."""

    def lost(frame):
        row = {**frame.iloc[0].to_dict(), "case": case, "method": LOST, "rounds_ns": []}
        return pd.concat([frame, pd.DataFrame([{**row, "build_ns": 0}])], ignore_index=True)

    store = forged(run, tmp_path / "f", lost, "timings")
    assert verify(store, workers=1).ok == ok
