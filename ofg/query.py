# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""A query about two bodies: the input of every method and the subject of every truth."""

from __future__ import annotations

from dataclasses import dataclass, field

from . import checks
from .body import Body
from .motion import Motion
from .pose import Pose

QUESTIONS = ("overlap", "translation", "motion")


@dataclass(frozen=True, eq=False)
class Query:
    """Do the interiors of two solids intersect, and from what time on?

    question: "overlap": at the given poses. "translation": while the bodies translate over t in [0,
    1]. "motion": while they rotate and translate. motion: the motion of A. motion_b: the motion of
    B, which rests by default. Raises TypeError for a field of the wrong type, ValueError if a
    motion does not fit the question.
    """

    question: str
    a: Body
    b: Body
    pose_a: Pose = field(default_factory=Pose)
    pose_b: Pose = field(default_factory=Pose)
    motion: Motion = field(default_factory=Motion)
    motion_b: Motion = field(default_factory=Motion)

    def __post_init__(self) -> None:
        checks.one_of("Query.question", self.question, QUESTIONS)
        for name in ("a", "b"):
            checks.body(getattr(self, name), f"Query.{name}")
        for name in ("pose_a", "pose_b"):
            checks.pose(getattr(self, name), f"Query.{name}")
        for name in ("motion", "motion_b"):
            checks.motion(getattr(self, name), f"Query.{name}")
        for name, motion in (("motion", self.motion), ("motion_b", self.motion_b)):
            if self.question == "overlap" and not motion.rests:
                raise ValueError(
                    f"Query.question = 'overlap' concerns one pair of poses, but {name} moves; "
                    "use 'translation' or 'motion'."
                )
            if self.question == "translation" and motion.angle:
                raise ValueError(
                    f"Query.question = 'translation' allows no rotation, but {name}.angle is not "
                    "0; use 'motion'."
                )

    def swapped(self) -> Query:
        """The same query with A and B exchanged; its answer is the same."""
        return Query(
            self.question, self.b, self.a, self.pose_b, self.pose_a, self.motion_b, self.motion
        )
