# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The contract of a method: it prepares a query (the build, timed separately) and answers it
(timed).
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import isnan, nan
from typing import Any, ClassVar

import numpy as np

from ofg import Query

from .errors import MissingEngine, Unsupported
from .frames import stated
from .parameter import Allowed, fault
from .tolerance import NONE, Tolerance

__all__ = ["Method", "MissingEngine", "Tolerance", "Unsupported", "Verdict", "checked"]


@dataclass(frozen=True, slots=True)
class Verdict:
    """hit: whether the method reports a collision. time: its time of impact in [0, 1], NaN if it
    gives none.
    """

    hit: bool
    time: float = nan


def checked(said: object) -> Verdict:
    """What a method returned, with a plain bool and a plain float.

    Raises TypeError or ValueError, with a message for its row, if it is not a valid answer.
    """
    if not isinstance(said, Verdict):
        kind = type(said).__name__
        raise TypeError(f"returned {kind}, not a Verdict (of baselines.contract)")
    hit, time = said.hit, said.time
    if not isinstance(hit, (bool, np.bool_)) and not (isinstance(hit, int) and hit in (0, 1)):
        raise TypeError(f"hit is of type {type(hit).__name__}, neither True nor False")
    if isinstance(time, bool) or not isinstance(time, (int, float, np.integer, np.floating)):
        raise TypeError(f"time of impact is of type {type(time).__name__}, not a number")
    time = float(time)
    if not isnan(time) and not 0 <= time <= 1:
        raise ValueError(f"time of impact {time!r} is outside the step [0, 1]")
    return Verdict(bool(hit), time if hit else nan)


class Method(ABC):
    """One engine in one configuration. Subclass it in a file of `baselines/`; class attributes
    declare its properties.

    A subclass is instantiated once per worker process and answers many queries; it may cache what
    it builds per body (`Body.digest`). Instantiation imports no engine and checks the parameters,
    so that a run is refused before it begins: by `allowed`, or with a ValueError from the
    subclass's own `__init__`. Work that a user would do once per pair of bodies belongs in
    `prepare`; work for each new pose belongs in the callable that `prepare` returns, which is
    timed.
    """

    name: ClassVar[str]  #: unique, lower case, as in the tables: "fcl-convex"
    engine: ClassVar[str]  #: distribution whose version the manifest records: "python-fcl"
    imports: ClassVar[str]  #: module that must import: "fcl"
    #: "default" (what the documentation shows a newcomer), "best effort", "alternative", "article"
    configuration: ClassVar[str]
    questions: ClassVar[frozenset[str]]  #: subset of ofg.QUESTIONS
    bodies: ClassVar[frozenset[str]]  #: subset of {"convex", "union", "mesh"}
    #: the bodies whose sweeps it answers, if these are fewer
    swept: ClassVar[frozenset[str] | None] = None
    solid: ClassVar[bool]  #: False: tests surfaces, so it does not detect a contained body
    #: 1: `prepare` gets queries in which only A moves (frames.one_mover). 2: it also reads motion_b
    movers: ClassVar[int] = 1
    #: True: it reads Motion.about. False: a body that rotates about a point gets that point as its
    #: origin
    about: ClassVar[bool] = False
    #: True: it answers for the convex pieces of a mesh (ofg.decompose) and is judged by their
    #: truth; may be a property
    decomposes: bool = False
    gives_time: ClassVar[bool] = False  #: returns a time of impact for sweeps
    tolerance: Tolerance = (
        NONE  #: documented error of an answer as a distance from the truth; may be a property
    )
    precision: str = "double"  #: "single" if the engine computes or stores bodies in float32
    guarantee: ClassVar[str]  #: one line: what the documentation guarantees of an answer
    time_error: float = (
        nan  #: documented bound on |time - true time|, as a share of the step; may be a property
    )
    #: class of the method whose cheapest call gives the floor of this one, if its own cheapest call
    #: never reaches the engine; None: itself
    floored: ClassVar[type[Method] | None] = None
    #: False: the engine may answer the same query differently another time, so no answer of it
    #: proves a change
    repeatable: ClassVar[bool] = True
    cheapest: ClassVar[
        Mapping[str, Any]
    ] = {}  #: parameters of its cheapest call, which gives its floor: {"n": 1} for n substeps
    parameters: Mapping[
        str, Any
    ] = {}  #: name -> default; the first is the parameter of its accuracy-speed curve
    #: name -> (least, most) of a number, or the allowed strings; others allow all values of their
    #: type
    allowed: ClassVar[Mapping[str, Allowed]] = {}
    #: whole-number parameters that also allow "inf"
    unlimited: ClassVar[frozenset[str]] = frozenset()

    def __init__(self, **parameters: Any) -> None:
        unknown = sorted(set(parameters) - set(self.parameters))
        if unknown:
            known = ", ".join(self.parameters) or "none"
            raise ValueError(
                f"Method '{self.name}' has no parameter {', '.join(unknown)}; it has: {known}."
            )
        for name, value in parameters.items():
            unlimited = name in self.unlimited
            if wrong := fault(value, self.parameters[name], self.allowed.get(name), unlimited):
                raise ValueError(f"Method '{self.name}': {name} = {value} {wrong}.")
        self.parameters = {**self.parameters, **parameters}

    def floor(self) -> Method:
        """The method whose call on the easiest query is the floor of this one's times."""
        cls = self.floored or type(self)
        return cls(**{**self.parameters, **self.cheapest})

    @property
    def label(self) -> str:
        """The name, the first parameter, and the others that differ from their defaults: 'ofg
        k=8'. `registry.make` parses it.
        """
        defaults = type(self).parameters
        shown = {
            k: v for i, (k, v) in enumerate(self.parameters.items()) if i == 0 or v != defaults[k]
        }
        return " ".join([self.name, *(f"{k}={v}" for k, v in shown.items())])

    def kinds(self, question: str) -> frozenset[str]:
        """The kinds of bodies that it declares for a question."""
        return self.bodies if question == "overlap" or self.swept is None else self.swept

    def ready(self, query: Query) -> Callable[[], Verdict]:
        """The callable that answers `query`. A harness calls this, not `prepare`.

        It converts the motions to the form that the method declares, so that none is ignored.
        Raises Unsupported with a reason.
        """
        self._refuse_undeclared(query)
        return self.prepare(stated(query, self.movers, self.about))

    def refuse(self, query: Query) -> None:
        """Raise Unsupported if the declaration excludes the query."""
        self._refuse_undeclared(query)
        if stated(query, self.movers, self.about) is not query:
            raise Unsupported(
                "it does not support motions in this form; call `ready` instead of `prepare`"
            )

    def _refuse_undeclared(self, query: Query) -> None:
        if query.question not in self.questions:
            raise Unsupported(f"does not answer {query.question}")
        for body in (query.a, query.b):
            if body.kind not in self.kinds(query.question):
                raise Unsupported(f"does not support {body.kind} bodies")

    @abstractmethod
    def prepare(self, query: Query) -> Callable[[], Verdict]:
        """Build for `query` and return the callable that answers it. Raises Unsupported with a
        reason.

        Called by `ready`, with the motions in the form that `movers` and `about` declare.
        """
