# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The tables of a run: first accuracy, then time.

Each table has a frame of numbers (CSV) and a frame of text (terminal, Markdown, LaTeX).
experiments/GLOSSARY.md defines the column heads.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import pandas as pd

from experiments.analysis import outcome
from experiments.run.folder.inside import inside
from experiments.run.folder.store import Store

from . import accuracy
from .chosen import WITH_PIECES, check, chosen_tables
from .cost import cost_tables
from .labels import touching_table, truth_table
from .methods import method_table
from .stepping import stepping_tables
from .sweeps import speed_table, time_table
from .table import Table, texts
from .unanswered import trouble_table

__all__ = ["Table", "build", "check", "save", "texts"]


def build(store: Store) -> Iterator[Table]:
    """Every table of the run that has rows, in reading order; the tables that its configuration
    defines come first.
    """
    if store.config.stepping:
        yield from stepping_tables(store)
        return
    found = outcome.outcomes(store)
    both = outcome.with_pieces(store, found)
    particular = [
        table
        for choice in store.config.tables
        for table in chosen_tables(store, both if choice.value in WITH_PIECES else found, choice)
    ]
    yield from (table for table in particular if len(table.text))
    yield from (
        replace(table, headline=table.headline and not particular)
        for table in general(store, found, both)
    )


def general(store: Store, found: pd.DataFrame, both: pd.DataFrame) -> Iterator[Table]:
    """The tables that every run has. both: `found` with the rows of the CoACD pieces."""
    makers = [truth_table(store), method_table(store, found), *accuracy.leaderboards(found)]
    for question in found.question.unique():
        part = found[(found.question == question) & (found.detail != f"does not answer {question}")]
        also = both[(both.question == question) & (both.detail != f"does not answer {question}")]
        makers += [
            accuracy.accuracy_table(also, question),
            accuracy.common_table(part, question),
            touching_table(part, question),
        ]
        makers += [accuracy.scenario_table(also, question), accuracy.rank_table(part, question)]
        if question == "overlap":
            makers.append(accuracy.gap_table(part))
        else:
            makers += [speed_table(part, question), time_table(part, question)]
    makers.append(trouble_table(found))
    if store.has("timings.parquet"):
        makers += list(cost_tables(store))
    yield from (table for table in makers if len(table.text))


def save(store: Store, tables: list[Table]) -> None:
    """Write each table as CSV, Markdown and LaTeX, and remove files of tables that no longer exist.
    Nothing is written outside the run's folder: see `inside`.
    """
    for table in tables:
        inside(store.folder, "tables", f"{table.name}.csv")
    for path in inside(store.folder, "tables").glob("*"):
        if path.suffix in (".csv", ".md", ".tex") and path.stem not in {
            table.name for table in tables
        }:
            path.unlink()
    for table in tables:
        for suffix, text in texts(table).items():
            store.write_text(text, "tables", f"{table.name}.{suffix}")
