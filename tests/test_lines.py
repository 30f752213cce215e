# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""No file of ours is longer than 400 lines of 100 columns."""

import subprocess
from pathlib import Path

ROOT = Path(__file__).parents[1]
LONGEST, WIDEST = 400, 100
WRITTEN = {".py", ".hpp", ".cpp", ".rs", ".js", ".css", ".html", ".toml", ".cmake", ".yaml"}
NAMES = {"Makefile", "CMakeLists.txt", "run"}


def sources() -> list[Path]:
    """The files of the repository that somebody wrote: not those of vendors, nor results."""
    command = ["git", "ls-files", "--cached", "--others", "--exclude-standard"]
    listed = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout
    paths = [ROOT / name for name in listed.splitlines()]
    kept = [p for p in paths if p.suffix in WRITTEN or p.name in NAMES]
    return [p for p in kept if p.is_file() and not {"vendor", "results"} & set(p.parts)]


def test_no_file_is_too_long():
    lengths = {p.relative_to(ROOT): p.read_text().count("\n") for p in sources()}
    assert {str(p): n for p, n in lengths.items() if n > LONGEST} == {}


def test_no_line_is_too_wide():
    # The formatters see to code; they leave long strings and comments alone.
    wide = []
    for path in sources():
        for number, line in enumerate(path.read_text().splitlines(), 1):
            if len(line.partition("  # noqa")[0]) > WIDEST:  # as ruff counts
                wide.append(f"{path.relative_to(ROOT)}:{number}")
    assert wide == [], f"{len(wide)} lines of more than {WIDEST} columns: {wide[:20]}"
