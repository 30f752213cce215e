# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The case file that `case_file.hpp` reads. Little-endian, no padding."""

from __future__ import annotations

import struct
from functools import cache
from pathlib import Path

import numpy as np

from ofg import QUESTIONS, Body, Query

from .. import registry
from ..frames import stated
from ..units import Normalised


def write(path: Path, queries: list[Query], block: int = 1, apart: bool = False) -> None:
    """Each body once, then a case per query; `block` of them, one after the other, are one timing.

    apart: every query gets bodies of its own, even where two are equal. A union is the faces of all
    its pieces, followed by the pieces. ValueError where the queries are no whole number of blocks.
    Unsupported where both bodies turn.
    """
    if block < 1 or len(queries) % block:
        raise ValueError(f"{len(queries)} queries are no whole number of blocks of {block}.")
    bodies: dict[object, int] = {}
    blocks, cases = [], []
    for i, query in enumerate(stated(query, movers=1, about=False) for query in queries):
        for side, body in (("a", query.a), ("b", query.b)):
            key = _key(body, (i, side) if apart else ())
            if key not in bodies:
                bodies[key] = len(bodies)
                blocks.append(_body(body))
        own = (
            bodies[_key(body, (i, side) if apart else ())]
            for side, body in (("a", query.a), ("b", query.b))
        )
        cases.append(struct.pack("<III", *own, QUESTIONS.index(query.question)) + _numbers(query))
    units = [
        struct.pack("<I", len(name)) + name.encode() + struct.pack("<d", length)
        for name, length in lengths().items()
    ]
    head = struct.pack("<IIII", len(bodies), len(cases), block, len(units))
    path.write_bytes(b"OFGLANE3" + head + b"".join(units + blocks + cases))


@cache
def lengths() -> dict[str, float]:
    """The unit (see units.py) of each method that is asked in one of its own, by its name."""
    made = (
        (name, method())
        for name, method in registry.methods().items()
        if issubclass(method, Normalised)
    )
    return {name: method.length for name, method in made}


def _key(body: Body, place: tuple) -> tuple:
    return (body.kind, body.digest, *place)


def _body(body: Body) -> bytes:
    pieces = body.pieces if body.kind == "union" else ()
    convex = body.kind == "convex"
    sizes = len(body.vertices), len(body.faces), convex, len(pieces)
    rows = body.vertices.astype("<f8").tobytes() + body.faces.astype("<i4").tobytes()
    head = struct.pack("<IIIId", *sizes, body.radius)
    return head + rows + b"".join(_body(piece) for piece in pieces)


def _numbers(query: Query) -> bytes:
    motion = query.motion
    numbers = [
        query.pose_a.quaternion,
        query.pose_a.position,
        query.pose_b.quaternion,
        query.pose_b.position,
        motion.displacement,
        motion.axis,
        [motion.angle],
    ]
    return np.concatenate(numbers).astype("<f8").tobytes()
