# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The native lane: the libraries themselves, asked the same cases in one interleaved C++ loop.

building.build() compiles what it finds; running.run(cells) times it. Bodies are convex (their
hulls) or closed meshes; unions have no lane here. One body moves here: where both translate it is
asked about A's motion relative to B.
"""

from __future__ import annotations

from .building import FOLDER, REQUIRED, SOURCE, NativeError, build
from .casefile import write
from .running import FLOOR, MODES, Taken, run

__all__ = [
    "FLOOR",
    "FOLDER",
    "MODES",
    "REQUIRED",
    "SOURCE",
    "NativeError",
    "Taken",
    "build",
    "run",
    "write",
]
