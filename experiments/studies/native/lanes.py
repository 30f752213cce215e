# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Both lanes side by side: a method asked from Python, and the same library asked in C++.

The Python lane's net time is its gross time less the method's floor (its call on two tetrahedra far
apart). Where it is not the native time, WHY says what the binding adds or saves.
"""

from __future__ import annotations

import numpy as np
import pandas as pd

from baselines import registry
from baselines.label import name_of
from experiments.cases.case import Case
from experiments.run.bins import Bin
from experiments.run.config import TimingChoice
from experiments.run.timing import COLUMNS, FLOOR, time_bin

from . import twins
from .cell import Cell
from .classes import BEHIND
from .measuring import CELL

LIMIT = 0.3  #: of the native time: a larger difference is explained

TABLES = (
    "from Python equal bodies share their tables, where every native pair has its own; its floor"
    " holds the bounding spheres' test"
)
WHY = {  # library, or method: why its net Python time is not its native time
    "bullet": (
        "pybullet makes two collision objects, a contact test and a list of points for each"
        " call, more than its floor holds; the native lane asks the GJK pair detector alone."
        " The casts are the same code in both lanes; their floor holds the cast of two"
        " tetrahedra"
    ),
    "coal": (
        "its floor, a call on tetrahedra, holds part of the test itself, which is most of it"
        " on cheap pairs"
    ),
    "fcl": (
        "its floor holds part of the test on cheap pairs, and a hit costs more than a miss"
        " (python-fcl builds a list of contacts); where the ratio is below 1 on large bodies the"
        " wheel's FCL is faster than the packaged build of the same version"
    ),
    "mujoco": (
        "its floor holds mj_kinematics and part of the test; the native time has no"
        " mj_kinematics, whose result is laid ready"
    ),
    "ofg": (
        "every prepared query has a workspace of its own, cold at each call, where the native"
        " lane shares one; its floor is nothing but the bounding spheres' test. From Python it"
        " takes the widest instruction set of the machine, and so does the native row"
    ),
    "ofg-verified": TABLES,
    "ofg-mpr": TABLES,
    "parry": (
        "its floor, a call on tetrahedra, holds part of the test itself, which is most of it"
        " on cheap pairs"
    ),
}


def compare(cell: Cell, times: pd.DataFrame, answers: pd.DataFrame, timing: TimingChoice):
    """A row per method that has both lanes: CELL, method, native, gross, floor, net, ratio, same.

    times, answers: as `measure` gave them, of this cold cell. ratio: net Python over native. same:
    of the cases, those to which both lanes say the same.
    """
    times, answers = (frame[alike(frame.isa)] for frame in (times, answers))
    engines = [e for e in times.engine.unique() if twins.key(e)]
    engines = [e for e in engines if not registry.available(type(registry.make(e)[0]))]
    there = python_lane(engines, cell, timing)
    native = times.groupby("engine").ns.median()
    said = {e: answers[answers.engine == e].set_index("case").hit for e in engines}
    rows = [
        {
            "method": r.method,
            "native": native[r.method],
            "gross": r.gross,
            "floor": r.floor,
            "net": r.gross - r.floor,
            "same": _same(r.hits, said[r.method]),
        }
        for r in there.itertuples()
    ]
    made = pd.DataFrame(rows)
    for at, name in enumerate(CELL):
        made.insert(at, name, getattr(cell, name))
    return made.assign(ratio=made.net / made.native)


def alike(isa: pd.Series) -> pd.Series:
    """Which rows are of the builds that are nearest to those asked from Python."""
    widest = next(name for name in ("AVX-512", "AVX2", "SSE2") if (isa == name).any())
    return isa.isin(["generic", "as shipped", widest])


def _same(there: dict[str, bool], here: pd.Series) -> str:
    both = [case for case in here.index if case in there]
    return f"{sum(there[case] == here[case] for case in both)}/{len(both)}"


def python_lane(labels: list[str], cell: Cell, timing: TimingChoice) -> pd.DataFrame:
    """A row per method: hits by case, gross and floor (ns: medians over rounds, then over cases).

    By the runner's own protocol.
    """
    cases = [
        Case(name, "native", 0.0, i, query)
        for i, (name, query) in enumerate(zip(cell.cases, cell.queries))
    ]
    hits = {label: _hits(label, cases) for label in labels}
    asked = {label: set(found) for label, found in hits.items() if found}
    bin_ = Bin(cell.question, "", "", cases, asked)
    rows = pd.DataFrame(time_bin(bin_, timing), columns=COLUMNS)
    rows["ns"] = [np.median(rounds) for rounds in rows.rounds_ns]
    median = rows.groupby(["method", rows.case == FLOOR]).ns.median()
    return pd.DataFrame(
        [
            {
                "method": label,
                "hits": hits[label],
                "gross": median[label, False],
                "floor": median[label, True],
            }
            for label in asked
        ]
    )


def _hits(label: str, cases: list[Case]) -> dict[str, bool]:
    """What the method says of each case that it takes."""
    (method,) = registry.make(label)
    found = {}
    for case in cases:
        try:
            found[case.id] = bool(method.ready(case.query)().hit)
        except Exception:  # noqa: BLE001 - what the engine refuses or fails at is not timed
            continue
    return found


def _key(method: str) -> str:
    name = name_of(method).removeprefix(BEHIND)
    return name if name in WHY else name.split("-")[0]


def explained(table: pd.DataFrame) -> list[str]:
    """A line for each key of WHY, or other library, whose lanes differ by more than LIMIT."""
    far = table[(table.ratio - 1).abs() > LIMIT]
    lines = []
    for engine, part in far.groupby(far.method.map(_key)):
        why = WHY.get(engine, "not explained yet")
        span = f"{part.ratio.min():.2f} to {part.ratio.max():.2f} in {len(part)} cells"
        lines.append(f"- {engine} ({span}): {why}.")
    return lines
