# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The manifest of a run: everything about its origin that is needed to question a figure."""

from __future__ import annotations

import hashlib
import os
import platform
import subprocess
import sys
from datetime import UTC, datetime
from importlib import metadata
from pathlib import Path

import psutil

from baselines import registry
from baselines.native import library
from experiments.run.config import RunConfig

LIBRARIES = ("numpy", "scipy", "pandas", "pyarrow", "python-flint", "trimesh", "coacd", "ofg")


def machine() -> dict[str, object]:
    """Processor, frequency, memory, load, system: without the machine's name or any path."""
    frequency = psutil.cpu_freq()
    return {
        "processor": _processor(),
        "cores": os.cpu_count(),
        "mhz": round(frequency.current) if frequency else None,
        "memory_gib": round(psutil.virtual_memory().total / 2**30),
        "load": [round(x, 2) for x in os.getloadavg()],
        "system": platform.platform(),
        "python": sys.version.split()[0],
    }


def versions(config: RunConfig) -> dict[str, str | None]:
    engines = {m.engine for spec in config.asked for m in registry.make(spec)}
    return {name: version(name) for name in sorted(engines | set(LIBRARIES))}


def build() -> dict[str, str]:
    """Compiler and flags of the project's native code, and the instruction set that it uses
    here.
    """
    from ofg import _core

    return {"compiler": _core.build, "isa": ("sse2", "avx2", "avx512")[_core.widest_isa()]}


def commit() -> str:
    """The commit of the checkout, with '+' if files other than results differ from it; 'unknown'
    outside a checkout.
    """
    root = Path(__file__).parent
    try:
        head = subprocess.run(
            ["git", "rev-parse", "HEAD"], cwd=root, capture_output=True, text=True, check=True
        ).stdout.strip()
        dirty = subprocess.run(
            ["git", "status", "--porcelain", "-uno", "--", ":/", ":(top,exclude)results"],
            cwd=root,
            capture_output=True,
            text=True,
            check=True,
        ).stdout.strip()
        return head + ("+" if dirty else "")
    except (OSError, subprocess.CalledProcessError):
        return "unknown"


def now() -> str:
    return datetime.now(UTC).isoformat(timespec="seconds")


def version(name: str) -> str | None:
    """Version of an installed distribution, or of a library built by the native lane; None if
    absent.
    """
    if found := library.version(name):
        return found
    try:
        return metadata.version(name)
    except metadata.PackageNotFoundError:
        return None


def _processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
        return next(
            line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")
        )
    except (OSError, StopIteration):
        return platform.processor() or "unknown"


#: derived from the rows at any time, or about the machine: not data of the run
DERIVED = {
    "manifest.json",
    "report.html",
    "outcomes.parquet",
    "workers.log",
    "tables",
    "figures",
    "parts",
}


def hashes(folder: Path) -> dict[str, str]:
    """SHA-256 (hex) of each data file of a run by its path in the folder. Links are not
    followed.
    """
    found = {}
    for path in sorted(Path(folder).rglob("*")):
        name = path.relative_to(folder)
        if name.parts[0] in DERIVED or name.parts[0].startswith("."):
            continue
        if path.is_file() and not path.is_symlink():
            found[name.as_posix()] = digest(path)
    return found


def digest(path: Path) -> str:
    """SHA-256 (hex) of a file."""
    with path.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()
