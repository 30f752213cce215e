# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The best configuration of each engine behind the spheres of verified OFG: how much of its speed
any engine would gain by the same first step.
"""

from __future__ import annotations

from collections.abc import Callable

import ofg
from ofg import Query
from ofg.verification import prepare_spheres

from .bullet import BulletNoMargin
from .coal import CoalConvexExact
from .contract import Method, Unsupported, Verdict
from .drake import DrakeExact
from .fcl import FclConvexExact
from .mujoco import MujocoExact
from .parry import ParryExact
from .rapier import RapierExact


class BehindSpheres(Method):
    """Bounding spheres that are apart, or inscribed spheres that meet, settle a pair; the engine is
    asked about the others. Put this class before the engine's. Its net times are less the engine's
    own floor: the spheres settle the query that gives a floor, and then no engine is called.
    """

    configuration = "alternative"
    bodies = frozenset({"convex"})

    def prepare(self, query: Query) -> Callable[[], Verdict]:
        ask = super().prepare(query)
        try:
            return prepare_spheres(query, Verdict(False), Verdict(True), ask)
        except ofg.BodyError as error:
            raise Unsupported(str(error)) from error


class SpheresFcl(BehindSpheres, FclConvexExact):
    name = "spheres-fcl-convex-exact"
    floored = FclConvexExact


class SpheresBullet(BehindSpheres, BulletNoMargin):
    name = "spheres-bullet-no-margin"
    floored = BulletNoMargin


class SpheresMujoco(BehindSpheres, MujocoExact):
    name = "spheres-mujoco-exact"
    floored = MujocoExact


class SpheresCoal(BehindSpheres, CoalConvexExact):
    name = "spheres-coal-convex-exact"
    floored = CoalConvexExact


class SpheresParry(BehindSpheres, ParryExact):
    name = "spheres-parry-exact"
    floored = ParryExact


class SpheresRapier(BehindSpheres, RapierExact):
    name = "spheres-rapier-exact"
    floored = RapierExact


class SpheresDrake(BehindSpheres, DrakeExact):
    name = "spheres-drake-exact"
    floored = DrakeExact


METHODS = [
    SpheresFcl,
    SpheresBullet,
    SpheresMujoco,
    SpheresCoal,
    SpheresParry,
    SpheresRapier,
    SpheresDrake,
]
