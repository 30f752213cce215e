# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""ofg-bench native: build the native benchmark with the libraries found, and run it."""

from __future__ import annotations

from contextlib import nullcontext
from pathlib import Path
from typing import Annotated

import typer

from experiments.cli.reading import opened, reading

Run = Annotated[
    Path | None,
    typer.Argument(
        metavar="RUN",
        help="folder of the run whose certified cases are used [default: convex hulls by size]",
    ),
]
Cases = Annotated[int, typer.Option(min=1, help="cases per cell, each with its own bodies")]
Poses = Annotated[
    int,
    typer.Option(min=32, help="poses per cell of one pair; a quarter from 1,280 faces on"),
]
Rounds = Annotated[int, typer.Option(min=3, help="timed rounds")]
Seed = Annotated[int, typer.Option(min=0, help="seed of bodies and poses; not used with RUN")]
Core = Annotated[int, typer.Option(min=-1, help="processor core to run on; -1 for any")]
Python = Annotated[bool, typer.Option("--python", help="also time the methods from Python")]
Concave = Annotated[bool, typer.Option("--concave", help="time closed meshes and unions instead")]
Build = Annotated[bool, typer.Option("--build", help="only build; time nothing")]
Out = Annotated[
    Path | None,
    typer.Option(
        help="folder for rows.parquet and native.md; native.md has tables that are not printed"
    ),
]


def native(
    run: Run = None,
    cases: Cases = 24,
    poses: Poses = 512,
    rounds: Rounds = 11,
    seed: Seed = 1,
    core: Core = 0,
    python: Python = False,
    concave: Concave = False,
    out: Out = None,
    build: Build = False,
) -> None:
    """Time OFG and the engines as C++ libraries on the same cases, and count wrong answers.

    With RUN, the cases are its certified cases of convex bodies and meshes, and the table is added
    to its report. Without RUN, the cases are pairs of 12 to 5,120 faces, apart, overlapping and
    moving, with certified labels; with --concave, pairs of closed meshes of 80 to 20,480 faces and
    of unions of 2 to 64 pieces. With OFG_NATIVE=required, an engine that cannot be built is an
    error.
    """
    from baselines.native import NativeError
    from experiments.studies.native import concave as concave_bodies
    from experiments.studies.native.study import head, study

    try:
        if build:
            print("\n".join(head()))
            return
        pinned = None if core < 0 else core
        if concave:
            head()
            concave_bodies.study(cases, rounds, seed, pinned, out)
            return
        with reading(run) if run else nullcontext():
            if run:
                opened(run, False)  # before anything is built
            study(run, cases, poses, rounds, seed, pinned, python, out)
    except NativeError as error:
        typer.echo(str(error), err=True)
        raise typer.Exit(1) from error
