# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Real meshes: which of them a family draws and in which form, and how they move at one another."""

import numpy as np

from ofg import Body, Motion, Pose

from .placement import touching
from .scenario import Draft
from .shapes import CONVEX_MESHES, real_concave, real_convex, real_pieces

CONVEX = tuple(CONVEX_MESHES)
SURFACES = ("cone", "lower_leg", "shin", "knuckle", "shape_sorter", "guide", "bunny")
# CoACD decomposes these within about 3 s in total; the others are supplied in pieces.
DECOMPOSED = ("cone", "lower_leg", "shin", "knuckle")
PIECES = ("tray", "xarm_link4", "duck_pieces", "upper_leg", "teddy")


def any_pair(rng) -> tuple[Body, Body, str]:
    """Two bodies and the kind of pair: both convex, a closed surface with a convex body or
    another, or unions of pieces.
    """
    kind = ("convex", "surface", "union")[rng.integers(3)]
    if kind == "convex":
        return _convex(rng), _convex(rng), kind
    draw = _surface if kind == "surface" else _union
    return (_convex(rng) if rng.random() < 0.5 else draw(rng)), draw(rng), kind


def throw(rng, speed: float, turn: float = 0.0) -> Draft:
    """One real mesh flies at a point of another's surface from outside its sphere: onto it, just
    short of it, or past it.

    speed: travel / size of the target body. turn: about an axis of random direction, radians.
    """
    a, b, kind = any_pair(rng)
    rotation, target, normal = touching(rng, a, b, 0.0)
    place = ("onto", "short of", "past")[rng.choice(3, p=[0.6, 0.2, 0.2])]
    heading = -normal + 0.5 * rng.normal(size=3)
    heading *= np.sign(-heading @ normal) / np.linalg.norm(heading)
    if place == "past":
        aside = np.cross(heading, rng.normal(size=3))
        target = target + aside / np.linalg.norm(aside) * rng.uniform(0.5, 1.5) * (
            a.radius + b.radius
        )
    travel = speed * b.size
    clear_of_b = 1.1 * (a.radius + b.radius) + target @ heading
    way = 1.05 * travel if place == "short of" else clear_of_b
    motion = Motion(travel * heading, rng.normal(size=3), turn)
    start = motion.pose_at(Pose(rotation, target), -way / travel)
    tags = {"kind": kind, "place": place, "bodies": f"{a.name} on {b.name}"}
    return Draft(a, b, start, Pose(), motion, tags)


def _convex(rng) -> Body:
    return real_convex(CONVEX[rng.integers(len(CONVEX))])


def _surface(rng) -> Body:
    return real_concave(SURFACES[rng.integers(len(SURFACES))])


def _union(rng) -> Body:
    i = rng.integers(len(DECOMPOSED) + len(PIECES))
    return (
        real_concave(DECOMPOSED[i], "union")
        if i < len(DECOMPOSED)
        else real_pieces(PIECES[i - len(DECOMPOSED)])
    )
