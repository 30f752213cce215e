# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Check a run, or a method."""

from __future__ import annotations

from typing import Annotated

import typer

from baselines import registry
from experiments.cli.arguments import Methods, Run, Trust, Workers, load_own
from experiments.cli.reading import reading
from experiments.cli.screen import console, print_grid
from experiments.run import config as configuration
from experiments.run.folder import given
from experiments.run.folder.store import Store


def verify(
    run_: Run,
    ask: Annotated[
        str, typer.Option(help="number of random cases to run the methods on again, or 'all'")
    ] = "",
    ask_seed: Annotated[
        int | None, typer.Option(min=0, help="seed for the choice of these cases")
    ] = None,
    trust: Trust = False,
    workers: Workers = None,
) -> None:
    """Check the files and rows of a run; redraw and prove every case again; repeat answers with
    --ask.

    The exit code is 0 if nothing is refused, and 1 otherwise. experiments/truth/README.md lists
    what this check cannot detect.
    """
    from experiments import verification

    if ask not in ("", "all") and not (ask.isascii() and ask.isdigit()):
        raise configuration.ConfigError(f"--ask must be a number of cases or 'all', not '{ask}'.")
    count = None if not ask else -1 if ask == "all" else int(ask)
    with reading(run_):
        found = verification.verify(Store(run_), count, trust, workers, ask_seed)
    for line in str(found).splitlines():
        console.print(given.printable(line), highlight=False, markup=False)
    raise typer.Exit(0 if found.ok else 1)


def check(
    name: Annotated[
        str, typer.Argument(metavar="METHOD", help='method with its parameters, such as "ofg k=16"')
    ],
    methods: Methods = None,
) -> None:
    """Run a method through the conformance suite that every method must pass."""
    from baselines import conformance

    load_own(methods, None)
    failed = 0
    for method in registry.make(name):
        results = conformance.check(method)
        failed += sum(not ok for _, ok, _ in results)
        print_grid(
            method.label,
            ("property", "", "detail"),
            [(n, "ok" if ok else "FAILED", detail) for n, ok, detail in results],
        )
    raise typer.Exit(1 if failed else 0)
