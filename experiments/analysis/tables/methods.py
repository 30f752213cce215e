# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The table of the methods of a run, as each method declares them."""

from __future__ import annotations

import pandas as pd

from baselines import registry
from baselines.label import name_of
from experiments.analysis.outcome import method_of
from experiments.run.folder.store import Store
from ofg import QUESTIONS

from .table import Table

UNKNOWN = "the method's file is not loaded"  #: shown instead of a guarantee


def _tolerance(name: str, found: pd.DataFrame) -> str:
    """The tolerances of a method's labels; more than one if it depends on a parameter."""
    made = [
        m for label in found.method.unique() if name_of(label) == name and (m := method_of(label))
    ]
    return " or ".join(dict.fromkeys(str(m.tolerance) for m in made)) or "unknown"


def _bodies(bodies: str, swept: str) -> str:
    """The initials of the kinds of bodies: "c m u", or "c m u: c u" where sweeps take fewer."""
    both = [" ".join(kind[0] for kind in kinds.split()) for kinds in (bodies, swept)]
    return both[0] if bodies == swept else ": ".join(both)


def method_table(store: Store, found: pd.DataFrame) -> Table:
    """The properties that each method of the run declares, with the engine version that ran."""
    versions, known, rows = store.facts.get("versions", {}), registry.methods(), []
    for name in dict.fromkeys(name_of(label) for label in found.method):
        m = known.get(name)
        if m is None:
            rows.append(
                {
                    "method": name,
                    "configuration": "unknown",
                    "engine": "unknown",
                    "answers": "",
                    "bodies": "",
                    "swept": "",
                    "tests": "unknown",
                    "tolerance": "unknown",
                    "guarantee": UNKNOWN,
                }
            )
            continue
        rows.append(
            {
                "method": name,
                "configuration": m.configuration,
                "engine": f"{m.engine} {versions.get(m.engine) or 'absent'}",
                "answers": " ".join(q for q in QUESTIONS if q in m.questions),
                "bodies": " ".join(sorted(m.bodies)),
                "swept": " ".join(sorted(m.bodies if m.swept is None else m.swept)),
                "tests": "solid" if m.solid else "surface",
                "tolerance": _tolerance(name, found),
                "guarantee": m.guarantee,
            }
        )
    frame = pd.DataFrame(rows)
    text = frame.assign(
        answers=[" ".join(q[0] for q in a.split()) for a in frame.answers],
        bodies=[_bodies(b, s) for b, s in zip(frame.bodies, frame.swept)],
    ).drop(columns="swept")
    return Table(
        "methods",
        "Methods.",
        "Properties declared by each method. Answers: overlap, translation, motion. Bodies: convex,"
        " mesh, union; those of sweeps behind a colon, if they differ. A method does not appear in"
        " the tables of questions that it does not answer.",
        frame,
        text.astype(str),
        optional=("guarantee", "engine"),
    )
