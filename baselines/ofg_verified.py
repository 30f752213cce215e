# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Verified Opposing Face Geometry behind the same contract as the engines, and what it is compared
with: the same portal without a selection.
"""

from __future__ import annotations

from dataclasses import replace

import ofg
from ofg import Motion, Query
from ofg.verification import prepare_verified

from .contract import Unsupported
from .sampling import Discrete, Substeps


class Verified(Discrete):
    """Opposing faces by a table of directions, a portal over their vertices, an answer that the
    whole bodies confirm, and exact arithmetic where doubles cannot. Unions by pairs of pieces and
    meshes by pairs of faces, which trees of boxes exclude or which are asked.
    """

    name = "ofg-verified"
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


class VerifiedSubsteps(Substeps, Verified):
    name = "ofg-verified-substeps"


class Portal(Verified):
    """`ofg-verified` without the opposing faces: every step of the portal asks the whole bodies.
    What the selection is worth is the difference.
    """

    name = "ofg-mpr"
    configuration = "alternative"
    bodies = frozenset({"convex", "union"})  # a mesh has no opposing faces to leave out
    selection = False


METHODS = [Verified, VerifiedSubsteps, Portal]
