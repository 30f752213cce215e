# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Run a configuration, resume a run, reproduce all experiments."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from experiments.cli.arguments import Methods, Run, Scenarios, SkipMissing, Workers, named
from experiments.cli.screen import console, print_table
from experiments.run import config as configuration
from experiments.run.folder.given import markup
from experiments.run.folder.store import Store

from .publish import findings


def run(
    source: Annotated[
        str,
        typer.Argument(
            metavar="CONFIG", help="name of a preset or experiment, or path of a .toml file"
        ),
    ],
    out: Annotated[
        Path | None, typer.Option(help="folder of the run [default: results/runs/CONFIG]")
    ] = None,
    workers: Workers = None,
    seed: Annotated[
        int | None,
        typer.Option(
            min=0, max=configuration.MOST_SEED, help="seed to use instead of the configuration's"
        ),
    ] = None,
    skip_missing: SkipMissing = False,
    methods: Methods = None,
    scenarios_: Scenarios = None,
) -> None:
    """Run a configuration and print its tables. Run the command again to resume after an
    interruption.
    """
    from experiments.cli import entries

    chosen = configuration.load(source)
    changes = {
        "seed": chosen.seed if seed is None else seed,
        "method_files": chosen.method_files + tuple(map(str, methods or ())),
        "scenario_files": chosen.scenario_files + tuple(map(str, scenarios_ or ())),
    }
    chosen = chosen.model_copy(update=changes)
    entries.check(chosen, named(source))
    _run(chosen, out or Path("results", "runs", Path(source).stem), workers, skip_missing)


def reproduce(
    names: Annotated[
        list[str] | None,
        typer.Argument(
            help=(
                "names of experiments and presets [default: every experiment of the catalogue, then"
                " standard]"
            )
        ),
    ] = None,
    into: Annotated[Path, typer.Option(help="folder for the run folders")] = Path("results"),
    workers: Workers = None,
) -> None:
    """Run experiments one after another, each in its own folder, rebuild all tables, figures and
    reports, and write the findings.

    Finished runs are not repeated; to repeat one, remove its folder. Run the command again to
    resume after an interruption.
    """
    from experiments.cli import entries, runner

    everything = not names
    names = names or [*configuration.experiments(), "standard"]
    chosen = {name: configuration.load(name) for name in names}
    for name, config in chosen.items():
        entries.check(config, named(name))
    for i, (name, config) in enumerate(chosen.items(), 1):
        console.print(
            f"[bold]{i} of {len(names)}: {name}[/] {markup(config.title)}", highlight=False
        )
        _say_missing(config)
        runner.run(config, into / name, workers)
    if everything:
        from experiments.studies import sizes

        console.print("[bold]sizes[/]: misses and operations by size, depth and k", highlight=False)
        sizes.run(into / "sizes")
    findings(into, into / "README.md")
    findings(into, objections=into / "OBJECTIONS.md")
    console.print(
        f"{markup(into)} contains the tables, figures, report.html, manifest.json and rows of each"
        " run."
    )


def resume(run_: Run, workers: Workers = None, skip_missing: SkipMissing = False) -> None:
    """Finish an interrupted run. The result is the same as without the interruption."""
    from experiments.cli import entries

    config = Store(run_).config
    entries.check(config, f"The configuration {run_ / 'config.json'}")
    _run(config, run_, workers, skip_missing)


def _run(
    config: configuration.RunConfig, folder: Path, workers: int | None, skip_missing: bool
) -> None:
    from experiments.cli import runner
    from experiments.run import silence

    _say_missing(config)
    made = runner.run(config, folder, workers, skip_missing)
    for table in made:
        if table.headline:
            print_table(table)
    if others := ", ".join(table.name for table in made if not table.headline):
        console.print(
            f"{len(made)} tables were written; not printed here: {others}. Print one with:"
            f" ofg-bench tables {markup(folder)} --only NAME\n"
        )
    if config.stepping:
        console.print(
            f"Tables (CSV, Markdown, LaTeX) are in {markup(folder / 'tables')}, and all counts are"
            f" in {markup(folder / 'stepping.parquet')}."
        )
    else:
        console.print(
            f"Tables (CSV, Markdown, LaTeX) are in {markup(folder / 'tables')}, figures (SVG, PNG)"
            f" in {markup(folder / 'figures')}; every case with its certificate in"
            f" {markup(folder / 'cases.parquet')}, every answer in"
            f" {markup(folder / 'observations.parquet')}."
        )
        for warning in silence.warnings(Store(folder)):
            Console(stderr=True, width=console.width).print(
                f"[yellow]{markup(warning)}[/]", highlight=False
            )


def _say_missing(config: configuration.RunConfig) -> None:
    from experiments.cli import runner

    configuration.load_files(config)
    for reason in runner.missing(config.optional_methods):
        console.print(f"These rows stay empty: {markup(reason)}", highlight=False)
