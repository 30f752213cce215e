# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Extract the parts of a certificate that can be drawn: its planes, each with its elements and
times, and its common point.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from fractions import Fraction
from typing import Any

RATIONAL = re.compile(r"-?[0-9]{1,4000}(/[0-9]{1,4000})?")
MOST_PLANES = 4000  # per case; a proof about two large meshes has too many to view


def drawable(certificate: Mapping[str, Any], most: int = MOST_PLANES) -> dict:
    """The parts of a certificate (experiments/truth/README.md) with rationals rounded to doubles.

    "clear", "end_clear": {"planes": n, "leaves": [[s, e, frame, nx, ny, nz, a_from, a_to, b_from,
    b_to], ...], "order_a", "order_b"}: over [s, e] the normal n, fixed in the world (frame "W") or
    rotating with A ("A"), points from the elements order_a[a_from:a_to] of A to
    order_b[b_from:b_to] of B and separates them. An order is omitted if it is 0, 1, 2, ...; the
    leaves are omitted if there are more than `most`. "hit", "end_hit": {"point": [x, y, z]} in the
    world. A certificate that cannot be read gives {}.
    """
    try:
        return _drawable(certificate, most)
    except (KeyError, TypeError, ValueError, ArithmeticError, AttributeError, IndexError):
        return {}  # the checker reports the fault


def _drawable(certificate, most: int) -> dict:
    found = {}
    for key in ("clear", "end_clear"):
        if key in certificate:
            found[key] = _planes(certificate[key], 1.0 if key == "end_clear" else 0.0, most)
    for key in ("hit", "end_hit"):
        if key in certificate:
            found[key] = {"point": [_number(x) for x in certificate[key]["point"]]}
    return found


def _planes(proof: Mapping[str, Any], start: float, most: int) -> dict:
    a, b = proof.get("order_a"), proof.get("order_b")
    leaves = []
    stack = [(proof["tree"], (0, len(a) if a else None), (0, len(b) if b else None), start)]
    while stack:
        (segments, split), ra, rb, s = stack.pop()
        for e, frame, *n in segments:
            leaves.append([s, e, frame, *map(_number, n), *ra, *rb])
            s = e
        if split is not None:
            side, cuts, children = split
            lo, hi = ra if side == "a" else rb
            ends = [lo, *cuts, hi]
            for x, y, child in zip(ends, ends[1:], children):
                stack.append((child, (x, y), rb, s) if side == "a" else (child, ra, (x, y), s))
    made: dict[str, Any] = {"planes": len(leaves)}
    if len(leaves) <= most:
        made["leaves"] = leaves
        made.update(
            {
                key: order
                for key, order in (("order_a", a), ("order_b", b))
                if order and order != list(range(len(order)))
            }
        )
    return made


def _number(x) -> float:
    if isinstance(x, str) and not RATIONAL.fullmatch(x):
        # a Fraction of "1e999999999" would fill the memory
        raise ValueError(f"{x[:40]} is not a rational number")
    return float(Fraction(x)) if isinstance(x, str) else float(x)
