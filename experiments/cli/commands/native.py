"""ofg-bench native: build the native lane with what is found here, and time everything in it."""

from __future__ import annotations

from contextlib import nullcontext
from pathlib import Path
from typing import Annotated

import typer

from experiments.cli.reading import opened, reading

Run = Annotated[
    Path | None,
    typer.Argument(
        help="folder of a run, whose certified cases are asked [default: hulls by size]"
    ),
]
Cases = Annotated[int, typer.Option(min=1, help="cases of a cell, each with bodies of its own")]
Poses = Annotated[
    int,
    typer.Option(min=32, help="poses of a cell of one pair; a quarter of them from 1,280 faces on"),
]
Rounds = Annotated[int, typer.Option(min=3, help="timed rounds")]
Seed = Annotated[int, typer.Option(min=0, help="of bodies and poses; a run has its own")]
Core = Annotated[int, typer.Option(min=-1, help="the core to run on; -1: any")]
Python = Annotated[bool, typer.Option("--python", help="ask the methods from Python, too")]
Build = Annotated[bool, typer.Option("--build", help="build what is found, and time nothing")]
Out = Annotated[
    Path | None,
    typer.Option(
        help="folder for rows.parquet and native.md, which has more tables than are printed"
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
    out: Out = None,
    build: Build = False,
) -> None:
    """Time OFG and the engines as C++ libraries on the same cases: who errs, at what cost.

    With a RUN: its certified cases of convex bodies and meshes. The table goes into its report.
    Without: pairs of 12 to 5,120 faces, apart, in each other and flying, with certified labels.
    OFG_NATIVE=required makes an engine that cannot be built an error.
    """
    from baselines.native import NativeError
    from experiments.studies.native.study import head, study

    try:
        if build:
            print("\n".join(head()))
            return
        pinned = None if core < 0 else core
        with reading(run) if run else nullcontext():
            if run:
                opened(run, False)  # before anything is built
            study(run, cases, poses, rounds, seed, pinned, python, out)
    except NativeError as error:
        typer.echo(str(error), err=True)
        raise typer.Exit(1) from error
