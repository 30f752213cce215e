# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Compiling the native lane: what was built, and what was not, with the remedy."""

from __future__ import annotations

import os
import shutil
import subprocess
import sysconfig
from pathlib import Path

SOURCE = Path(__file__).parent
FOLDER = SOURCE.parents[1] / "build" / "native"
#: set this variable to "required", and an engine that is missing is an error
REQUIRED = "OFG_NATIVE"


class NativeError(RuntimeError):
    """The lane cannot be built or run; the message says why and what to do."""


def build(folder: Path = FOLDER) -> tuple[list[str], list[str]]:
    """Compile what is found.

    Returns the plugins that stand, and a line for each that does not: what is missing, and the
    remedy. NativeError where nothing stands, or anything is missing and OFG_NATIVE is "required".
    """
    place = os.pathsep.join([sysconfig.get_path("scripts"), os.environ.get("PATH", "")])
    cmake = shutil.which("cmake", path=place)
    if not cmake:
        raise NativeError(
            "The native lane needs cmake 3.20 or later; install it with: pip install cmake"
        )
    site = f"-DSITE_PACKAGES={sysconfig.get_path('platlib')}"
    command([cmake, "-S", str(SOURCE), "-B", str(folder), site, "-DCMAKE_BUILD_TYPE=Release"])
    missing = (folder / "missing.txt").read_text().splitlines()
    # One that fails to compile (an old compiler, no crates at hand) must not cost the others.
    if said := _made(cmake, folder, "all", "--", "-k"):
        missing += _failed(cmake, folder)
    stand = standing(folder)
    if not stand or not (folder / "lane").is_file():
        raise NativeError(
            f"The native lane does not compile: {said}. It needs a C++20 compiler and make."
        )
    demand(missing)
    return stand, missing


def _made(cmake: str, folder: Path, target: str, *more: str) -> str:
    """Build a target. What went wrong; nothing where it stands."""
    words = [cmake, "--build", str(folder), "--parallel", "2", "--target", target, *more]
    outcome = subprocess.run(words, capture_output=True, text=True)
    return last(outcome.stderr or outcome.stdout) if outcome.returncode else ""


def _failed(cmake: str, folder: Path) -> list[str]:
    """A line for each plugin that does not compile. What an older build left of it is removed."""
    lines = []
    for name in (folder / "expected.txt").read_text().split():
        if said := _made(cmake, folder, f"{name}_plugin"):
            (folder / "plugins" / f"{name}.so").unlink(missing_ok=True)
            lines.append(f"{name}: it does not compile here ({said})")
    return lines


def demand(missing: list[str]) -> None:
    """NativeError where something is missing and OFG_NATIVE says that all is required."""
    if missing and os.environ.get(REQUIRED) == "required":
        lacking = "; without ".join(missing)
        raise NativeError(f"{REQUIRED}=required, and the native lane is without {lacking}")


def standing(folder: Path = FOLDER) -> list[str]:
    """The plugins that are built."""
    return [path.stem for path in plugins(folder)]


def plugins(folder: Path = FOLDER) -> list[Path]:
    """The files of the plugins that are built."""
    return sorted((folder / "plugins").glob("*.so"))


def command(words: list[str], **options) -> None:
    """Run a program of the lane. NativeError with what it says where it fails."""
    outcome = subprocess.run(words, capture_output=True, text=True, **options)
    if outcome.returncode:
        said = last(outcome.stderr or outcome.stdout) or f"exit code {outcome.returncode}"
        raise NativeError(f"The native lane's {Path(words[0]).name} failed: {said}")


def last(text: str) -> str:
    """The line of a program's output that says what is wrong."""
    lines = text.strip().splitlines()
    return next((line for line in lines if "error" in line.lower()), lines[-1] if lines else "")
