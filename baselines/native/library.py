# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""A plugin of the native lane as a library that Python calls: is it built, and in what version."""

from __future__ import annotations

import ctypes
import hashlib
from functools import cache
from pathlib import Path

from ..errors import MissingEngine
from . import FOLDER

#: name of an engine, as methods declare it -> (its plugin, the remedy where there is none)
ENGINES = {
    "libbullet": (
        "bullet_casts",
        (
            "install its headers in doubles (Debian: apt-get install libbullet-dev pkg-config) and"
            " build with: ofg-bench native --build"
        ),
    ),
}


def missing(engine: str) -> str | None:
    """None where the plugin of an engine is built, else the reason and the remedy.

    KeyError for a name that is not in ENGINES.
    """
    return None if _path(engine).is_file() else f"{engine} is not installed; {ENGINES[engine][1]}"


@cache
def load(engine: str) -> ctypes.CDLL:
    """The plugin of an engine. MissingEngine where it is not built or does not open."""
    if reason := missing(engine):
        raise MissingEngine(reason)
    try:
        return ctypes.CDLL(str(_path(engine)))
    except OSError as error:
        reason = f"{engine} does not open ({error}); build it anew with: ofg-bench native --build"
        raise MissingEngine(reason) from error


def version(engine: str) -> str | None:
    """The library's version and a digest of the plugin: '3.24+1f2e3d4c'. None if not built.

    The digest is there because the plugin's own code is part of what answers.
    """
    if engine not in ENGINES or missing(engine):
        return None
    number = load(engine).bullet_casts_version()
    digest = hashlib.sha256(_path(engine).read_bytes()).hexdigest()[:8]
    return f"{number // 100}.{number % 100}+{digest}"


def _path(engine: str) -> Path:
    return FOLDER / "plugins" / f"{ENGINES[engine][0]}.so"
