"""The report of a run, a page for one case, the findings over all runs."""

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
        Path, typer.Argument(help="folder of run folders, as reproduce makes it")
    ] = Path("results"),
    into: Annotated[
        Path | None, typer.Option(help="write the page here [default: print it]")
    ] = None,
    objections: Annotated[
        Path | None,
        typer.Option(help="write the page of objections and answers here, and no findings"),
    ] = None,
) -> None:
    """Say what the runs of a folder found: each claim of the article with its verdict, then each
    engine. What is missing is said to be.
    """
    from experiments.publish.findings import Runs, page
    from experiments.publish.findings import objections as objections_page

    if not results.is_dir():
        raise configuration.ConfigError(
            f"The folder {results} does not exist. Name the one that ofg-bench reproduce made."
        )
    with reading(results):
        text = page(results) if objections is None else objections_page.page(Runs(results))
    into = into or objections
    if into is None:
        print(text, end="")
        return
    into.write_text(text)
    console.print(f"The page is {markup(into)}.")


def report(run_: Run, trust: Trust = False) -> None:
    """Write report.html of a finished run anew: one file with everything, for any browser."""
    from experiments.publish.report import report as write_report

    with reading(run_):
        write_report(opened(run_, trust))
    console.print(f"The report is {markup(run_ / 'report.html')}.")


def explain(
    name: Annotated[
        str | None,
        typer.Argument(
            metavar="CASE",
            help="a case of the run, as in its tables and its report, like thin_wall/100/0007",
        ),
    ] = None,
    run_: Annotated[
        Path | None, typer.Option("--run", help="folder of the run that has the case")
    ] = None,
    file: Annotated[
        Path | None, typer.Option(help="a case in a file of its own, instead of a run")
    ] = None,
    out: Annotated[
        Path | None, typer.Option(help="the page [default: CASE.html, with - for /]")
    ] = None,
    save: Annotated[
        Path | None, typer.Option(help="also write the case into this file, for --file")
    ] = None,
    ask: Annotated[
        bool, typer.Option("--ask", help="ask the methods anew, each in a process of its own")
    ] = False,
    method: Annotated[
        list[str] | None,
        typer.Option(
            "--method",
            help="which to ask with --ask; may be repeated [default: those of the run or file]",
        ),
    ] = None,
    methods: Methods = None,
    trust: Trust = False,
) -> None:
    """Show one case: a page with its bodies in 3D and its certificate, and a table of what every
    method said.
    """
    from experiments.publish.report.request import Request, show

    if (run_ is None) == (file is None) or (run_ is not None and name is None):
        raise configuration.ConfigError(
            "Name a case and its run (ofg-bench explain thin_wall/100/0007 --run"
            " results/runs/quick), or a file (ofg-bench explain --file case.json)."
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
