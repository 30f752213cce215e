# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Opposing Face Geometry (Eli Kara, GameDev.net 2004): a collision test that examines only the
faces of two bodies that oppose each other.
"""

from .algorithm import (
    article,
    ask,
    brute_force,
    brute_force_many,
    discrete,
    discrete_many,
    prepare,
    rotational_sweep,
    sweep_many,
    translational_sweep,
)
from .answer import COUNTS, FOUND, Answer, Answers
from .body import Body, BodyError, BodyWarning
from .decomposition import decompose
from .impact import Impact, Impacts
from .motion import Motion
from .options import REPAIRS, repair_options
from .pose import Pose
from .query import QUESTIONS, Query
from .verification import PairCache, verified, verified_many
from .verified_motion import verified_sweep, verified_sweep_many

__all__ = [
    "Answer",
    "Answers",
    "Body",
    "BodyError",
    "BodyWarning",
    "COUNTS",
    "FOUND",
    "Impact",
    "Impacts",
    "Motion",
    "PairCache",
    "Pose",
    "QUESTIONS",
    "Query",
    "REPAIRS",
    "article",
    "ask",
    "brute_force",
    "brute_force_many",
    "decompose",
    "discrete",
    "discrete_many",
    "prepare",
    "repair_options",
    "rotational_sweep",
    "sweep_many",
    "translational_sweep",
    "verified",
    "verified_many",
    "verified_sweep",
    "verified_sweep_many",
]
