# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The origin of a result besides its configuration: the code, the libraries, the user's own files.

An unfinished run that resumes after an update must not mix answers from two versions of the code;
answers of an unchanged engine are reused only while everything on which they depend is unchanged.
"""

from __future__ import annotations

import hashlib
import importlib.util
from functools import cache
from pathlib import Path

from . import manifest

ROOT = Path(__file__).parents[3]
PACKAGES = ("ofg", "baselines", "experiments")
NATIVE = ("ofg._core", "experiments.truth.prove._native")
CODE = (".py", ".csv")  # of baselines: units.csv, which affects how methods answer
READERS = ("publish",)  # parts of `experiments` that only read finished runs


def facts(engine: str | None = None) -> dict[str, object]:
    """The code and the versions of the libraries, and of one engine's distribution if given."""
    names = (*manifest.LIBRARIES, *([engine] if engine else []))
    return {"code": code(), "versions": {name: manifest.version(name) for name in names}}


@cache
def code() -> str:
    """A digest of the project's own code, Python and compiled: equal only for equal code."""
    found = hashlib.sha256()
    paths = [
        p
        for name in PACKAGES
        for p in sorted((ROOT / name).rglob("*"))
        if p.suffix in CODE
        and not (name == "experiments" and p.relative_to(ROOT / name).parts[0] in READERS)
    ]
    for path in [*paths, *map(_compiled, NATIVE)]:
        content = hashlib.sha256(path.read_bytes()).hexdigest()
        found.update(f"{path.name} {content}\n".encode())
    return found.hexdigest()[:32]


def _compiled(module: str) -> Path:
    """The file of a compiled module. ImportError if it is missing."""
    spec = importlib.util.find_spec(module)
    if spec is None or spec.origin is None:
        raise ImportError(f"The compiled module {module} is missing; make it with: make build")
    return Path(spec.origin)
