# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The main job on a few cases: the same to the bit whatever the workers, the seed's run again, or
an interruption.
"""

import hashlib
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pandas as pd
import pytest

from experiments.analysis import tables
from experiments.cli import runner
from experiments.run.config import ConfigError, RunConfig
from experiments.run.folder.store import Store

CONFIG = RunConfig(
    seed=7,
    methods=[
        "ofg k=4,8",
        "fcl-convex",
        "fcl-distance",
        "fcl-ccd-mesh",
        "mujoco-substeps n=1,4",
        "bullet",
    ],
    timing={"cases": 0},
    scenarios=[
        {"name": "feature_gap", "cases": 7, "levels": [1e-2, -1e-2, -1e-8]},
        {"name": "contained", "cases": 4, "levels": [0.1]},
        {"name": "thin_wall", "cases": 6, "levels": [10.0]},
        {"name": "spin_side", "cases": 3, "levels": [1.0]},
    ],
)


def digest(folder) -> dict[str, str]:
    """Content of everything that must not depend on the clock."""
    files = [
        "cases.parquet",
        "bodies.parquet",
        "observations.parquet",
        *(f"tables/{p.name}" for p in (folder / "tables").iterdir()),
    ]
    return {name: hashlib.sha256((folder / name).read_bytes()).hexdigest() for name in files}


@pytest.fixture(scope="module")
def reference(tmp_path_factory):
    folder = tmp_path_factory.mktemp("runs") / "reference"
    runner.run(CONFIG, folder, workers=2)
    return Store(folder)


def test_one_worker_gives_the_same_bits(reference, tmp_path):
    runner.run(CONFIG, tmp_path / "run", workers=1)
    assert digest(tmp_path / "run") == digest(reference.folder)


def test_a_killed_run_goes_on_and_ends_the_same(reference, tmp_path):
    folder = tmp_path / "run"
    code = (
        "from tests.experiments.cli.test_runner import CONFIG; from experiments.cli import runner\n"
        f"runner.run(CONFIG, {str(folder)!r}, workers=2)"
    )
    process = subprocess.Popen(
        [sys.executable, "-c", code],
        env={**os.environ, "PYTHONPATH": os.getcwd()},
        start_new_session=True,
    )
    deadline = time.monotonic() + 120
    while (
        process.poll() is None
        and time.monotonic() < deadline
        and len(list(folder.glob("parts/observations/*.parquet"))) < 2
    ):
        time.sleep(0.02)
    assert process.poll() is None, "the run ended before it could be killed; give it more to do"
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    assert not (folder / "observations.parquet").exists()
    runner.run(CONFIG, folder, workers=2)
    assert digest(folder) == digest(reference.folder)


def test_every_method_has_a_row_for_every_case(reference):
    observations, cases = reference.read("observations.parquet"), reference.read("cases.parquet")
    assert len(cases) == 21 + 4 + 6 + 3 and len(observations) == len(cases) * 8
    assert not observations.duplicated(["case", "method"]).any()
    assert set(observations.status) <= {"ok", "unsupported", "error", "timeout"}


def test_an_engine_that_aborts_costs_its_own_rows(tmp_path):
    """FCL's signed distance throws through C near touching (6 of 600 pairs of cubes at -1e-8); the
    run goes on and says so.
    """
    cubes = str(Path(__file__).with_name("cubes_face_to_face.py"))
    config = RunConfig(
        seed=7,
        methods=["fcl-distance", "fcl-convex"],
        timing={"cases": 0},
        scenario_files=[cubes],
        scenarios=[{"name": "cubes_face_to_face", "cases": 300}],
    )
    runner.run(config, tmp_path / "run")
    observations = Store(tmp_path / "run").read("observations.parquet")
    died = observations[observations.status != "ok"]
    assert 0 < len(died) < 30 and set(died.method) == {"fcl-distance"}
    assert set(died.status) == {"error"} and set(died.detail) == {"killed twice, alone: SIGABRT"}
    assert len(observations) == 600


def test_tables_and_bytes_are_the_same_when_built_again(reference):
    before = digest(reference.folder)
    tables.save(reference, list(tables.build(reference)))
    assert digest(reference.folder) == before


def test_parts_are_gone_and_the_manifest_says_what_ran(reference):
    assert not reference.has("parts")
    manifest = pd.read_json(reference.folder / "manifest.json", typ="series")
    assert manifest.versions["python-fcl"] and manifest.before["cores"] >= 1 and manifest.finished


def test_a_missing_engine_is_said_before_anything_runs(tmp_path, monkeypatch):
    monkeypatch.setattr(
        runner.registry,
        "available",
        lambda cls: (
            "pybullet is not installed; install it with: pip install pybullet"
            if cls.engine == "pybullet"
            else None
        ),
    )
    with pytest.raises(ConfigError, match="pip install pybullet.*--skip-missing"):
        runner.run(CONFIG, tmp_path / "run")
    assert not (tmp_path / "run").exists()


@pytest.mark.parametrize(
    "change, words",
    [
        ({"scenarios": [{"name": "thin_wal", "cases": 1}]}, "thin_wall"),
        ({"scenarios": [{"name": "thin_wall", "cases": 1, "levels": [3.0]}]}, "has no level 3"),
        ({"methods": ["fcl-convexx"]}, "fcl-convex"),
        ({"methods": ["ofg q=3"]}, "no parameter 'q'"),
    ],
)
def test_a_wrong_name_is_said_before_anything_runs(tmp_path, change, words):
    with pytest.raises(ValueError, match=words):
        runner.run(RunConfig.model_validate({**CONFIG.model_dump(), **change}), tmp_path / "run")
    assert not (tmp_path / "run").exists()
