# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""python -m experiments.studies.stepping"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import pandas as pd
import typer
from rich.console import Console
from rich.progress import track as progress

from . import track
from .scene import SCENES, TRAVELS


def main(
    runs: Annotated[
        int, typer.Option(min=1, help="runs for each cell, each with its own start phase")
    ] = 40,
    seed: Annotated[int, typer.Option(help="seed of the start phases and attitudes")] = 0,
    only: Annotated[
        str, typer.Option(help='contestants whose names contain this text: "bullet", "ofg", "ccd"')
    ] = "",
    scene: Annotated[
        str, typer.Option(help='scenes whose names contain this text: "ball", "box", "rod"')
    ] = "",
    out: Annotated[
        Path | None,
        typer.Option(
            help="folder for stepping.csv (all cells, with intervals) and stepping.md (the tables)"
        ),
    ] = None,
) -> None:
    """Step bodies towards obstacles that they must not pass, and count those that do.

    Balls and boxes fly at a wall, a rod rotates towards a post, by 0.05 to 100 thicknesses of the
    obstacle per step. Engines run as simulators, at their own default time step, with each of their
    remedies against tunnelling; methods without dynamics stop a body in a plain loop. A body has
    passed if it ends beyond the obstacle's middle. All contestants get the same random start
    phases: with a fixed phase the result depends on luck.
    """
    scenes = [s for s in SCENES if scene in s.name]
    contestants = [c for c in track.CONTESTANTS if only in c.name]
    if not scenes or not contestants:
        raise typer.BadParameter(
            f"nothing to run: scenes are {', '.join(s.name for s in SCENES)}; contestants are "
            f"{', '.join(c.name for c in track.CONTESTANTS)}"
        )
    console = Console()
    absent = {c.name: reason for c in contestants if (reason := track.absent(c))}
    for name, reason in absent.items():
        console.print(f"left out: {name}: {reason}", markup=False)
    contestants = [c for c in contestants if c.name not in absent]
    cells = track.measure(contestants, scenes, TRAVELS, runs, seed)
    rows = pd.DataFrame(
        list(
            progress(
                cells,
                "step",
                total=len(scenes) * len(contestants) * len(TRAVELS),
                console=Console(stderr=True),
            )
        )
    )
    text = "\n\n".join(
        f"## {s.name}\n\nTunnelled of {runs}, by thicknesses per step; Wilson intervals in"
        " stepping.csv.\n\n" + track.table(rows, s.name).to_markdown(index=False)
        for s in scenes
    )
    console.print(text, markup=False, highlight=False, soft_wrap=True)
    if out:
        out.mkdir(parents=True, exist_ok=True)
        rows.to_csv(out / "stepping.csv", index=False)
        (out / "stepping.md").write_text(text + "\n")


if __name__ == "__main__":
    typer.run(main)
