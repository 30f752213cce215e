# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""A scenario: a family of cases along one axis of difficulty."""

from __future__ import annotations

import zlib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ofg import Body, BodyError, Motion, Pose, Query

from .case import Case
from .label import Truth

PRECISIONS = ("float32", "float64")
USELESS = ("start-overlap", "hit", "clear", "uncertain", "touching")  #: allowed values of redraw_if


class ScenarioError(ValueError):
    """A scenario drew an invalid case. The message names the scenario, the level and the draw."""


@dataclass(frozen=True)
class Draft:
    """The output of a scenario's `generate`: two bodies, two poses, A's motion, tags by which to
    split tables, and B's motion.
    """

    a: Body
    b: Body
    pose_a: Pose
    pose_b: Pose
    motion: Motion = Motion()
    tags: Mapping[str, str | float] = None
    motion_b: Motion = Motion()


@dataclass(frozen=True)
class Scenario:
    """Each file in `experiments/cases/families/` contains one scenario, named SCENARIO.

    name: as in the tables. question: of its queries. exposes: one line, the weakness that it
    reveals. axis: the measure of difficulty, with its unit. levels: its values, easy to hard.
    generate(rng, level) -> Draft: aims at the difficulty; the label comes from the certificate and
    never from the aim. precision: "float64": a case is what `generate` drew, number for number;
    engines in single precision then get bodies that they cannot represent, and the tables mark
    them. "float32": poses, motions and vertices are first rounded to float32, so that all engines
    get the same query. redraw_if: conditions under which a case is rejected and drawn again (at
    most 50 times; the rejected draws are counted): any of "start-overlap" (a sweep that begins in
    overlap), "hit", "clear", "uncertain", "touching" (clear, but the surfaces share a point).
    Raises ValueError for another precision, or another string in redraw_if.
    """

    name: str
    question: str
    exposes: str
    axis: str
    levels: Sequence[float]
    generate: Callable[[np.random.Generator, float], Draft]
    redraw_if: Sequence[str] = ()
    precision: str = "float64"

    def __post_init__(self):
        if self.precision not in PRECISIONS:
            raise ValueError(
                f"Scenario '{self.name}' has the precision '{self.precision}'; "
                f"it must be one of {', '.join(PRECISIONS)}."
            )
        wrong = sorted(set(self.redraw_if) - set(USELESS))
        if wrong:
            raise ValueError(
                f"Scenario '{self.name}' has redraw_if with {', '.join(wrong)}; redraw_if accepts "
                f"{', '.join(USELESS)}."
            )

    def case(self, seed: int, level: float, index: int, attempt: int = 0) -> Case:
        """The case for these arguments, independent of what was drawn before it.

        ScenarioError if it is invalid.
        """
        self.check_level(level)
        key = [seed, zlib.crc32(self.name.encode()), list(self.levels).index(level), index, attempt]
        try:
            d = self.generate(np.random.default_rng(key), level)
            if not isinstance(d, Draft):
                raise TypeError(
                    f"generate returned {type(d).__name__}, not a Draft (of"
                    " experiments.cases.scenario)."
                )
            query = Query(self.question, d.a, d.b, d.pose_a, d.pose_b, d.motion, d.motion_b)
            query = snap_query(query) if self.precision == "float32" else query
        except (ValueError, TypeError) as error:
            raise ScenarioError(
                f"Scenario '{self.name}' drew no valid case at level {level:g}, index {index}, "
                f"seed {seed}: {error}"
            ) from error
        name = f"{self.name}/{level:g}/{index:04d}"
        return Case(name, self.name, float(level), index, query, dict(d.tags or {}), self.precision)

    def check_level(self, level: float) -> None:
        if level not in self.levels:
            raise ValueError(
                f"Scenario '{self.name}' has no level {level:g}. Its axis is {self.axis}; its "
                f"levels are {', '.join(f'{v:g}' for v in self.levels)}."
            )

    def useless(self, truth: Truth) -> bool:
        found = {truth.label}
        found |= {"start-overlap"} if truth.start == "hit" else set()
        found |= {"touching"} if truth.touching else set()
        return not found.isdisjoint(self.redraw_if)


def snap(values) -> np.ndarray:
    """Nearest float32 as float64: float and double engines then answer the same query.

    Too large values become infinite.
    """
    with np.errstate(over="ignore"):
        return np.float32(values).astype(np.float64)


def snap_query(query: Query) -> Query:
    """Every number of a query snapped.

    ValueError if a body becomes invalid, or a number is too large.
    """
    sides = [
        snap_body(query.a),
        snap_body(query.b),
        snap_pose(query.pose_a),
        snap_pose(query.pose_b),
    ]
    return Query(query.question, *sides, snap_motion(query.motion), snap_motion(query.motion_b))


def snap_body(body: Body) -> Body:
    """The body with vertices snapped, made again and checked if one changes; else the body itself.

    ValueError if it becomes invalid.
    """
    vertices = snap(body.vertices)
    if np.array_equal(vertices, body.vertices):
        return body
    try:
        if body.kind == "union":
            return Body.union([snap_body(piece) for piece in body.pieces], body.name)
        if body.kind == "mesh":
            return Body.mesh(vertices, body.faces, body.name)
        return Body.convex(vertices, body.name)
    except BodyError as error:
        raise ValueError(
            f"rounded to float32, a body becomes invalid. {error} Draw it larger relative to its "
            'distance from its frame\'s origin, or declare precision = "float64".'
        ) from error


def snap_pose(pose: Pose) -> Pose:
    return Pose(snap(pose.quaternion), snap(pose.position))


def snap_motion(motion: Motion) -> Motion:
    return Motion(
        snap(motion.displacement),
        snap(motion.axis),
        float(np.float32(motion.angle)),
        snap(motion.about),
    )
