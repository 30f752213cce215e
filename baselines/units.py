# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Best effort, part one: the units and the origin that suit an engine.

Engines have absolute tolerances and margins, and lose digits far from the origin. A careful user
chooses units that suit the engine and puts the origin near the bodies; so do the methods below.
Neither costs accuracy: units are powers of two, and the origin is B's position, subtracted in
double. `experiments/studies/tuning.py` counts which unit suits an engine, on cases that no run
uses.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Callable
from dataclasses import replace
from functools import cache, lru_cache
from pathlib import Path
from typing import ClassVar

from ofg import Body, Pose, Query

from .contract import Tolerance, Verdict

TABLE = Path(__file__).with_name("units.csv")  #: counts of wrong answers by method and unit


def best(rows: list[dict[str, str]]) -> float:
    """The unit of the row with the fewest wrong, then the fewest unanswered, then the nearest to
    1.
    """
    key = {float(r["unit"]): (int(r["wrong"]), int(r["unanswered"])) for r in rows}
    return min(key, key=lambda unit: (*key[unit], abs(math.log2(unit))))


@cache
def tuned() -> dict[str, float]:
    """method -> its unit, from the counts in TABLE."""
    with TABLE.open(newline="") as file:
        rows = list(csv.DictReader(file))
    names = dict.fromkeys(row["method"] for row in rows)
    return {name: best([row for row in rows if row["method"] == name]) for name in names}


class Normalised:
    """Put this before a method: `class FclExact(Normalised, FclConvex)`.

    A length in its tolerance is in the method's own unit, so for a query it becomes a share of the
    size of the larger body, which is at least the radius that defines the unit.
    """

    #: if it is not that of the method behind this class
    own_tolerance: ClassVar[Tolerance | None] = None

    @property
    def length(self) -> float:
        """The radius that the smaller body gets, within a factor of sqrt(2).

        As tuned for the method, or for the method from which it is derived; 1 if neither is tuned.
        """
        names = (cls.__dict__.get("name") for cls in type(self).__mro__)
        return next((tuned()[name] for name in names if name in tuned()), 1.0)

    @property
    def tolerance(self) -> Tolerance:
        own = super().tolerance if self.own_tolerance is None else self.own_tolerance
        return replace(own, length=0.0, relative=own.relative + own.length / self.length)

    def prepare(self, query: Query) -> Callable[[], Verdict]:
        self.refuse(query)
        return super().prepare(normalised(query, self.length))


def normalised(query: Query, length: float) -> Query:
    """The same query in other units, with B at the origin at the start.

    Times of impact are unchanged.
    """
    unit = 2.0 ** round(math.log2(length / min(query.a.radius, query.b.radius)))
    offset = query.pose_a.position - query.pose_b.position
    pose_a, pose_b = Pose(query.pose_a.quaternion, unit * offset), Pose(query.pose_b.quaternion)
    motion, motion_b = (
        replace(m, displacement=unit * m.displacement, about=unit * m.about)
        for m in (query.motion, query.motion_b)
    )
    a, b = scaled(query.a, unit), scaled(query.b, unit)
    return replace(query, a=a, b=b, pose_a=pose_a, pose_b=pose_b, motion=motion, motion_b=motion_b)


@lru_cache(maxsize=64)
def scaled(body: Body, unit: float) -> Body:
    """The body scaled by a power of two: exact, so no check needs repeating."""
    if unit == 1:
        return body
    pieces = () if body.kind != "union" else tuple(scaled(piece, unit) for piece in body.pieces)
    return Body.unchecked(body.kind, unit * body.vertices, body.faces, pieces, body.name)
