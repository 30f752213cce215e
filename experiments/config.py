"""What a run consists of: read from a preset or a TOML file, checked field by field."""

from __future__ import annotations

import difflib
import tomllib
from pathlib import Path

from pydantic import BaseModel, ConfigDict, Field, ValidationError

PRESETS = Path(__file__).parent / "presets"


class ConfigError(ValueError):
    """A configuration that cannot be run; the message names the file, the field and the remedy."""


class _Strict(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class ScenarioChoice(_Strict):
    """One family of cases: how many at each of which levels of difficulty (all of them if none are named)."""

    name: str
    cases: int = Field(ge=1, description="cases at each level")
    levels: tuple[float, ...] | None = None


class TimingChoice(_Strict):
    """How time is measured; `cases` 0 leaves it out."""

    cases: int = Field(default=24, ge=0, description="cases timed in each bin of question, size and situation")
    rounds: int = Field(default=9, ge=3, description="how often each case is timed by each method")
    warmup: int = Field(default=2, ge=0, description="rounds thrown away first")
    reference: str = Field(default="", description="method that ratios are taken to [the run's first]")


class RunConfig(_Strict):
    """methods: specifications such as "ofg k=4,8,16": a name, then parameters, several values each."""

    about: str = ""
    seed: int = Field(ge=0)
    methods: tuple[str, ...] = Field(min_length=1)
    scenarios: tuple[ScenarioChoice, ...] = Field(min_length=1)
    timing: TimingChoice = TimingChoice()
    method_files: tuple[str, ...] = Field(default=(), description="Python files with METHODS = [...] of your own")
    scenario_files: tuple[str, ...] = Field(default=(), description="Python files with SCENARIO = ... of your own")
    build_seconds: float = Field(default=300.0, gt=0, description="limit for preparing one query (convex decomposition can take minutes)")
    query_seconds: float = Field(default=10.0, gt=0, description="limit for one query, after which it counts as timeout")
    label_seconds: float = Field(default=30.0, gt=0, description="limit for one label, after which it counts as uncertain")


def presets() -> list[str]:
    return sorted(p.stem for p in PRESETS.glob("*.toml"))


def load(source: str) -> RunConfig:
    """A preset's name, or the path of a TOML file. Raises ConfigError."""
    path = Path(source)
    if path.suffix != ".toml":
        path = PRESETS / f"{source}.toml"
        if not path.is_file():
            raise ConfigError(f"There is no preset '{source}'{closest(source, presets())}. The presets are "
                              f"{', '.join(presets())}; a configuration of your own is a path that ends in .toml.")
    if not path.is_file():
        raise ConfigError(f"The configuration file {path} does not exist. Copy one of the presets "
                          "(ofg-bench preset quick > mine.toml) and start from there.")
    try:
        return RunConfig.model_validate(tomllib.loads(path.read_text()))
    except tomllib.TOMLDecodeError as error:
        raise ConfigError(f"The configuration file {path} is not valid TOML: {error}.") from error
    except ValidationError as error:
        raise ConfigError(f"The configuration file {path} has {error.error_count()} wrong field(s): " + "; ".join(
            f"{'.'.join(map(str, e['loc']))}: {e['msg'][:1].lower()}{e['msg'][1:]}" for e in error.errors()) + ".") from error


def load_files(config: RunConfig) -> None:
    """Make the methods and scenarios of the configuration's own files known to this process."""
    from baselines import registry

    from . import scenarios

    for path in config.method_files:
        registry.load_file(path)
    for path in config.scenario_files:
        scenarios.load_file(path)


def closest(word: str, words) -> str:
    """', did you mean ...?' or nothing."""
    near = difflib.get_close_matches(word, list(words), n=3, cutoff=0.5)
    return f" (did you mean {' or '.join(near)}?)" if near else ""
