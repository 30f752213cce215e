# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Cells of a run: its certified cases, put into the bins in which the run times its methods."""

from __future__ import annotations

from collections.abc import Iterator

from experiments.run.bins import situation_of, size_of
from experiments.run.folder.rows import cases_of
from experiments.run.folder.store import Store

from .cell import Cell, kind


def cells(store: Store, most: int | None = None) -> Iterator[Cell]:
    """The certified cases that the native lane takes, by bodies, question, faces and situation.

    most: cases of a cell, spread over its scenarios and levels; all if None.
    """
    cases = store.read("cases.parquet")
    queries = {case.id: case.query for case, _ in cases_of(cases, store.read("bodies.parquet"))}
    cases = cases[cases.label != "uncertain"]
    cases = cases.assign(
        range=size_of(cases.faces),
        situation=situation_of(cases),
        bodies=[kind(queries[case]) for case in cases.case],
    )
    bins = cases[cases.bodies.notna()].groupby(["bodies", "question", "range", "situation"])
    for (bodies, question, faces, situation), rows in bins:
        rows = rows.sort_values(["index", "scenario", "level"]).head(most or len(rows))
        asked = [queries[case] for case in rows.case]
        yield Cell(
            bodies, faces, question, situation, ("cold",), asked, list(rows.label), list(rows.case)
        )


def left_out(store: Store) -> int:
    """How many certified cases the native lane cannot be asked."""
    cases = store.read("cases.parquet")
    pairs = cases_of(cases, store.read("bodies.parquet"))
    return sum(truth.label != "uncertain" and kind(case.query) is None for case, truth in pairs)
