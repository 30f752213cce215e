"""What there is: scenarios, methods, experiments, presets."""

from __future__ import annotations

from typing import Annotated

import typer

from baselines import registry
from experiments.cases import families
from experiments.cli.arguments import Methods, Scenarios, load_own
from experiments.cli.screen import console, print_grid
from experiments.run import config as configuration


def list_(methods: Methods = None, scenarios_: Scenarios = None) -> None:
    """Show scenarios, methods (what each can answer, and whether its engine is installed),
    experiments and presets.
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
        "Questions: [b]o[/b]verlap at one pose pair, [b]t[/b]ranslation, [b]m[/b]otion (turning and"
        " translating)."
    )
    console.print()
    experiments = {name: configuration.load(name) for name in configuration.experiments()}
    print_grid(
        "Experiments",
        ("name", "title", "what it asks"),
        [(name, c.title, c.about) for name, c in experiments.items()],
    )
    print_grid(
        "Presets",
        ("name", "what it is"),
        [(name, configuration.load(name).about) for name in configuration.presets()],
        "Each experiment and each preset runs alone: ofg-bench run NAME. ofg-bench preset NAME >"
        " mine.toml gives a copy to change.",
    )


def preset(name: Annotated[str, typer.Argument(help="of a preset or an experiment")]) -> None:
    """Print the configuration of a preset or experiment, to be changed and run: ofg-bench preset
    quick > mine.toml
    """
    configuration.load(name)
    print(configuration.path_of(name).read_text(), end="")


def _levels(levels) -> str:
    shown = [f"{v:g}" for v in levels]
    return ", ".join(shown) if len(shown) < 9 else f"{shown[0]} .. {shown[-1]} ({len(shown)})"
