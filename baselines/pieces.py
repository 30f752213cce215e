# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Concave meshes for engines that support convex shapes only: CoACD first decomposes the mesh,
as the engines' documentation advises.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import ofg
from ofg import Body, Query

from .contract import Unsupported, Verdict


class Decomposed:
    """Put this before a method that supports unions: `class BulletCoacd(Decomposed, Bullet)`. Other
    bodies are passed on unchanged.

    The pieces only approximate the mesh, within CoACD's threshold: near the surface, the verdict
    depends on the decomposition.
    """

    bodies = frozenset({"convex", "union", "mesh"})
    decomposes = True

    def prepare(self, query: Query) -> Callable[[], Verdict]:
        self.refuse(query)
        return super().prepare(replace(query, a=_pieces(query.a), b=_pieces(query.b)))


def _pieces(body: Body) -> Body:
    if body.kind != "mesh":
        return body
    try:
        return ofg.decompose(body)
    except ofg.BodyError as error:
        raise Unsupported(f"no convex pieces: {error}") from error
