# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Faults of the machine and of the reader: one paragraph, and the same command goes on
afterwards, to the byte."""

import hashlib
import os
import resource
import subprocess
import sys
from pathlib import Path

import pandas as pd
import pytest

from experiments.cli import runner
from experiments.run.config import RunConfig
from experiments.run.folder.record import RecordError
from experiments.run.folder.store import Store, StoreError
from experiments.run.processes.machine import MachineError

CONFIG = RunConfig(
    seed=3,
    methods=["fcl-convex", "ofg k=8"],
    timing={"cases": 0},
    scenarios=[
        {"name": "feature_gap", "cases": 10, "levels": [1e-2, -1e-2]},
        {"name": "thin_wall", "cases": 4, "levels": [10.0]},
    ],
)
FILES = ("cases.parquet", "bodies.parquet", "observations.parquet")
MINE = """
from baselines.contract import Method, Verdict
class Mine(Method):
    name, engine, imports, configuration = "mine", "numpy", "numpy", "default"
    questions, bodies, solid = frozenset({"overlap"}), frozenset({"convex"}), True
    guarantee = "none"
    def prepare(self, query):
        return lambda: Verdict(True)
METHODS = [Mine]
"""


def digests(folder):
    return {name: hashlib.sha256((folder / name).read_bytes()).hexdigest() for name in FILES}


@pytest.fixture(scope="module")
def reference(tmp_path_factory):
    folder = tmp_path_factory.mktemp("runs") / "reference"
    runner.run(CONFIG, folder, workers=2)
    return digests(folder)


@pytest.fixture
def stopped(tmp_path, monkeypatch):
    """A run that stopped after its answers were made and before it was said to be finished."""

    def stop(*_):
        raise KeyboardInterrupt

    with monkeypatch.context() as m, pytest.raises(KeyboardInterrupt):
        m.setattr(runner.timing, "measure", stop)
        runner.run(CONFIG, tmp_path / "run", workers=2)
    return tmp_path / "run"


def bench(*words, cwd):
    return subprocess.run(
        [sys.executable, "-m", "experiments.cli", *map(str, words)],
        cwd=cwd,
        capture_output=True,
        text=True,
        env={**os.environ, "PYTHONPATH": str(Path(__file__).parents[3])},
    )


def test_damage_of_all_kinds_ends_in_the_same_bytes(stopped, reference, capfd):
    """Shards and tables cut short, emptied and zeroed, and what killed writers leave."""
    for i, path in enumerate(sorted(stopped.glob("parts/*/*.parquet"))):
        path.write_bytes([b"", path.read_bytes()[:100], path.read_bytes()][i % 3])
    for name in FILES:
        (stopped / name).write_bytes(b"")
    (stopped / "manifest.json").write_text("")
    (stopped / ".cases.parquet.0123abcd.unfinished").write_bytes(b"half")
    (stopped / ".lock").write_text("1 elsewhere\n")
    runner.run(CONFIG, stopped, workers=2)
    assert digests(stopped) == reference
    assert "is made again" in " ".join(capfd.readouterr().err.split())
    assert not list(stopped.rglob(".*"))


@pytest.mark.parametrize(
    "left",
    [
        [],
        [".config.json.0123abcd.unfinished"],
        [".lock"],
        ["own/method-0-mine.py"],
    ],
)
def test_a_kill_before_the_configuration_is_written_refuses_nothing(tmp_path, left):
    """A temporary file alone in the folder was refused: it "is not empty and holds no run"."""
    for name in left:
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text("")
    with Store(tmp_path).held(CONFIG):
        assert Store(tmp_path).config == CONFIG


def test_an_update_makes_everything_again(stopped, reference, monkeypatch, capfd):
    """What another state of the code had made was taken for its own."""

    def names(folder):
        return [p.name for p in folder.glob("parts/*/*.parquet")]

    before = set(names(stopped))
    asked = []
    monkeypatch.setattr(runner.origin, "code", lambda: "another")
    monkeypatch.setattr(runner, "report", lambda store: asked.extend(names(store.folder)))
    runner.run(CONFIG, stopped, workers=2)
    assert len(set(asked) - before) == len(before) and digests(stopped) == reference
    assert "with a different version of the code" in " ".join(capfd.readouterr().err.split())


def test_a_changed_file_of_the_readers_own_is_refused(tmp_path):
    """The old answers came back without a word."""
    mine = tmp_path / "mine.py"
    mine.write_text(MINE)
    config = CONFIG.model_copy(update={"methods": ("mine",), "method_files": (str(mine),)})
    runner.run(config, tmp_path / "run", workers=2)
    assert (tmp_path / "run/own/method-0-mine.py").read_text() == MINE
    mine.write_text(MINE.replace("True)", "False)"))
    words = "mine.py has changed since the run .* began.*own/method-0-mine.py.*--out"
    with pytest.raises(StoreError, match=words):
        runner.run(config, tmp_path / "run", workers=2)
    mine.write_text(MINE)
    runner.run(config, tmp_path / "run", workers=2)


def test_a_finished_run_says_that_nothing_was_run(tmp_path, capfd):
    runner.run(CONFIG, tmp_path / "run", workers=2)
    capfd.readouterr()
    assert runner.run(CONFIG, tmp_path / "run", workers=2)
    assert "already finished; only its tables" in " ".join(capfd.readouterr().err.split())


@pytest.mark.parametrize("size", [2_000, 20_000])
def test_a_full_disk_stops_the_run_which_goes_on_to_the_same_bytes(tmp_path, reference, size):
    """A limit on the size of files stands for a full disk: none can be mounted here. It holds for
    the files in memory that a task is sent through too, so that either may be what is named."""
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, hard))
    try:
        with pytest.raises(
            MachineError, match="could (not )?be (written|started).*ofg-bench resume"
        ):
            runner.run(CONFIG, tmp_path / "run", workers=2)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    assert not list((tmp_path / "run").rglob("*.unfinished"))
    runner.run(CONFIG, tmp_path / "run", workers=2)
    assert digests(tmp_path / "run") == reference


@pytest.mark.parametrize(
    "out, words",
    [
        ("file", "is a file, not a folder"),
        ("file/below", "cannot be used"),
        ("/proc/nowhere/run", "cannot be used"),
        ("x" * 300, "File name too long"),
    ],
)
def test_a_folder_that_cannot_be_is_said_in_a_paragraph(tmp_path, out, words):
    """Each was a traceback of mkdir."""
    (tmp_path / "file").write_text("")
    few = 'seed = 1\nmethods = ["ofg"]\nscenarios = [{name = "deep", cases = 1}]\n'
    (tmp_path / "mine.toml").write_text(few)
    done = bench("run", "mine.toml", "--out", out, cwd=tmp_path)
    said = " ".join(done.stderr.split())
    assert done.returncode == 2 and "Traceback" not in said and words in said and "--out" in said


def test_a_damaged_table_of_a_finished_run_is_named(tmp_path):
    """The Parquet reader's words, which name no file, came with a traceback."""
    store = Store(tmp_path)
    store.write(pd.DataFrame({"x": range(99)}), "cases.parquet")
    whole = (tmp_path / "cases.parquet").read_bytes()
    for content in (b"", whole[:60], whole[:-3]):
        (tmp_path / "cases.parquet").write_bytes(content)
        with pytest.raises(RecordError, match="cases.parquet was changed or is damaged"):
            store.read("cases.parquet")
