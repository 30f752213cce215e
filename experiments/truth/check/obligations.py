# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""What a label owes: the obligations that a certificate must meet, field by field.

README.md beside this folder describes the certificate. Nothing is proved here but rational
identities; proof.py and float_filter.py settle the obligations.
"""

from math import isfinite
from typing import NamedTuple

import numpy as np

from .balls import add, dot, finite, mul, number, rational, transposed, vector
from .geometry import Pair, Points, elements, parts, support

FRAMES = ("W", "A", "B")


class Apart(NamedTuple):
    """Plane n keeps the hulls of (m, 3) A and B farther apart than gap over [s, e]. frame: "W"
    (n is fixed in space), "A" or "B" (n rotates with that body). closed: the hulls may touch the
    plane (gap 0), as is allowed for convex bodies but not for a mesh's triangles.
    """

    pair: Pair
    A: np.ndarray
    B: np.ndarray
    s: float
    e: float
    frame: str
    n: list
    gap: float
    closed: bool


class Within(NamedTuple):
    """World point x at time t lies strictly inside a body, B or A: inside the tetrahedron
    `corners` (4, 3), or a mesh if None.
    """

    pair: Pair
    of_b: bool
    corners: np.ndarray | None
    x: list
    t: float


class Without(NamedTuple):
    """Vertex v of one body at time t lies strictly outside the other body, a mesh: B's outside A
    if of_b, else A's outside B.
    """

    pair: Pair
    of_b: bool
    v: np.ndarray
    t: float


class Refused(Exception):
    pass


def require(fact, reason):
    if not fact:
        raise Refused(reason)


def obligations(pair, truth, c):
    """The obligations of a label; Refused if the certificate does not even claim it."""
    sweep = pair.query.question != "overlap"
    nan = truth.t_lo != truth.t_lo and truth.t_hi != truth.t_hi
    require(
        truth.label == "clear" or not truth.touching, "only a clear label is tagged as touching"
    )
    if truth.label == "uncertain":
        silent = truth.start == truth.end == "uncertain" and nan and truth.gap != truth.gap
        require(silent and not c, "an uncertain label claims nothing")
        return
    require(isfinite(truth.gap), f"a certified label has a gap, not {truth.gap}")
    if truth.label == "clear":
        require(
            truth.start == truth.end == "clear" and not truth.gap < 0 and nan,
            "a clear label is clear at both ends, without times",
        )
        yield from clear(pair, c["clear"], 0.0, float(sweep), truth.gap if truth.gap > 0 else 0.0)
        require(
            truth.touching == ("touching" in c), "the tag `touching` and its witness go together"
        )
        if truth.touching:
            require(not truth.gap > 0, "bodies that touch are no distance apart")
            touching(pair, c["touching"], sweep)
        return
    require(truth.label == "hit" and not truth.gap > 0, f"label {truth.label} with gap {truth.gap}")
    if not sweep:
        require(
            truth.start == truth.end == "hit" and nan,
            "an overlap hits at both ends and has no times",
        )
        yield from common(pair, c["hit"], 0.0)
        return
    require(0 <= truth.t_lo <= truth.t_hi <= 1, "the bracket lies outside [0, 1]")
    yield from common(pair, c["hit"], truth.t_hi)
    if truth.start == "clear":
        yield from clear(pair, c["clear"], 0.0, truth.t_lo, 0.0)
    require(
        truth.start == "clear" or (truth.start == "hit" and truth.t_hi == 0),
        "a bracket needs a certified start",
    )
    require(truth.end in ("clear", "hit", "uncertain"), f"unknown end {truth.end}")
    if truth.end == "clear":
        yield from clear(pair, c["end_clear"], 1.0, 1.0, 0.0)
    if truth.end == "hit":
        yield from common(pair, c["end_hit"], 1.0)
    if "exact" in c:
        one = pair.a.kind == pair.b.kind == "convex"
        require(one, "an exact time is of two convex bodies: another piece may be met earlier")
        exact_time(pair, c["exact"], truth.t_lo, truth.t_hi)


def clear(pair, cert, start, end, gap):
    """Planes for every element of A against every element of B over [start, end]; no part of one
    body inside a mesh.
    """
    sides = []
    for key, body in (("order_a", pair.a), ("order_b", pair.b)):
        order = cert.get(key)
        count = len(elements(body))
        if order is not None:
            order = np.array(order, dtype=np.int64)
            require(
                order.shape == (count,) and (np.sort(order) == np.arange(count)).all(),
                f"{key} is not a permutation of the elements",
            )
        sides.append((Points(body, order), count))
    (A, na), (B, nb) = sides
    solid = pair.a.kind != "mesh" and pair.b.kind != "mesh"
    stack = [(cert["tree"], (0, na), (0, nb), start, True)]
    while stack:
        (segments, split), ra, rb, s, owing = stack.pop()
        if segments:
            a, b = A.of(*ra), B.of(*rb)
        for e, frame, *n in segments:
            if not (s <= e and frame in FRAMES and len(n) == 3 and isfinite(e)):
                raise Refused("segments are out of order")
            yield Apart(pair, a, b, s, e, frame, [finite(c) for c in n], gap, solid)
            s, owing = e, False
        if s < end or owing:
            require(split is not None, "some elements are not shown apart to the end")
            side, cuts, children = split
            ends = [(ra if side == "a" else rb)[0], *cuts, (ra if side == "a" else rb)[1]]
            ranges = list(zip(ends, ends[1:]))
            require(
                side in ("a", "b") and all(x < y for x, y in ranges),
                "a split does not cover its side",
            )
            for child, r in zip(children, ranges, strict=True):
                stack.append((child, r, rb, s, owing) if side == "a" else (child, ra, r, s, owing))
    for mesh, other, of_b in ((pair.a, pair.b, True), (pair.b, pair.a, False)):
        if (
            mesh.kind == "mesh"
        ):  # its surface is apart from the other body: one point of each connected part decides
            yield from (Without(pair, of_b, v, start) for v in parts(other))


def common(pair, cert, t):
    """One point inside both: in four vertices of one convex piece [piece, i, j, k, l], or by
    winding number in a mesh (null).
    """
    x = [finite(c) for c in cert["point"]]
    require(len(x) == 3, "a point has three coordinates")
    for of_b, body, where in ((False, pair.a, cert["a"]), (True, pair.b, cert["b"])):
        if body.kind == "mesh":
            yield Within(pair, of_b, None, x, t)
        else:
            require(
                len(where) == 5 and min(where) >= 0,
                "a tetrahedron is a piece and four of its vertices",
            )
            yield Within(pair, of_b, body.pieces[where[0]].vertices[where[1:]], x, t)


def exact_time(pair, cert, t_lo, t_hi):
    """Rational t* of a translation: n touches a piece of A and one of B at t*, weights give a
    common point, and n.d > 0.
    """
    RA, RB, dp, d = pair.exact[:4]
    t, n = number(cert["time"]), [number(c) for c in cert["normal"]]
    require(
        not (pair.theta_a or pair.theta_b) and rational(t_lo) <= t <= rational(t_hi),
        "the exact time lies outside its bracket",
    )
    A, B = (body.pieces[cert[key]["piece"]] for key, body in (("a", pair.a), ("b", pair.b)))
    apart_by = (
        dot(n, dp)
        - support(B, transposed(RB, [-c for c in n]))[0]
        - support(A, transposed(RA, n))[0]
    )
    require(
        dot(n, d) > 0 and apart_by == t * dot(n, d), "the plane does not touch both bodies at t*"
    )
    common_point(pair, cert, t)


def touching(pair, cert, sweep):
    """The closed bodies share a point at a rational time: at the start, or in a translation at
    any time.
    """
    t = number(cert["time"])
    require(0 <= t <= int(sweep), "the time of touching lies outside the step")
    require(
        not t or not (pair.theta_a or pair.theta_b),
        "rotating bodies have rational positions only at the start",
    )
    require("mesh" not in (pair.a.kind, pair.b.kind), "the tag `touching` needs convex pieces")
    common_point(pair, cert, t)


def common_point(pair, cert, t):
    """Convex weights of vertices of one piece of each body give the same point at time t,
    exactly.
    """
    X = pair.exact
    meeting = add(X.dp, X.d, -t)
    for side, body, R, about, sign in (
        (cert["a"], pair.a, X.RA, X.about_a, -1),
        (cert["b"], pair.b, X.RB, X.about_b, 1),
    ):
        require(side["piece"] >= 0, "piece indices start from 0")
        weights, ids, piece = (
            [number(w) for w in side["weights"]],
            side["vertices"],
            body.pieces[side["piece"]],
        )
        require(
            len(weights) == len(ids) and min(weights) >= 0 and sum(weights) == 1 and min(ids) >= 0,
            "the weights are not convex",
        )
        for w, i in zip(weights, ids):
            meeting = add(meeting, mul(R, add(vector(piece.vertices[i]), about, -1)), sign * w)
    require(not any(meeting), "the weights do not give one common point")
