# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""A cell of the native study: queries of one kind that are asked together."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from baselines.errors import Unsupported
from baselines.frames import stated
from ofg import Body, Query

#: poses of a pair that are timed together: a block of a warm, batched or coherent cell
BLOCK = 64


@dataclass(frozen=True, eq=False)
class Cell:
    """Queries of one question, one range of faces and one situation, with their certified labels.

    bodies: "hull", "ico", "cube" (synthetic), "convex" or "mesh" (of a run). faces: of the larger
    body, as the tables name it. labels: per query "hit" or "clear"; "uncertain" judges nobody.
    cases: the name of each query. block: so many queries are timed together.
    """

    bodies: str
    faces: str
    question: str
    situation: str
    modes: tuple[str, ...]
    queries: list[Query]
    labels: list[str]
    cases: list[str]
    block: int = 1

    @property
    def name(self) -> str:
        return f"{self.bodies} {self.faces} {self.situation} {'/'.join(self.modes)}"


def kind(query: Query) -> str | None:
    """What the native lane takes the bodies for: "convex", "mesh", or None where it takes none.

    It knows no unions, and no motion in which both bodies turn.
    """
    kinds = {query.a.kind, query.b.kind}
    try:
        stated(query, movers=1, about=False)
    except Unsupported:
        return None
    return None if "union" in kinds else "mesh" if "mesh" in kinds else "convex"


def unit_hull(rng: np.random.Generator, faces: int) -> Body:
    """The hull of random points on a unit sphere, as many as make `faces` triangles."""
    v = rng.normal(size=(faces // 2 + 2, 3))
    return Body.convex(v / np.linalg.norm(v, axis=1)[:, None])
