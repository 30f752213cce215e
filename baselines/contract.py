"""What a method is: it prepares a query (build, timed apart) and answers it (timed)."""

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
    """hit: the method says that the bodies meet. time: its time of impact in [0, 1], NaN where it
    gives none.
    """

    hit: bool
    time: float = nan


def checked(said: object) -> Verdict:
    """What a method returned, with a plain bool and a plain float.

    Raises TypeError or ValueError, with words for its row, where it is no clear answer.
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
    declare what it is.

    A subclass is made once per worker process and asked many queries; it may cache what it builds
    per body (`Body.digest`). Making one imports no engine and checks its parameters, so that a run
    is refused before it begins: by `allowed`, or with a ValueError from an `__init__` of your own.
    Everything that a user would do once per body pair belongs in `prepare`; what he would do for
    each new pose belongs in the callable that `prepare` returns, and is timed.
    """

    name: ClassVar[str]  #: unique, lower case, as in the tables: "fcl-convex"
    engine: ClassVar[str]  #: distribution whose version the manifest records: "python-fcl"
    imports: ClassVar[str]  #: module that must import: "fcl"
    #: "default" (what the documentation shows a newcomer), "best effort", "alternative", "article"
    configuration: ClassVar[str]
    questions: ClassVar[frozenset[str]]  #: subset of ofg.QUESTIONS
    bodies: ClassVar[frozenset[str]]  #: subset of {"convex", "union", "mesh"}
    solid: ClassVar[bool]  #: False: tests surfaces, so a contained body is not seen
    #: 1: `prepare` gets queries in which A alone moves (frames.one_mover). 2: it reads motion_b too
    movers: ClassVar[int] = 1
    #: True: it reads Motion.about. False: a body that turns about a point gets that point as its
    #: origin
    about: ClassVar[bool] = False
    #: True: of a mesh it answers about the convex pieces of ofg.decompose, by whose truth it is
    #: judged; may be a property
    decomposes: bool = False
    gives_time: ClassVar[bool] = False  #: returns a time of impact for sweeps
    tolerance: Tolerance = (
        NONE  #: how far from the truth an answer may be by its documentation; may be a property
    )
    precision: str = "double"  #: "single" where the engine computes, or holds a body, in float32
    guarantee: ClassVar[str]  #: one line: what an answer is worth by its documentation
    time_error: float = (
        nan  #: documented bound on |time - true time|, as a share of the step; may be a property
    )
    #: False: its engine may answer the same question otherwise another time, so that no answer of
    #: it proves a change
    repeatable: ClassVar[bool] = True
    cheapest: ClassVar[
        Mapping[str, Any]
    ] = {}  #: parameters of its cheapest call, which gives its floor: {"n": 1} for n substeps
    parameters: Mapping[
        str, Any
    ] = {}  #: name -> default; the first is the one its accuracy-speed curve runs over
    #: name -> (least, most) of a number, or the words that it takes; others take all of their kind
    allowed: ClassVar[Mapping[str, Allowed]] = {}
    #: whole-number parameters that take "inf" too
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

    @property
    def label(self) -> str:
        """The name, the first parameter, and the others that differ from their defaults: 'ofg k=8'.
        `registry.make` reads it back.
        """
        defaults = type(self).parameters
        shown = {
            k: v for i, (k, v) in enumerate(self.parameters.items()) if i == 0 or v != defaults[k]
        }
        return " ".join([self.name, *(f"{k}={v}" for k, v in shown.items())])

    def ready(self, query: Query) -> Callable[[], Verdict]:
        """The callable that answers `query`: what a harness calls, and not `prepare`.

        It states the motions as the method declares to know them, so that none is left unread.
        Raises Unsupported with a reason.
        """
        self._refuse_undeclared(query)
        return self.prepare(stated(query, self.movers, self.about))

    def refuse(self, query: Query) -> None:
        """Raise Unsupported where the declaration rules the query out."""
        self._refuse_undeclared(query)
        if stated(query, self.movers, self.about) is not query:
            raise Unsupported("it does not know these motions as they stand; ask it by `ready`")

    def _refuse_undeclared(self, query: Query) -> None:
        if query.question not in self.questions:
            raise Unsupported(f"does not answer {query.question}")
        for body in (query.a, query.b):
            if body.kind not in self.bodies:
                raise Unsupported(f"takes no {body.kind} body")

    @abstractmethod
    def prepare(self, query: Query) -> Callable[[], Verdict]:
        """Build for `query` and return the callable that answers it. Raises Unsupported with a
        reason.

        Called by `ready`, with the motions as `movers` and `about` declare them.
        """
