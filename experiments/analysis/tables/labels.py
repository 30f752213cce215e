# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Tables of the cases: their certified labels, and the answers where bodies only touch."""

from __future__ import annotations

import pandas as pd

from experiments.analysis import metrics
from experiments.cases import families
from experiments.run.folder.rows import filled
from experiments.run.folder.store import Store

from .table import Table


def truth_table(store: Store) -> Table:
    cases = filled(store.read("cases.parquet"))
    rows = []
    for name, group in cases.groupby("scenario", sort=False):
        count = group.label.value_counts()
        rows.append(
            {
                "scenario": name,
                "question": group.question.iloc[0],
                "cases": len(group),
                "hit": count.get("hit", 0),
                "clear": count.get("clear", 0),
                "touching": int(group.touching.sum()),
                "uncertain": count.get("uncertain", 0),
                "drawn again": int(group.attempt.sum()),
                "precision": " ".join(sorted(group.precision.unique())),
                "exposes": _exposes(name),
            }
        )
    frame = pd.DataFrame(rows)
    text = frame.astype(str).rename(columns={"drawn again": "redrawn"})
    touching = ""
    if frame.touching.any():
        touching = (
            "Touching cases share a boundary point without overlapping; they count as clear here"
            " and enter no rate. "
        )
    else:
        text = text.drop(columns="touching")
    caption = (
        f"Uncertain cases enter no rate. {touching}Redrawn: draws rejected because the step started"
        " in overlap. Precision: float32 if every number of a case is rounded to it."
    )
    return Table(
        "truth",
        "Cases and their certified labels.",
        caption,
        frame,
        text,
        True,
        ("exposes", "precision", "redrawn"),
    )


def touching_table(part: pd.DataFrame, question: str) -> Table:
    """The answers of each method to touching cases; no rows if there are none."""
    counts = metrics.rates(part[part.touching], ["method"])
    clears = counts.touching - counts.touching_hits
    shown = {
        "cases": counts.asked,
        "answered": counts.touching,
        "said hit": counts.touching_hits,
        "said clear": clears,
    }
    text = pd.DataFrame({"method": counts.method, **{k: v.astype(str) for k, v in shown.items()}})
    numbers = counts[["method", "asked", "answered", "touching_hits"]].assign(
        touching_clears=clears
    )
    caption = (
        "The bodies are certified to touch without overlapping, so neither answer is wrong; these"
        " cases enter no rate."
    )
    title = f"Touching cases, {question}."
    return Table(f"touching-{question}", title, caption, numbers, text, True)


def _exposes(name: str) -> str:
    known = families.scenarios()
    return known[name].exposes if name in known else ""
