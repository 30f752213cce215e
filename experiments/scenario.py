"""A scenario: a family of cases along one axis of difficulty."""

from __future__ import annotations

import zlib
from dataclasses import dataclass
from typing import Callable, Mapping, Sequence

import numpy as np

from ofg import Body, Motion, Pose, Query

from .case import Case
from .truth.label import Truth


class ScenarioError(ValueError):
    """A scenario that draws what is no case. The message names the scenario, the level and the draw."""


@dataclass(frozen=True)
class Draft:
    """What a scenario's `generate` returns: two bodies, two poses, A's motion, tags to split tables by, and B's motion."""

    a: Body
    b: Body
    pose_a: Pose
    pose_b: Pose
    motion: Motion = Motion()
    tags: Mapping[str, str | float] = None
    motion_b: Motion = Motion()


@dataclass(frozen=True)
class Scenario:
    """One file in `experiments/scenarios/` holds one of these, named SCENARIO.

    name: as in the tables. question: what its cases ask. exposes: one line, what it tells methods apart by.
    axis: what the difficulty is, with its unit. levels: the values it takes, easy to hard.
    generate(rng, level) -> Draft: aims at the difficulty; the label comes from the certificate and never from the aim.
    redraw_if: what makes a case useless, so that it is drawn again (at most 50 times, and counted): any of "start-overlap"
    (a sweep that begins inside), "hit", "clear", "uncertain".
    """

    name: str
    question: str
    exposes: str
    axis: str
    levels: Sequence[float]
    generate: Callable[[np.random.Generator, float], Draft]
    redraw_if: Sequence[str] = ()

    def case(self, seed: int, level: float, index: int, attempt: int = 0) -> Case:
        """The same case for the same arguments, whatever was made before it. Inputs are snapped to float32. ScenarioError where it is none."""
        self.check_level(level)
        key = [seed, zlib.crc32(self.name.encode()), list(self.levels).index(level), index, attempt]
        try:
            d = self.generate(np.random.default_rng(key), level)
            if not isinstance(d, Draft):
                raise TypeError(f"generate returned {type(d).__name__}, not a Draft (of experiments.scenario).")
            query = Query(self.question, d.a, d.b, snap_pose(d.pose_a), snap_pose(d.pose_b), snap_motion(d.motion), snap_motion(d.motion_b))
        except (ValueError, TypeError) as error:
            raise ScenarioError(f"Scenario '{self.name}' drew no case at level {level:g}, index {index}, seed {seed}: {error}") from error
        return Case(f"{self.name}/{level:g}/{index:04d}", self.name, float(level), index, query, dict(d.tags or {}))

    def check_level(self, level: float) -> None:
        if level not in self.levels:
            raise ValueError(f"Scenario '{self.name}' has no level {level:g}. Its axis is {self.axis}; it takes {', '.join(f'{v:g}' for v in self.levels)}.")

    def useless(self, truth: Truth) -> bool:
        return truth.label in self.redraw_if or ("start-overlap" in self.redraw_if and truth.start == "hit")


def snap(values) -> np.ndarray:
    """Nearest float32 as float64: float and double engines then answer the same question."""
    return np.float32(values).astype(np.float64)


def snap_pose(pose: Pose) -> Pose:
    return Pose(snap(pose.quaternion), snap(pose.position))


def snap_motion(motion: Motion) -> Motion:
    return Motion(snap(motion.displacement), snap(motion.axis), float(np.float32(motion.angle)), snap(motion.about))
