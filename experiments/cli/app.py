# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The command line: ofg-bench."""

from __future__ import annotations

import sys
from importlib.metadata import version
from typing import Annotated

import typer
from rich.console import Console

from experiments.run.folder.given import markup
from experiments.run.folder.store import StoreError
from experiments.run.processes.machine import ERRNOS, MachineError
from ofg import BodyError

from .commands import catalogue, compare, native, publish, run, tables, verify

app = typer.Typer(
    no_args_is_help=True,
    rich_markup_mode="markdown",
    pretty_exceptions_enable=False,
    help="""Benchmark collision detection on cases whose true answers are certified.

A run is one folder. `ofg-bench run quick` generates cases, certifies them, runs every method on
them, times the methods and prints the tables. `ofg-bench list` lists the scenarios, methods and
experiments. To write your own configuration, start from `ofg-bench preset quick > mine.toml`.""",
)


def _print_version(wanted: bool) -> None:
    if wanted:
        print(f"ofg-bench {version('ofg')}")
        raise typer.Exit


@app.callback()
def options(
    version_: Annotated[
        bool,
        typer.Option(
            "--version", callback=_print_version, is_eager=True, help="Print the version."
        ),
    ] = False,
) -> None:
    """Options given before a command."""


def _failed(text: str, code: int, word: str = "Error") -> int:
    Console(stderr=True).print(
        f"[bold red]{word}.[/] {markup(text)}", highlight=False, soft_wrap=False
    )
    return code


def main() -> None:
    """Entry point. An error is printed as one paragraph without a traceback. The exit code is 2 for
    a user's error and 1 for a failure of the machine.
    """
    try:
        app()
    except MachineError as error:
        sys.exit(_failed(str(error), 1, "Stopped"))
    except (ValueError, StoreError, BodyError, ImportError) as error:
        sys.exit(_failed(str(error), 2))
    except OSError as error:
        where = f"{error.filename}: " if error.filename else ""
        sys.exit(
            _failed(
                f"{where}{error.strerror or error}. Make it readable and writable, or free some"
                " space, then run the same command again; finished work is kept.",
                1 if error.errno in ERRNOS else 2,
            )
        )
    except KeyboardInterrupt:
        Console(stderr=True).print(
            "\nInterrupted. Finished work is kept; run the same command again to resume."
        )
        sys.exit(130)


app.command("list")(catalogue.list_)
for command in (
    catalogue.preset,
    run.run,
    run.reproduce,
    run.resume,
    tables.tables,
    tables.figures,
    compare.compare,
    publish.report,
    publish.findings,
    publish.explain,
    verify.verify,
    verify.check,
    native.native,
):
    app.command()(command)


if __name__ == "__main__":
    main()
