# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Arguments and options shared by several commands."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from baselines import registry
from experiments.cases import families

Run = Annotated[Path, typer.Argument(metavar="RUN", help="folder of the run")]
Workers = Annotated[
    int | None,
    typer.Option(
        min=1, max=256, help="processes for every stage except timing [default: one per core]"
    ),
]
SkipMissing = Annotated[
    bool, typer.Option("--skip-missing", help="leave the rows of missing engines empty")
]
Trust = Annotated[
    bool,
    typer.Option(
        "--trust", help="execute the Python files of methods and scenarios that the run names"
    ),
]
Methods = Annotated[
    list[Path] | None,
    typer.Option(
        "--methods", help="Python file with your own methods (METHODS = [...]); may be repeated"
    ),
]
Scenarios = Annotated[
    list[Path] | None,
    typer.Option(
        "--scenarios",
        help="Python file with your own scenario (SCENARIO = ...); may be repeated",
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
