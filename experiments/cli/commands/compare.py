# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Compare two runs."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from experiments.cli.arguments import Trust
from experiments.cli.reading import opened, reading
from experiments.cli.screen import console, print_grid
from experiments.run.folder.given import markup
from experiments.run.folder.store import Store


def compare(
    first: Annotated[
        Path, typer.Argument(metavar="FIRST", help="folder of the run before the change")
    ],
    second: Annotated[
        Path, typer.Argument(metavar="SECOND", help="folder of the run after the change")
    ],
    show: Annotated[int, typer.Option(min=0, help="maximum number of changed rows to print")] = 40,
    accept: Annotated[
        bool,
        typer.Option(
            "--accept",
            help=(
                "after the comparison, replace FIRST by the answers and labels of SECOND, without"
                " certificates and times, as the new reference"
            ),
        ),
    ] = False,
    trust: Trust = False,
) -> None:
    """Compare two runs: accuracy case by case, and time as ratios paired by case.

    The exit code is 0 if accuracy is identical over the same cases and methods, and 1 otherwise.
    """
    from experiments.analysis.compare import compare as differences
    from experiments.analysis.compare import reference

    if accept and not Store(first).has("config.json"):
        with reading(second):
            reference(opened(second, trust), Store(first))
        console.print(f"{markup(first)} is now the reference, made from {markup(second)}.")
        return
    with reading(first, second):
        before, after = opened(first, trust), opened(second, trust)
        found = differences(before, after)
    for what, (left, right) in (("cases", found.only_cases), ("methods", found.only_methods)):
        for names, folder in ((left, first), (right, second)):
            if names:
                console.print(
                    f"[bold]Only in {markup(folder)}[/]: {len(names)} {what}:"
                    f" {markup(', '.join(names[:8]))}{', ...' if len(names) > 8 else ''}",
                    highlight=False,
                )
    if found.remade:
        console.print(
            f"{len(found.remade)} cases have different bodies, poses or motions in"
            f" {markup(second)} and are not compared; {len(found.changed)} of them differ by more"
            " than rounding, so they are different queries:"
            f" {markup(', '.join(found.remade[:8]))}{', ...' if len(found.remade) > 8 else ''}",
            highlight=False,
        )
    for title, frame in (
        ("Changed labels: the certified truth of the two runs differs.", found.labels),
        ("Changed answers.", found.answers),
    ):
        if len(frame):
            print_grid(
                title,
                frame.columns,
                list(frame.head(show).itertuples(index=False)),
                f"{min(show, len(frame))} of {len(frame)} shown.",
            )
    if len(found.rates):
        pairs = [c.removesuffix("_before") for c in found.rates.columns if c.endswith("_before")]
        rows = [
            (
                r["question"],
                r["method"],
                *(_moved(r[f"{c}_before"], r[f"{c}_after"]) for c in pairs),
            )
            for r in found.rates.to_dict("records")
        ]
        print_grid(
            "Changed accuracy, over the cases of both runs.",
            ("question", "method", *(c.replace("_", " ") for c in pairs)),
            rows,
            "before -> after.",
        )
    if len(found.times):
        print_grid(
            "Time ratio, second run to first.",
            found.times.columns,
            [
                (r.question, r.method, f"{r.ratio:.3g}", f"{r.low:.3g}", f"{r.high:.3g}", r.pairs)
                for r in found.times.itertuples()
            ],
            "Median of the case-by-case ratios of gross times, with its 95 % bootstrap interval."
            " The state of the machine may differ between the runs; the ratios of unchanged methods"
            " show by how much.",
        )
    console.print(
        f"Accuracy is {'identical' if found.identical else 'NOT identical'}: {len(found.answers)}"
        f" of {found.compared} answers changed, {len(found.labels)} labels"
        f" changed{'' if found.same_content else '; the runs differ in their cases or methods'}"
        f"{f'; {len(found.changed)} cases are different queries' if found.changed else ''}.",
        highlight=False,
    )
    if accept:
        reference(after, before)
        console.print(f"{markup(first)} is now the reference, made from {markup(second)}.")
        return
    raise typer.Exit(0 if found.identical else 1)


def _moved(before, after) -> str:
    return f"{before}" if before == after else f"{before} -> {after}"
