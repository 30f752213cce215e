# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Runs the blocks of experiments/WALK.md and writes their output below them: python -m
experiments.publish.walk
"""

from __future__ import annotations

import contextlib
import io
import os
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "experiments" / "WALK.md"
BLOCK = re.compile(r"```(python|sh)\n(.*?)```\n```text\n.*?```", re.DOTALL)


def fill(page: str) -> str:
    """The page with the output of each block in the `text` block below it.

    Python blocks share one session, as on the page. An error of a block is raised as it is;
    CalledProcessError for a shell block that fails.
    """
    session = {}

    def ran(match: re.Match) -> str:
        kind, code = match.groups()
        out = _python(code, session) if kind == "python" else _shell(code)
        return f"```{kind}\n{code}```\n```text\n{out}```"

    return BLOCK.sub(ran, page)


def _python(code: str, session: dict) -> str:
    out = io.StringIO()
    with contextlib.chdir(ROOT), contextlib.redirect_stdout(out):
        exec(code, session)
    return _trimmed(out.getvalue())


def _shell(code: str) -> str:
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ.get('PATH', '')}"
    done = subprocess.run(
        ["bash", "-c", code],
        cwd=ROOT,
        env={**os.environ, "PATH": path, "COLUMNS": "100"},
        check=True,
        capture_output=True,
        text=True,
    )
    return _trimmed(done.stdout)


def _trimmed(text: str) -> str:
    return "".join(f"{line.rstrip()}\n" for line in text.splitlines())


if __name__ == "__main__":
    PAGE.write_text(fill(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
