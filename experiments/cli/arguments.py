"""Arguments and options that several commands share."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from baselines import registry
from experiments.cases import families

Run = Annotated[Path, typer.Argument(help="folder of a run")]
Workers = Annotated[
    int | None,
    typer.Option(min=1, max=256, help="processes for all but the timing [default: one per core]"),
]
SkipMissing = Annotated[
    bool, typer.Option("--skip-missing", help="leave rows of engines that are not installed empty")
]
Trust = Annotated[
    bool,
    typer.Option(
        "--trust", help="run the Python files that the run names as its own methods and scenarios"
    ),
]
Methods = Annotated[
    list[Path] | None,
    typer.Option(
        "--methods", help="Python file with methods of your own (METHODS = [...]); may be repeated"
    ),
]
Scenarios = Annotated[
    list[Path] | None,
    typer.Option(
        "--scenarios",
        help="Python file with scenarios of your own (SCENARIO = ...); may be repeated",
    ),
]


def load_own(methods, scenario_files) -> None:
    for path in methods or ():
        registry.load_file(path)
    for path in scenario_files or ():
        families.load_file(path)


def named(source: str) -> str:
    return (
        f"The configuration file {source}"
        if source.endswith(".toml")
        else f"The configuration '{source}'"
    )
