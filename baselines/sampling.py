# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Discrete engines: one overlap test at a pose, and sweeps that test sampled poses."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable
from math import inf
from typing import Any, ClassVar

from ofg import Pose, Query

from .contract import Method, Verdict
from .frames import seen_from

#: pose of A (and of B, see `places_b`) -> the engine's own form, made before timing starts
Place = Callable[..., Any]
Test = Callable[[Any], bool]  #: output of `place` -> whether A and B overlap


class Discrete(Method):
    """An engine that answers `overlap` at one pose. Subclasses write `build`."""

    questions = frozenset({"overlap"})
    #: whether `place` takes B's pose as its second argument; it gets it if B moves. If not, B stays
    #: at query.pose_b, and A is placed in B's frame
    places_b: ClassVar[bool] = False

    @abstractmethod
    def build(self, query: Query) -> tuple[Place, Test]:
        """Both bodies in the engine's form, B at query.pose_b unless `place` gets another pose."""

    def prepare(self, query: Query) -> Callable[[], Verdict]:
        self.refuse(query)
        return self.asker(query, *self.build(query))

    def asker(self, query: Query, place: Place, test: Test) -> Callable[[], Verdict]:
        pose = place(query.pose_a)
        return lambda: Verdict(bool(test(pose)))

    def poses(self, query: Query, t: float) -> tuple[Pose, ...]:
        """The arguments of `place` for time t of the step."""
        pose_a = query.motion.pose_at(query.pose_a, t)
        if query.motion_b.rests:
            return (pose_a,)
        pose_b = query.motion_b.pose_at(query.pose_b, t)
        return (pose_a, pose_b) if self.places_b else (seen_from(pose_b, pose_a, query.pose_b),)


class Substeps(Discrete):
    """A sweep as users of a discrete engine run it: the overlap test at t = i/n for i = 1 .. n, up
    to the first hit.

    The start pose is not tested: in a stepping loop it was the end pose of the previous step. n = 1
    is the end pose only. The reported time is that of the first sampled hit, so it is late by up to
    1/n and never early. Put this class before the engine's Discrete one: `class
    BoxSubsteps(Substeps, Box)`.
    """

    questions = frozenset({"translation", "motion"})
    gives_time = True
    movers, about = 2, True
    parameters = {"n": 16}
    allowed = {"n": (1, inf)}
    cheapest = {"n": 1}

    @property
    def time_error(self) -> float:
        return 1 / self.parameters["n"]

    def asker(self, query: Query, place: Place, test: Test) -> Callable[[], Verdict]:
        n = self.parameters["n"]
        samples = [(i / n, place(*self.poses(query, i / n))) for i in range(1, n + 1)]

        def ask() -> Verdict:
            for time, pose in samples:
                if test(pose):
                    return Verdict(True, time)
            return Verdict(False)

        return ask
