"""Opposing Face Geometry (Eli Kara, GameDev.net 2004): a collision test that looks only at the faces that oppose each other."""

from .body import Body, BodyError
from .motion import Motion
from .pose import Pose
from .query import QUESTIONS, Query

__all__ = ["Body", "BodyError", "Motion", "Pose", "QUESTIONS", "Query"]
