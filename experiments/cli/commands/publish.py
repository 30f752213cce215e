# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The report of a run, the page of one case, and the findings of all runs."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from experiments.cli.arguments import Methods, Run, Trust, load_own
from experiments.cli.reading import opened, reading
from experiments.cli.screen import console, print_grid
from experiments.run import config as configuration
from experiments.run.folder.given import markup


def findings(
    results: Annotated[
        Path, typer.Argument(help="folder of run folders, as ofg-bench reproduce creates it")
    ] = Path("results"),
    into: Annotated[
        Path | None, typer.Option(help="file to write [default: print the page]")
    ] = None,
    objections: Annotated[
        Path | None,
        typer.Option(help="write objections and answers to this file instead of the findings"),
    ] = None,
) -> None:
    """Summarise the findings of all runs in a folder: a verdict on each claim of the article, then
    a section per engine. Missing runs are listed.
    """
    from experiments.publish.findings import Runs, page
    from experiments.publish.findings import objections as objections_page

    if not results.is_dir():
        raise configuration.ConfigError(
            f"The folder {results} does not exist. Name the folder that ofg-bench reproduce"
            " created."
        )
    with reading(results):
        text = page(results) if objections is None else objections_page.page(Runs(results))
    into = into or objections
    if into is None:
        print(text, end="")
        return
    into.write_text(text)
    console.print(f"Wrote {markup(into)}.")


def report(run_: Run, trust: Trust = False) -> None:
    """Rebuild report.html of a finished run: one self-contained file for any browser."""
    from experiments.publish.report import report as write_report

    with reading(run_):
        write_report(opened(run_, trust))
    console.print(f"The report is {markup(run_ / 'report.html')}.")


def explain(
    name: Annotated[
        str | None,
        typer.Argument(
            metavar="CASE",
            help="name of a case as in the report, such as thin_wall/100/0007",
        ),
    ] = None,
    run_: Annotated[
        Path | None, typer.Option("--run", help="folder of the run that contains the case")
    ] = None,
    file: Annotated[Path | None, typer.Option(help="file with one case, instead of a run")] = None,
    out: Annotated[
        Path | None,
        typer.Option(help="file of the page [default: CASE.html, with / replaced by -]"),
    ] = None,
    save: Annotated[
        Path | None, typer.Option(help="also write the case to this file, for use with --file")
    ] = None,
    ask: Annotated[
        bool, typer.Option("--ask", help="run the methods again, each in its own process")
    ] = False,
    method: Annotated[
        list[str] | None,
        typer.Option(
            "--method",
            help="method to run again; may be repeated [default: all methods of the run or file]",
        ),
    ] = None,
    methods: Methods = None,
    trust: Trust = False,
) -> None:
    """Show one case: a page with its bodies in 3D and its certificate, and a table of answers."""
    from experiments.publish.report.request import Request, show

    if (run_ is None) == (file is None) or (run_ is not None and name is None):
        raise configuration.ConfigError(
            "Name a case and its run (ofg-bench explain thin_wall/100/0007 --run"
            " results/runs/quick), or only a file (ofg-bench explain --file case.json)."
        )
    load_own(methods, None)
    with reading(run_ or file):
        store = opened(run_, trust) if run_ else None
        request = Request(
            name,
            store,
            file,
            tuple(method or ()),
            tuple(map(str, methods or ())),
            ask or bool(method),
            trust,
        )
        show(request, out, save, print_grid, console.print)
