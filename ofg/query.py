"""One question about two bodies: what every method is asked and every truth is about."""

from __future__ import annotations

from dataclasses import dataclass, field

from .body import Body
from .motion import Motion
from .pose import Pose

QUESTIONS = ("overlap", "translation", "motion")


@dataclass(frozen=True, eq=False)
class Query:
    """Do the interiors of two solids meet, and from when on?

    question: "overlap": at the given poses. "translation": while A translates by motion.displacement in t in [0, 1].
    "motion": while A turns about its own origin and translates. B is at rest: give the relative motion.
    Raises ValueError where the motion does not fit the question.
    """

    question: str
    a: Body
    b: Body
    pose_a: Pose = field(default_factory=Pose)
    pose_b: Pose = field(default_factory=Pose)
    motion: Motion = field(default_factory=Motion)

    def __post_init__(self):
        if self.question not in QUESTIONS:
            raise ValueError(f"Query.question = '{self.question}' is unknown; use one of {', '.join(QUESTIONS)}.")
        if self.question == "overlap" and (self.motion.displacement.any() or self.motion.angle):
            raise ValueError("Query.question = 'overlap' asks about one pair of poses, but a motion is given; ask 'translation' or 'motion'.")
        if self.question == "translation" and self.motion.angle:
            raise ValueError("Query.question = 'translation' cannot turn, but motion.angle is not 0; ask 'motion'.")
