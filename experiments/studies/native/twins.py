# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Which native configurations and which methods are the same configuration of an engine."""

from __future__ import annotations

import pandas as pd

from baselines import registry
from baselines.label import name_of

from .measuring import CONTESTANT


def key(label: str) -> tuple | None:
    """The method and all its parameters, whichever of them the label names; None for no method."""
    if name_of(label) not in registry.methods():
        return None
    try:
        made = registry.make(label)
    except (TypeError, ValueError):
        return None
    (method,) = made
    return method.name, tuple(sorted(method.parameters.items()))


def pairs(engines, labels) -> dict[str, str]:
    """engine -> the label of the method that is its twin, of those that have one."""
    known = {key(label): label for label in labels}
    found = {engine: known.get(key(engine)) for engine in engines if key(engine)}
    return {engine: label for engine, label in found.items() if label}


def alone(engines, labels) -> tuple[list[str], list[str]]:
    """Engines without a method, and methods without an engine: listed, never joined."""
    both = pairs(engines, labels)
    return [e for e in engines if e not in both], [m for m in labels if m not in both.values()]


def disagreements(answers: pd.DataFrame, observed: pd.DataFrame) -> pd.DataFrame:
    """CONTESTANT, method, cases, differ: twins' answers to the same cases.

    observed: observations of a run. Cases that the method did not answer are not compared.
    """
    both = pairs(answers.engine.unique(), observed.method.unique())
    said = observed[observed.status == "ok"][["method", "case", "hit"]]
    rows = answers.assign(method=answers.engine.map(both))
    rows = rows.merge(said, on=["method", "case"], suffixes=("", "_there"))
    rows = rows.assign(differ=rows.hit != rows.hit_there.astype(bool))
    counts = rows.groupby([*CONTESTANT, "method"], sort=False).differ.agg(["size", "sum"])
    return counts.rename(columns={"size": "cases", "sum": "differ"}).reset_index()
