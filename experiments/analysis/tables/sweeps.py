# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Tables of sweeps: tunnelling by speed, and the error of the time of impact."""

from __future__ import annotations

import pandas as pd

from experiments.analysis import metrics
from experiments.cases import families

from .table import Table, of, pivot


def speed_table(part: pd.DataFrame, question: str) -> Table:
    """Misses by level in the scenarios whose axis is a speed over a thickness."""
    walls = [n for n in part.scenario.unique() if "thickness" in _axis(n)]
    part = part[part.scenario.isin(walls)]
    counts = (
        metrics.rates(part, ["method", "level"])
        if len(part)
        else pd.DataFrame(columns=["method", "level"])
    )
    levels = [f"{v:g}" for v in sorted(part.level.unique())]
    counts["speed"] = [f"{v:g}" for v in counts.level]
    return Table(
        f"tunnelling-{question}",
        f"Misses by speed over thickness, {question}.",
        f"Misses of hits answered in {', '.join(walls)}, by thicknesses travelled in the step.",
        counts,
        pivot(counts, "speed", lambda r: of(r.misses, r.hits), levels) if len(counts) else counts,
    )


def time_table(part: pd.DataFrame, question: str) -> Table:
    errors = metrics.times_of_impact(part, ["method"])
    text = pd.DataFrame({"method": errors.method, "times": errors.times.astype(str)})
    for column, title in (
        ("median", "median |error|"),
        ("p95", "95 %"),
        ("worst_late", "latest"),
        ("worst_early", "earliest"),
    ):
        text[title] = [f"{v:.1e}" if v else "0" for v in errors[column]]
    text["late"], text["early"] = errors.late.astype(str), errors.early.astype(str)
    return Table(
        f"time-of-impact-{question}",
        f"Time of impact, {question}.",
        "Error outside the certified bracket, as a share of the step, for correctly reported hits;"
        " late errors are positive.",
        errors,
        text,
    )


def _axis(name: str) -> str:
    known = families.scenarios()
    return known[name].axis if name in known else ""
