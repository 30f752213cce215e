# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""List the scenarios, methods, experiments and presets."""

from __future__ import annotations

from typing import Annotated

import typer

from baselines import registry
from experiments.cases import families
from experiments.cli.arguments import Methods, Scenarios, load_own
from experiments.cli.screen import console, print_grid
from experiments.run import config as configuration


def list_(methods: Methods = None, scenarios_: Scenarios = None) -> None:
    """List scenarios, methods, experiments and presets.

    For each method, the list shows the questions that it answers and whether its engine is
    installed.
    """
    load_own(methods, scenarios_)
    print_grid(
        "Scenarios",
        ("name", "question", "precision", "difficulty", "levels", "exposes"),
        [
            (s.name, s.question, s.precision, s.axis, _levels(s.levels), s.exposes)
            for s in families.scenarios().values()
        ],
    )
    heads = (
        "name",
        "configuration",
        "questions",
        "bodies",
        "tests",
        "precision",
        "parameters",
        "engine",
    )
    print_grid(
        "Methods",
        heads,
        [
            (
                m.name,
                m.configuration,
                " ".join(q[0] for q in ("overlap", "translation", "motion") if q in m.questions),
                ", ".join(sorted(m.bodies)),
                "solid" if m.solid else "surface",
                m.precision,
                " ".join(f"{k}={v}" for k, v in m.parameters.items()),
                "not installed" if registry.available(m) else m.engine,
            )
            for m in registry.methods().values()
        ],
    )
    console.print(
        "Questions: [b]o[/b]verlap at fixed poses, [b]t[/b]ranslation, [b]m[/b]otion (translation"
        " and rotation)."
    )
    console.print()
    experiments = {name: configuration.load(name) for name in configuration.experiments()}
    print_grid(
        "Experiments",
        ("name", "title", "purpose"),
        [(name, c.title, c.about) for name, c in experiments.items()],
    )
    print_grid(
        "Presets",
        ("name", "purpose"),
        [(name, configuration.load(name).about) for name in configuration.presets()],
        "Run one with: ofg-bench run NAME. Copy its configuration to a file with: ofg-bench preset"
        " NAME > mine.toml",
    )


def preset(name: Annotated[str, typer.Argument(help="name of a preset or experiment")]) -> None:
    """Print the configuration of a preset or experiment, as a start for your own.

    For example: ofg-bench preset quick > mine.toml
    """
    configuration.load(name)
    print(configuration.path_of(name).read_text(), end="")


def _levels(levels) -> str:
    shown = [f"{v:g}" for v in levels]
    return ", ".join(shown) if len(shown) < 9 else f"{shown[0]} .. {shown[-1]} ({len(shown)})"
