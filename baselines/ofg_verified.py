# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Verified Opposing Face Geometry behind the same contract as the engines, and what it is compared
with: the same portal without a selection, and substeps.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import ofg
from ofg import QUESTIONS, Motion, Query
from ofg.verification import prepare_verified
from ofg.verified_motion import prepare_verified_sweep

from .contract import Unsupported, Verdict
from .sampling import Discrete, Substeps


class VerifiedOverlap(Discrete):
    """Opposing faces by a table of directions, a portal over their vertices, an answer that the
    whole bodies confirm, and exact arithmetic where doubles cannot. Unions by pairs of pieces and
    meshes by pairs of faces, which trees of boxes exclude or which are asked.
    """

    engine = "ofg"
    imports = "ofg"
    configuration = "best effort"
    bodies = frozenset({"convex", "union", "mesh"})
    solid = True
    places_b = True
    guarantee = "every answer is proved, in doubles by more than their rounding or exactly"
    selection = True

    def build(self, query: Query):
        still = replace(query, question="overlap", motion=Motion(), motion_b=Motion())

        def place(pose_a, pose_b=query.pose_b):
            placed = replace(still, pose_a=pose_a, pose_b=pose_b)
            try:
                return prepare_verified(placed, selection=self.selection)
            except ofg.BodyError as error:
                raise Unsupported(str(error)) from error

        return place, lambda ask: ask()[0]


class Verified(VerifiedOverlap):
    """`VerifiedOverlap` at one pose, and the first contact over a step: a ray shot at the
    difference of translating bodies, planes that carry the proof from time to time for turning
    ones.
    """

    name = "ofg-verified"
    questions = frozenset(QUESTIONS)
    swept = frozenset({"convex", "union"})
    movers, about = 2, True
    gives_time = True
    #: but where the approach takes 1e5 steps for the bodies' size, and for contacts not told from
    #: touching: see ofg.Impact.proved
    time_error = 1e-9
    guarantee = (
        "every answer is proved, in doubles by more than their rounding or exactly, but a hit of a "
        "rotation that rounding hides; no time is later than the first contact"
    )

    def prepare(self, query: Query) -> Callable[[], Verdict]:
        if query.question == "overlap":
            return super().prepare(query)
        self.refuse(query)
        try:
            ask = prepare_verified_sweep(query)
        except ofg.BodyError as error:
            raise Unsupported(str(error)) from error
        return lambda: Verdict(*ask())


class VerifiedSubsteps(Substeps, VerifiedOverlap):
    name = "ofg-verified-substeps"


class Portal(VerifiedOverlap):
    """`ofg-verified` without the opposing faces: every step of the portal asks the whole bodies.
    What the selection is worth is the difference.
    """

    name = "ofg-mpr"
    configuration = "alternative"
    bodies = frozenset({"convex", "union"})  # a mesh has no opposing faces to leave out
    selection = False


METHODS = [Verified, VerifiedSubsteps, Portal]
