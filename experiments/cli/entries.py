# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Check that each entry of a configuration is known, has valid values and is named once."""

from __future__ import annotations

from collections import Counter

from baselines import registry
from experiments.analysis import tables
from experiments.cases import families
from experiments.run.config import ConfigError, RunConfig, ScenarioChoice, closest, load_files
from experiments.studies.stepping import experiment as stepping


def check(config: RunConfig, where: str = "The configuration") -> None:
    """Raise ConfigError for an entry that cannot be run; the message begins with `where`.

    Engines are not imported, so methods of engines that are not installed are checked as well. The
    method and scenario files that the configuration names are imported.
    """
    try:
        load_files(config)
        _check_methods(config)
        _check_scenarios(config.scenarios)
        tables.check(config)
        if config.stepping:
            stepping.check(config.stepping)
    except (Exception, SystemExit) as error:  # a user's own file may raise anything
        kind = "" if isinstance(error, ValueError) else f"{type(error).__name__}: "
        raise ConfigError(f"{where}: {kind}{error}") from error


def _check_methods(config: RunConfig) -> None:
    found: dict[str, str] = {}
    for field in ("methods", "optional_methods"):
        for i, spec in enumerate(getattr(config, field)):
            here = f"{field}.{i} '{spec}'"
            for label in _labels(spec, here):
                if label in found:
                    raise ConfigError(
                        f"{here} names '{label}', as does {found[label]}; keep only one of them."
                    )
                found[label] = here
    reference = config.timing.reference
    if reference and reference not in found:
        raise ConfigError(
            f"timing.reference '{reference}' is not a method of the run"
            f"{closest(reference, found)}; the methods are {', '.join(found)}."
        )


def _labels(spec: str, here: str) -> list[str]:
    """The labels of the methods that a specification creates; raises if one occurs twice."""
    try:
        labels = [method.label for method in registry.make(spec)]
    except Exception as error:
        raise ConfigError(f"{here}: {error}") from error
    _once(labels, f"{here} names")
    return labels


def _check_scenarios(choices: tuple[ScenarioChoice, ...]) -> None:
    """A scenario may be named twice with different levels, for example to draw fewer slow cases."""
    named: list[str] = []
    for i, choice in enumerate(choices):
        try:
            scenario = families.get(choice.name)
            for level in choice.levels or ():
                scenario.check_level(level)
        except ValueError as error:
            raise ConfigError(f"scenarios.{i}: {error}") from error
        named += [f"{choice.name} at level {level:g}" for level in choice.levels or scenario.levels]
    _once(named, "scenarios names")


def _once(names: list[str], where: str) -> None:
    twice = [name for name, times in Counter(names).items() if times > 1]
    if twice:
        raise ConfigError(f"{where} '{twice[0]}' more than once; name it once.")
