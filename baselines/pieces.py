"""Concave meshes for engines that know convex shapes only: the mesh is decomposed by CoACD first,
as their documentation advises.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import ofg
from ofg import Body, Query

from .contract import Unsupported, Verdict


class Decomposed:
    """Put this before a method of unions: `class BulletCoacd(Decomposed, Bullet)`. Other bodies
    pass as they are.

    The pieces are another body than the mesh, by CoACD's threshold: what a verdict is worth near
    the surface is the decomposition's doing.
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
