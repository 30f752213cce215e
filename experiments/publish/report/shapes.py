# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Bodies, certificates and OFG's selections of the cases that a page can draw, in bytes."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

import numpy as np

import ofg
from baselines import registry
from ofg import Body, Query
from ofg.decomposition import kept_at

from . import selection
from .certificate import drawable

BYTES = 8_000_000  # limit on the bodies of a page, before compression
CASES = 3_000  # limit on the cases that a page can draw, which bounds the time to make it
EXACT = 5_000  # bodies of up to this many vertices are never rounded
# A larger selection is not drawn; for k = inf on a large mesh the page gives only its size.
SELECTED = 2_000


class Shapes:
    """Collects bodies (each once), certificates and selections, up to `room` bytes of bodies."""

    def __init__(self, room: float, anew: bool = False):
        """anew: whether to decompose meshes, which can take a minute each; otherwise OFG's pieces
        are shown only if the run left them in the cache.
        """
        self.room, self.anew, self.bytes = room, anew, bytearray()
        self.bodies, self.drawn, self.proofs, self.ofg = [], {}, {}, {}
        self._known: dict[str, int] = {}
        self._decomposed: dict[str, Body] = {}

    def add(self, place: int, case, truth, labels: Iterable[str], most: int) -> None:
        q = case.query
        cost = sum(
            _cost(body)
            for body in {b.digest: b for b in (q.a, q.b)}.values()
            if body.digest not in self._known
        )
        if len(self.bytes) + cost > self.room or len(self.drawn) == CASES:
            return
        self.drawn[place] = [self._body(q.a), self._body(q.b)]
        self.proofs[place] = drawable(truth.certificate)
        for label in list(labels)[:most]:
            made = self._trace(q, label, truth)
            if made:
                self.ofg.setdefault(place, {})[label] = made

    def packed(self) -> dict:
        return {
            "bodies": self.bodies,
            "drawn": self.drawn,
            "proofs": self.proofs,
            "ofg": self.ofg,
            "bytes": bytes(self.bytes),
        }

    def _trace(self, query: Query, label: str, truth) -> dict | None:
        """OFG's selections; None if the method refuses the query or its pieces are not in the
        cache. "bodies": indices of the bodies in the query, which may be pieces of a mesh.
        """
        (method,) = registry.make(label)
        options = {**method.options()}
        if method.decomposes:
            if not self.anew and not all(
                body.kind != "mesh" or kept_at(body).is_file() for body in (query.a, query.b)
            ):
                return None
            try:
                pieces = [self._pieces(query.a), self._pieces(query.b)]
            except ofg.BodyError:
                return None
            query = replace(query, a=pieces[0], b=pieces[1])
        made = selection.trace(query, options, truth.t_hi)
        for side in ("a", "b"):
            made[f"n{side}"] = len(made[side])
            made[side] = made[side] if len(made[side]) <= SELECTED else []
        seen = [query.a.digest, query.b.digest]
        if any(d not in self._known for d in seen):
            made["bodies"] = [self._body(query.a), self._body(query.b)]
        else:
            made["bodies"] = [self._known[d] for d in seen]
        return made

    def _pieces(self, body: Body) -> Body:
        if body.digest not in self._decomposed:
            self._decomposed[body.digest] = ofg.decompose(body)
        return self._decomposed[body.digest]

    def _body(self, body: Body) -> int:
        if body.digest in self._known:
            return self._known[body.digest]
        vertices, faces = body.vertices, body.faces
        exact = np.array_equal(vertices, vertices.astype(np.float32))
        kind = "f4" if exact or len(vertices) > EXACT else "f8"
        index = "u2" if len(vertices) < 65536 else "u4"
        entry: dict[str, Any] = {
            "name": body.name,
            "kind": body.kind,
            "v": [self._put(vertices.astype("<" + kind)), kind, len(vertices)],
            "f": [self._put(faces.astype("<" + index)), index, len(faces)],
            "rounded": kind == "f4" and not exact,
        }
        if body.kind == "union":
            entry["pieces"] = [[len(p.vertices), len(p.faces)] for p in body.pieces]
        self.bodies.append(entry)
        self._known[body.digest] = len(self.bodies) - 1
        return self._known[body.digest]

    def _put(self, array: np.ndarray) -> int:
        self.bytes.extend(b"\0" * (-len(self.bytes) % 8))
        start = len(self.bytes)
        self.bytes.extend(array.tobytes())
        return start


def _cost(body: Body) -> int:
    return 24 * len(body.vertices) + 6 * len(body.faces)
