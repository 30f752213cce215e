# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The tables and figures of a finished run."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from experiments.cli.arguments import Run, Trust
from experiments.cli.reading import opened, reading
from experiments.cli.screen import console, print_table
from experiments.run.folder import given
from experiments.run.folder.given import markup


def tables(
    run_: Run,
    only: Annotated[
        str, typer.Option(help="print only the tables whose name contains this text")
    ] = "",
    into: Annotated[
        Path | None,
        typer.Option(
            help=(
                "also insert the tables into this Markdown page, between its markers"
                " `<!-- table NAME -->` and `<!-- end -->`"
            )
        ),
    ] = None,
    trust: Trust = False,
) -> None:
    """Rebuild the tables of a finished run from its rows, and print them."""
    from experiments.analysis import outcome
    from experiments.analysis.tables import build
    from experiments.analysis.tables import save as save_tables
    from experiments.publish import readme

    with reading(run_):
        store = opened(run_, trust)
        found = list(build(store))
        save_tables(store, found)
        if store.has("observations.parquet"):
            outcome.save(store)
    for table in found:
        if only in table.name:
            print_table(table)
    console.print("Terms: experiments/GLOSSARY.md")
    if into:
        into.write_text(readme.fill(given.text(into, "The page"), run_ / "tables"))


def figures(run_: Run, trust: Trust = False) -> None:
    """Redraw the figures of a finished run."""
    from experiments.analysis.plots import curves
    from experiments.analysis.plots.figures import accuracy_speed
    from experiments.analysis.tables import build

    with reading(run_):
        store = opened(run_, trust)
        curves.save(store, list(build(store)))
        if store.has("timings.parquet"):
            accuracy_speed(store)
    console.print(f"Figures are in {markup(run_ / 'figures')}.")
