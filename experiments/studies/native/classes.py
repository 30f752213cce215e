# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Which builds are compared: like with like, by the instruction set they are compiled for."""

from __future__ import annotations

import pandas as pd

V3 = "x86-64-v3"
#: class -> the instruction set of OFG in it. Engines stand in the first with their generic builds,
#: in the others with those for x86-64-v3 (AVX2 and FMA; none is built for AVX-512)
CLASSES = {"generic": "SSE2", V3: "AVX2", "AVX-512": "AVX-512"}
LIBRARIES = {"fcl": "FCL", "bullet": "Bullet", "mujoco": "MuJoCo", "coal": "Coal", "parry": "parry"}
BEHIND = "spheres-"  #: begins the name of an engine behind OFG's spheres
CONTROL = "behind spheres"  #: such a one is no engine, and not OFG


def library(engine: str) -> str:
    """What an engine is of: "OFG", CONTROL, or a name of LIBRARIES."""
    if engine.startswith(BEHIND):
        return CONTROL
    return LIBRARIES.get(engine.split("-")[0].split(",")[0].split(" ")[0], "OFG")


def is_library(engine: str) -> bool:
    """Is it a library as its users call it: not OFG, and no control?"""
    return library(engine) in LIBRARIES.values()


def standing(rows: pd.DataFrame, name: str) -> pd.DataFrame:
    """The rows of a class. An engine of which there is one build alone stands in all with it."""
    ours = rows.engine.map(library) == "OFG"
    newer = rows.isa == V3
    built = set(rows.engine[newer])
    theirs = ~newer if name == "generic" else newer | ~rows.engine.isin(built)
    return rows[(ours & (rows.isa == CLASSES[name])) | (~ours & theirs)]
