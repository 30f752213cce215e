"""The entries of a configuration: each is known, has values that it takes, and is named once."""

from __future__ import annotations

from collections import Counter

from baselines import registry
from experiments.analysis import tables
from experiments.cases import families
from experiments.run.config import ConfigError, RunConfig, ScenarioChoice, closest, load_files
from experiments.studies.stepping import experiment as stepping


def check(config: RunConfig, where: str = "The configuration") -> None:
    """ConfigError, which begins with `where` and names the entry, for what cannot be run.

    No engine is imported, so that those that are not installed are checked as well; the
    configuration's own files are.
    """
    try:
        load_files(config)
        _check_methods(config)
        _check_scenarios(config.scenarios)
        tables.check(config)
        if config.stepping:
            stepping.check(config.stepping)
    except (Exception, SystemExit) as error:  # of a reader's own file, whatever it is
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
                        f"{here} names '{label}', which {found[label]} names too; keep one of them."
                    )
                found[label] = here
    reference = config.timing.reference
    if reference and reference not in found:
        raise ConfigError(
            f"timing.reference '{reference}' is no method of the run"
            f"{closest(reference, found)}; it has {', '.join(found)}."
        )


def _labels(spec: str, here: str) -> list[str]:
    """The labels that a specification stands for, each once."""
    try:
        labels = [method.label for method in registry.make(spec)]
    except Exception as error:
        raise ConfigError(f"{here}: {error}") from error
    _once(labels, f"{here} names")
    return labels


def _check_scenarios(choices: tuple[ScenarioChoice, ...]) -> None:
    """A scenario may be named again with other levels, say to draw fewer cases of the slow ones."""
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
