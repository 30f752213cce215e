"""One question about two bodies: what every method is asked and every truth is about."""

from __future__ import annotations

from dataclasses import dataclass, field

from . import checks
from .body import Body
from .motion import Motion
from .pose import Pose

QUESTIONS = ("overlap", "translation", "motion")


@dataclass(frozen=True, eq=False)
class Query:
    """Do the interiors of two solids meet, and from when on?

    question: "overlap": at the given poses. "translation": while the bodies translate in t in [0,
    1]. "motion": while they turn and translate. motion: that of A. motion_b: that of B, which rests
    by default. Raises TypeError for a field of another type, ValueError where a motion does not fit
    the question.
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
                    f"Query.question = 'overlap' asks about one pair of poses, but {name} moves;"
                    " ask 'translation' or 'motion'."
                )
            if self.question == "translation" and motion.angle:
                raise ValueError(
                    f"Query.question = 'translation' cannot turn, but {name}.angle is not 0; ask"
                    " 'motion'."
                )

    def swapped(self) -> Query:
        """The same question with A and B exchanged; its answer is the same."""
        return Query(
            self.question, self.b, self.a, self.pose_b, self.pose_a, self.motion_b, self.motion
        )
