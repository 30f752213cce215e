# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The configuration of a run: read from a preset or a TOML file, and validated field by field."""

from __future__ import annotations

import difflib
import tomllib
from collections.abc import Iterable
from functools import cache
from importlib.metadata import entry_points
from pathlib import Path
from typing import Any, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator

from .folder import given

PRESETS = Path(__file__).parents[1] / "presets"
CATALOGUE = Path(__file__).parents[1] / "catalogue"
LONGEST = 1e6  # seconds, of a limit: eleven days; the watchdog supports at most some hundred years
MOST_BYTES = 1_000_000  #: of a configuration
MOST_CASES, MOST_SEED = 10**6, 2**63 - 1
# entry points of installed packages that provide experiments: the path of a .toml file, or of a
# folder of them
GROUP = "ofg.experiments"


class ConfigError(ValueError):
    """An invalid configuration; the message names the file, the field and the remedy."""


class _Strict(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, str_max_length=4000, allow_inf_nan=False)


class ScenarioChoice(_Strict):
    """One family of cases: the number of cases at each level, and the levels of difficulty (all
    if none are given).
    """

    name: str
    cases: int = Field(ge=1, le=MOST_CASES, description="cases at each level")
    levels: tuple[float, ...] | None = None


class TimingChoice(_Strict):
    """How time is measured; with `cases` = 0 it is not."""

    cases: int = Field(
        default=24,
        ge=0,
        le=MOST_CASES,
        description="cases timed in each bin of question, size and situation",
    )
    rounds: int = Field(
        default=9, ge=3, le=MOST_CASES, description="how often each method is timed on each case"
    )
    warmup: int = Field(
        default=2, ge=0, le=MOST_CASES, description="number of warm-up rounds, which are discarded"
    )
    seconds: float = Field(
        default=4.0,
        gt=0,
        description=("time limit per bin; a slower method takes part in fewer rounds, at least 3"),
    )
    reference: str = Field(default="", description="method to which ratios refer [the run's first]")


Value = Literal[
    "misses",
    "false alarms",
    "wrong",
    "beyond",
    "tunnelled",
    "answered",
    "time error",
    "latest",
    "earliest",
    "net time",
    "gross time",
    "build time",
    "ratio",
]


class TableChoice(_Strict):
    """A table specific to an experiment: a row per method, a column per value of `columns`,
    `value` in the cells.
    """

    name: str = Field(
        pattern=r"^[a-z0-9][a-z0-9-]*$",
        max_length=100,
        description="its files are tables/NAME.csv, .md and .tex",
    )
    title: str
    note: str = ""
    value: Value
    columns: str = Field(
        default="level",
        description=(
            "level, scenario, question, situation, faces (ranges), band (signed gap over size), or"
            " a tag of the scenarios"
        ),
    )
    scenarios: tuple[str, ...] = Field(
        default=(), description="restrict to cases of these scenarios [all]"
    )
    question: str = Field(default="", description="restrict to cases of this question [all]")
    situation: Literal["", "deep", "near", "apart", "hit", "clear"] = Field(
        default="",
        description=(
            "restrict to cases of this situation; without it, a table of times is made for each "
            "situation"
        ),
    )
    headline: bool = Field(default=True, description="printed at the end of the run")


class SteppingChoice(_Strict):
    """The stepping track: engines as simulators, in scenes of experiments/studies/stepping
    instead of scenarios.
    """

    runs: int = Field(
        ge=1, le=MOST_CASES, description="runs for each cell, each with its own start phase"
    )
    scenes: tuple[str, ...] = Field(default=(), description="names of scenes [all]")
    travels: tuple[float, ...] = Field(
        default=(), description="thicknesses per step [those of the track]"
    )


class RunConfig(_Strict):
    """methods: specifications such as "ofg k=4,8,16": a name, then parameters, each with one or
    several values.

    optional_methods: the same, for engines that may be absent: the run then reports this and their
    rows are `unsupported`.
    """

    title: str = ""
    about: str = Field(
        default="", description="the question that the experiment answers, in a sentence"
    )
    seed: int = Field(ge=0, le=MOST_SEED)
    methods: tuple[str, ...] = ()
    optional_methods: tuple[str, ...] = ()
    scenarios: tuple[ScenarioChoice, ...] = ()
    stepping: SteppingChoice | None = None
    tables: tuple[TableChoice, ...] = ()
    timing: TimingChoice = TimingChoice()
    method_files: tuple[str, ...] = Field(
        default=(), description="your own Python files with METHODS = [...]"
    )
    scenario_files: tuple[str, ...] = Field(
        default=(), description="your own Python files with SCENARIO = ..."
    )
    build_seconds: float = Field(
        default=300.0,
        gt=0,
        le=LONGEST,
        description="limit for preparing one query (convex decomposition can take minutes)",
    )
    query_seconds: float = Field(
        default=10.0,
        gt=0,
        le=LONGEST,
        description="limit for one query, after which it counts as timeout",
    )
    label_seconds: float = Field(
        default=30.0,
        gt=0,
        le=LONGEST,
        description="limit for one label, after which it counts as uncertain",
    )

    @model_validator(mode="after")
    def _something_to_do(self) -> Self:
        if not self.stepping:
            for field in ("methods", "scenarios"):
                if not getattr(self, field):
                    raise ValueError(f"{field} needs at least 1 entry")
        return self

    @property
    def asked(self) -> tuple[str, ...]:
        """All specifications, the optional ones last."""
        return self.methods + self.optional_methods

    def differences(self, other: RunConfig) -> list[str]:
        """Fields that make the rows of two runs differ; descriptive texts and tables are not
        among them.
        """
        return [
            k
            for k, v in self.model_dump(exclude={"title", "about", "tables"}).items()
            if v != other.model_dump()[k]
        ]


def presets() -> list[str]:
    return sorted(p.stem for p in PRESETS.glob("*.toml"))


@cache
def experiments() -> dict[str, Path]:
    """name -> file of every experiment: those of the catalogue, then those of installed packages.
    Raises ConfigError.
    """
    found = {p.stem: p for p in sorted(CATALOGUE.glob("*.toml"))}
    for entry in entry_points(group=GROUP):
        try:
            path = Path(entry.load())
        except Exception as error:
            raise ConfigError(
                f"The entry point '{entry.name}' of the group {GROUP} cannot be loaded "
                f"({type(error).__name__}: {error}). It must name an object that is the path of a "
                ".toml file or of a folder; repair or uninstall its package."
            ) from error
        for file in sorted(path.glob("*.toml")) if path.is_dir() else [path]:
            if file.stem in found or file.stem in presets():
                raise ConfigError(
                    f"The entry point '{entry.name}' of the group {GROUP} provides an experiment "
                    f"'{file.stem}', a name that is taken; rename its file."
                )
            found[file.stem] = file
    return found


def path_of(source: str) -> Path:
    """The file of a preset or experiment by name, or of a TOML file by its path. Raises
    ConfigError.
    """
    if Path(source).suffix == ".toml":
        return Path(source)
    known = {**experiments(), **{name: PRESETS / f"{name}.toml" for name in presets()}}
    if source not in known:
        raise ConfigError(
            f"There is no preset or experiment '{source}'{closest(source, known)}. The presets "
            f"are {', '.join(presets())}; the experiments are {', '.join(experiments())}; give a "
            "configuration of your own as a path that ends in .toml."
        )
    return known[source]


def load(source: str) -> RunConfig:
    """Load a configuration by the name of a preset or an experiment, or by the path of a TOML
    file. Raises ConfigError.
    """
    path = path_of(source)
    if not path.exists():
        raise ConfigError(
            f"The configuration file {given.shown(path)} does not exist. Copy one of the presets "
            "(ofg-bench preset quick > mine.toml) and start from there."
        )
    what = "The configuration file"
    text = given.text(path, what, MOST_BYTES)
    try:
        return parsed(tomllib.loads(text), path, what)
    except tomllib.TOMLDecodeError as error:
        raise ConfigError(f"{what} {path} is not valid TOML: {given.reason(error)}.") from error
    except RecursionError as error:
        raise ConfigError(f"{what} {path} is nested too deeply to be read.") from error
    except ConfigError:
        raise
    except ValueError as error:  # a whole number of thousands of digits
        raise ConfigError(
            f"{what} {path} contains a number that cannot be read: {given.reason(error)}."
        ) from error


def parsed(content: dict[str, Any] | str, path: Path, what: str = "The file") -> RunConfig:
    """The configuration in a table, or in the text of a JSON file. ConfigError, which names the
    file and the fields.
    """
    try:
        return (
            RunConfig.model_validate_json(content)
            if isinstance(content, str)
            else RunConfig.model_validate(content)
        )
    except ValidationError as error:
        raise ConfigError(
            f"{what} {path} has {error.error_count()} invalid field(s): "
            f"{given.clipped(_wrong(error), 1000)}."
        ) from error


def _wrong(error: ValidationError) -> str:
    said = []
    for e in error.errors(include_url=False, include_context=False, include_input=False)[:10]:
        where = given.shown(".".join(map(str, e["loc"])))
        said.append(f"{where}: " * bool(where) + given.shown(e["msg"][:1].lower() + e["msg"][1:]))
    return "; ".join(said)


def load_files(config: RunConfig) -> None:
    """Load the configuration's own files of methods and scenarios into this process."""
    from baselines import registry
    from experiments.cases import families

    for path in config.method_files:
        registry.load_file(path)
    for path in config.scenario_files:
        families.load_file(path)


def closest(word: str, words: Iterable[str]) -> str:
    """', did you mean ...?' or an empty string."""
    near = difflib.get_close_matches(word, list(words), n=3, cutoff=0.5)
    return f" (did you mean {' or '.join(near)}?)" if near else ""
