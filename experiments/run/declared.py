# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The declarations of a run's own methods and scenarios, recorded so that the run can be read
without running their files.
"""

from __future__ import annotations

from dataclasses import asdict
from typing import Literal, NoReturn

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from baselines import registry
from baselines.contract import Method, Unsupported
from baselines.label import name_of
from baselines.tolerance import NONE, Tolerance
from experiments.cases import families
from experiments.cases.scenario import Scenario
from ofg import Query

from .config import RunConfig
from .folder.store import Store, StoreError

MODULE = (  # resembles the module of a method file, which may replace it
    "baselines_file_recorded"
)
Question = Literal["overlap", "translation", "motion"]


class _Recorded(BaseModel):
    model_config = ConfigDict(extra="forbid", allow_inf_nan=False, str_max_length=1000)


class ToleranceFacts(_Recorded):
    """The fields of baselines.tolerance.Tolerance."""

    length: float = Field(ge=0)
    relative: float = Field(ge=0)
    step: float = Field(ge=0)
    sides: Literal["both", "alarms", "misses"]


class MethodFacts(_Recorded):
    """Class attributes of a Method that tables and pages show or compute with."""

    engine: str
    configuration: str
    questions: list[Question]
    bodies: list[Literal["convex", "mesh", "union"]]
    solid: bool
    tolerance: ToleranceFacts
    precision: Literal["double", "single"]
    decomposes: bool = False  # absent from manifests of older runs
    guarantee: str
    parameters: dict[str, bool | int | float | str]


class ScenarioFacts(_Recorded):
    question: Question
    exposes: str
    axis: str
    levels: list[float]


class Declared(_Recorded):
    """Part of manifest.json: by name, the methods and scenarios that are not part of this
    project.
    """

    methods: dict[str, MethodFacts] = {}
    scenarios: dict[str, ScenarioFacts] = {}


def of(config: RunConfig) -> dict[str, object]:
    """The record of a run's own methods and scenarios, which are already loaded; {} if it has
    none.
    """
    classes = {name: registry.methods()[name] for name in map(name_of, config.asked)}
    own = {
        name: cls for name, cls in classes.items() if not cls.__module__.startswith("baselines.")
    }
    drawn = [families.get(c.name) for c in config.scenarios if c.name not in families.own_modules()]
    if not own and not drawn:
        return {}
    made = {
        "methods": {name: _method(cls) for name, cls in own.items()},
        "scenarios": {
            s.name: ScenarioFacts.model_validate(
                {
                    "question": s.question,
                    "exposes": s.exposes,
                    "axis": s.axis,
                    "levels": [float(v) for v in s.levels],
                }
            )
            for s in drawn
        },
    }
    return {"declared": Declared.model_validate(made).model_dump()}


def _method(cls: type[Method]) -> MethodFacts:
    said = {name: getattr(cls, name) for name in MethodFacts.model_fields}
    said.update(
        questions=sorted(cls.questions),
        bodies=sorted(cls.bodies),
        tolerance=_tolerance(cls),
        parameters=dict(cls.parameters),
    )
    if not isinstance(said["precision"], str):  # a property that depends on its parameters
        said["precision"] = "double"
    said["decomposes"] = said["decomposes"] is True  # False for a property too
    return MethodFacts.model_validate(said)


def _tolerance(cls: type[Method]) -> dict[str, object]:
    """The value set in the class; none if it depends on the parameters."""
    return asdict(cls.tolerance if isinstance(cls.tolerance, Tolerance) else NONE)


def know(store: Store) -> list[str]:
    """Register the recorded methods and scenarios of a run without running any of its code.

    Returns notices: the files that are not run, and the methods without a record.
    """
    config = store.config
    try:
        said = Declared.model_validate(store.facts.get("declared", {}))
    except ValidationError as error:
        raise StoreError(
            f"{store.folder / 'manifest.json'} declares methods or scenarios in a form that "
            f"cannot be read: {error.error_count()} invalid field(s) in 'declared'. Copy the run "
            "again from its source."
        ) from error
    known = registry.methods()
    for name, facts in said.methods.items():
        if name not in known or known[name].__module__ == MODULE:
            known[name] = _stand_in(name, facts)
    for name, drawn in said.scenarios.items():
        if name not in families.own_modules():
            families.scenarios().setdefault(
                name,
                Scenario(name, drawn.question, drawn.exposes, drawn.axis, drawn.levels, _undrawn),
            )
    return _notices(config, known)


def _notices(config: RunConfig, known: dict[str, type[Method]]) -> list[str]:
    files = ", ".join((*config.method_files, *config.scenario_files))
    if not files:
        return []
    said = [f"The run names its own Python files ({files}); they are not run. --trust runs them."]
    unknown = dict.fromkeys(
        name for name in map(name_of, config.asked) if name and name not in known
    )
    said += [
        f"Method '{name}' is not known here; its declaration is unknown (its tolerance is "
        f"taken as none); pass --trust to load {files}."
        for name in unknown
    ]
    return said


def _stand_in(name: str, facts: MethodFacts) -> type[Method]:
    """A method with the recorded declaration that answers no queries."""
    said = facts.model_dump()
    said["tolerance"] = Tolerance(**said["tolerance"])
    said.update(
        name=name,
        imports="",
        questions=frozenset(facts.questions),
        bodies=frozenset(facts.bodies),
        prepare=_unasked,
        __module__=MODULE,
    )
    return type(name, (Method,), said)


def recorded(name: str) -> bool:
    """Whether a method is known only from its record."""
    return getattr(registry.methods().get(name), "__module__", "") == MODULE


def _unasked(self: Method, query: Query) -> NoReturn:
    raise Unsupported("its file is not loaded; pass --trust")


def _undrawn(rng: np.random.Generator, level: float) -> NoReturn:
    raise ValueError("its file is not loaded; pass --trust")
