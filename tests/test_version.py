# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The version is one, wherever it is said."""

import re
import subprocess
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).parents[1]
VERSION = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["version"]


def bench(*words, **environment):
    return subprocess.run(
        [sys.executable, "-m", "experiments.cli", *words],
        capture_output=True,
        text=True,
        env=environment or None,
        cwd=ROOT,
        check=True,
    ).stdout


def test_the_command_says_the_version():
    assert bench("--version") == f"ofg-bench {VERSION}\n"


def test_citation_and_changelog_name_it():
    assert f"\nversion: {VERSION}\n" in (ROOT / "CITATION.cff").read_text()
    assert re.search(rf"^## \[{re.escape(VERSION)}\]", (ROOT / "CHANGELOG.md").read_text(), re.M)


def test_completion_for_bash_is_offered():
    shown = bench("--show-completion", "bash")
    assert "complete -o default -F" in shown
