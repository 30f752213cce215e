# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The README tells the truth: its code runs, its tables are those of the committed run, its files
exist.
"""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from experiments.publish.readme import MARK, fill

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text()
BLOCKS = dict(re.findall(r"```python (\w+)\n(.*?)```", README, re.DOTALL))
BENCH = [sys.executable, "-m", "experiments.cli"]


def bench(*words, cwd=ROOT):
    return subprocess.run(
        [*BENCH, *map(str, words)],
        cwd=cwd,
        capture_output=True,
        text=True,
        env={**os.environ, "COLUMNS": "160"},
    )


def test_the_ten_lines_of_api_run(tmp_path):
    done = subprocess.run(
        [sys.executable, "-c", BLOCKS["api"]], cwd=tmp_path, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    promised = re.findall(r"# prints (.*)", BLOCKS["api"])
    assert promised and done.stdout.splitlines() == promised


def test_a_scenario_and_a_method_of_ones_own(tmp_path):
    (tmp_path / "falling_die.py").write_text(BLOCKS["scenario"])
    (tmp_path / "spheres.py").write_text(BLOCKS["method"])
    (tmp_path / "mine.toml").write_text(
        'seed = 1\nmethods = ["spheres", "fcl-convex-substeps n=4"]\ntiming = {cases = 0}\n'
        'scenarios = [{name = "falling_die", cases = 3}, {name = "deep", cases = 2}]\n'
    )
    done = bench(
        "run",
        "mine.toml",
        "--out",
        "run",
        "--scenarios",
        "falling_die.py",
        "--methods",
        "spheres.py",
        cwd=tmp_path,
    )
    assert done.returncode == 0, done.stderr
    assert "falling_die" in done.stdout and "spheres" in done.stdout
    again = bench("tables", "run", cwd=tmp_path)
    assert again.returncode == 0 and "falling_die" in again.stdout


def test_a_method_of_ones_own_is_put_through_the_conformance_suite(tmp_path):
    (tmp_path / "spheres.py").write_text(BLOCKS["method"])
    done = bench("check", "spheres", "--methods", tmp_path / "spheres.py")
    assert "far apart" in done.stdout and done.returncode in (0, 1), done.stderr


def test_the_tables_are_those_of_the_committed_run():
    assert len(MARK.findall(README)) >= 4
    assert fill(README, ROOT / "results" / "quick" / "tables") == README


@pytest.mark.parametrize(
    "target",
    sorted(
        set(re.findall(r"\]\((?!http)([^)#]+)\)", README))
        | set(re.findall(r"`((?:experiments|baselines|ofg)/[\w/.]+)`", README))
    ),
)
def test_what_it_names_exists(target):
    assert (ROOT / target).exists()


@pytest.mark.parametrize(
    "words, expected",
    [
        (["run", "qick"], "did you mean quick"),
        (["tables", "nowhere"], "not a run folder"),
        (["check", "fcl-convx"], "fcl-convex"),
        (["list", "--methods", "nowhere.py"], "does not exist"),
    ],
)
def test_errors_of_the_user_are_one_paragraph(words, expected):
    done = bench(*words)
    assert (
        done.returncode == 2
        and expected in " ".join(done.stderr.split())
        and "Traceback" not in done.stderr
    )


def test_every_command_has_help_that_says_something():
    for command in re.findall(r"│ (\w+) +[A-Z]", bench("--help").stdout):
        help_ = bench(command, "--help")
        assert help_.returncode == 0 and len(help_.stdout) > 200
