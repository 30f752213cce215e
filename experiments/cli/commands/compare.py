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
    first: Annotated[Path, typer.Argument(help="folder of a run: before")],
    second: Annotated[Path, typer.Argument(help="folder of a run: after")],
    show: Annotated[int, typer.Option(min=0, help="print at most so many answers that moved")] = 40,
    accept: Annotated[
        bool,
        typer.Option(
            "--accept",
            help=(
                "afterwards make SECOND the reference: FIRST then holds its answers and labels,"
                " without certificates and times"
            ),
        ),
    ] = False,
    trust: Trust = False,
) -> None:
    """Say what changed from one run to another: in accuracy, to the case, and in time, paired by
    case.

    Exit code 0 if accuracy is identical over the same cases and methods, 1 if not.
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
            f"{len(found.remade)} cases have other bodies, poses or motions in {markup(second)} and"
            f" are not compared; {len(found.changed)} of them differ by more than rounding, so they"
            " ask a different question:"
            f" {markup(', '.join(found.remade[:8]))}{', ...' if len(found.remade) > 8 else ''}",
            highlight=False,
        )
    for title, frame in (
        ("Labels that moved: the truth of the two runs differs.", found.labels),
        ("Answers that moved.", found.answers),
    ):
        if len(frame):
            print_grid(
                title,
                frame.columns,
                list(frame.head(show).itertuples(index=False)),
                f"{min(show, len(frame))} of {len(frame)}.",
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
            "Accuracy that moved, over the cases of both runs.",
            ("question", "method", *(c.replace("_", " ") for c in pairs)),
            rows,
            "before -> after.",
        )
    if len(found.times):
        print_grid(
            "Time, second run over first.",
            found.times.columns,
            [
                (r.question, r.method, f"{r.ratio:.3g}", f"{r.low:.3g}", f"{r.high:.3g}", r.pairs)
                for r in found.times.itertuples()
            ],
            "Median of the gross ratios case by case, 95 % bootstrap interval. Two runs are two"
            " states of the machine: read it against the methods that did not change.",
        )
    console.print(
        f"Accuracy is {'identical' if found.identical else 'NOT identical'}: {len(found.answers)}"
        f" of {found.compared} answers moved, {len(found.labels)} "
        f"labels moved{'' if found.same_content else '; the runs differ in their cases or methods'}"
        f"{f'; {len(found.changed)} cases ask a different question' if found.changed else ''}.",
        highlight=False,
    )
    if accept:
        reference(after, before)
        console.print(f"{markup(first)} is now the reference, made from {markup(second)}.")
        return
    raise typer.Exit(0 if found.identical else 1)


def _moved(before, after) -> str:
    return f"{before}" if before == after else f"{before} -> {after}"
