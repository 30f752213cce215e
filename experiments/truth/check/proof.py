# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Settles one obligation by rationals and balls of 256 bits (Arb).

Points, in the frame of geometry.Pair: x(t) = t d + Rot(k_A, theta_A t) R(q_A) (v - about_A) for A,
and y(t) = dp + Rot(k_B, theta_B t) R(q_B) (v - about_B) for B.
"""

from flint import arb

from . import float_filter
from .balls import (
    add,
    cross,
    dot,
    greatest,
    least,
    mul,
    norm,
    number,
    rational,
    transposed,
    vector,
)
from .geometry import centre
from .obligations import Refused, require


def apart(o, vertices=None, near=None):
    """f(t), the distance along the plane of a vertex of one side (Q) from the support of the other
    (P), must exceed gap |n|.

    |f''| <= M, so f >= chord - (M h^2 / 2) x (1 - x): positive if f(s), f(e) > 0 and max + 3 min >
    M h^2 / 2; not negative with >= in place of >. vertices of Q and candidates `near` in P: those
    that doubles could not settle; all if None.
    """
    X, n, times = o.pair.exact, [number(c) for c in o.n], (rational(o.s), rational(o.e))
    require(any(n), "a plane without a normal keeps nothing apart")
    on_b = o.frame == "A"
    P, Q = (o.A, o.B) if on_b else (o.B, o.A)
    supports = (P if near is None else P[near]).tolist()
    Q = [vector(v) for v in (Q if vertices is None else Q[vertices]).tolist()]
    ends = [_end(o, n, t, supports, on_b) for t in times]
    bound = (
        _bend(o, n, times, P.tolist(), on_b)
        if times[1] > times[0] and (X.turn_a.theta or X.turn_b.theta)
        else lambda v: 0
    )
    half = (times[1] - times[0]) ** 2 / 2
    for v in Q:
        f = [dot(line, v) + offset for line, offset in ends]
        M, low, high = bound(v) * half, least(f), greatest(f)
        fine = (
            (low >= 0 and 3 * low + high >= M)
            if o.closed and not o.gap
            else (low > 0 and 3 * low + high > M)
        )
        if not fine:
            raise Refused(f"a plane does not keep A and B apart by {o.gap} over [{o.s}, {o.e}]")


def _end(o, n, t, P, on_b):
    """(line, offset) with f(t) = line . v + offset for a vertex v of Q."""
    X, pair = o.pair.exact, o.pair
    (RP, cP, turn_p), (RQ, cQ, turn_q) = (
        (X.RA, X.about_a, pair.turn_a),
        (
            X.RB,
            X.about_b,
            pair.turn_b,
        ),
    )
    if not on_b:
        (RP, cP, turn_p), (RQ, cQ, turn_q) = (RQ, cQ, turn_q), (RP, cP, turn_p)
    sign = 1 if on_b else -1
    # in space, and in P's frame at the start
    normal, seen = (n, turn_p(-t, n)) if o.frame == "W" else (turn_p(t, n), n)
    m = [sign * c for c in transposed(RP, seen)]
    support = greatest([dot(m, vector(p)) for p in P]) - dot(m, cP)
    line = [sign * c for c in transposed(RQ, turn_q(-t, normal))]
    return line, dot(normal, add(X.dp, X.d, -t)) - support - dot(line, cQ) - (
        rational(o.gap) * norm(n) if o.gap else 0
    )


def _bend(o, n, times, P, on_b):
    """The bound M on |f''| over the interval, as a function of a vertex of Q. README.md derives
    it.
    """
    X, turns = o.pair.exact, o.pair.turn_b if on_b else o.pair.turn_a
    (RP, cP, by_p), (RQ, cQ, by_q) = (X.RA, X.about_a, X.turn_a), (X.RB, X.about_b, X.turn_b)
    if not on_b:
        (RP, cP, by_p), (RQ, cQ, by_q) = (RQ, cQ, by_q), (RP, cP, by_p)
    kP, kQ, wP, wQ, h = by_p.k, by_q.k, abs(by_p.theta), abs(by_q.theta), times[1] - times[0]
    axis = transposed(RQ, kQ)

    def spin(v):
        return norm(cross(axis, add(v, cQ, -1))) if wQ else 0

    if o.frame == "W":
        reach = (
            greatest([norm(cross(transposed(RP, kP), add(vector(p), cP, -1))) for p in P])
            if wP
            else 0
        )
        fixed = wP**2 * by_p.across(n) * reach
        bend = wQ**2 * by_q.across(n)
        return lambda v: bend * spin(v) + fixed
    sign = 1 if on_b else -1
    k = transposed(RQ, turns(-times[0], kP))
    arms = [transposed(RQ, turns(-times[0], [sign * c for c in add(X.dp, X.d, -t)])) for t in times]
    slide, across, length = by_p.across(X.d), by_p.across(n), norm(n)

    def bound(v):
        r, own = add(v, cQ, -1), spin(v)
        arm = greatest([norm(cross(k, add(r, a))) for a in arms]) + wQ * h * own
        return across * (wP**2 * arm + 2 * wP * (slide + wQ * own)) + length * wQ**2 * own

    return bound


def within(o, *_):
    q, t = o.pair.query, rational(o.t)
    pose, motion = (q.pose_b, q.motion_b) if o.of_b else (q.pose_a, q.motion)
    x = add(
        add([number(c) for c in o.x], centre(pose, motion), -1), vector(motion.displacement), -t
    )
    y = _inward(o.pair, o.of_b, t, x)
    if o.corners is None:
        return require(
            winding(o.pair.b if o.of_b else o.pair.a, y), "the point is not inside the mesh"
        )
    w = [add(vector(v), y, -1) for v in o.corners]
    signs = [
        dot(w[i], cross(w[j], w[k])) * s
        for i, j, k, s in ((1, 2, 3, 1), (0, 2, 3, -1), (0, 1, 3, 1), (0, 1, 2, -1))
    ]
    require(
        all(z > 0 for z in signs) or all(z < 0 for z in signs),
        "the point is not inside its tetrahedron",
    )


def without(o, *_):
    X, t = o.pair.exact, rational(o.t)
    between = add(X.dp, X.d, -t)
    if o.of_b:
        y = _inward(o.pair, False, t, add(_outward(o.pair, True, t, o.v), between))
    else:
        y = _inward(o.pair, True, t, add(_outward(o.pair, False, t, o.v), between, -1))
    require(
        winding(o.pair.a if o.of_b else o.pair.b, y) == 0,
        "a part of one body may lie inside the other",
    )


def _outward(pair, of_b, t, v):
    """Vertex v of a body at time t, relative to its centre of rotation."""
    X = pair.exact
    R, about, turn = (X.RB, X.about_b, pair.turn_b) if of_b else (X.RA, X.about_a, pair.turn_a)
    return turn(t, mul(R, add(vector(v), about, -1)))


def _inward(pair, of_b, t, x):
    """A point at time t, relative to a body's centre of rotation, in that body's frame."""
    X = pair.exact
    R, about, turn = (X.RB, X.about_b, pair.turn_b) if of_b else (X.RA, X.about_a, pair.turn_a)
    return add(transposed(R, turn(-t, x)), about)


def winding(mesh, y):
    """Winding number of a closed mesh about y: signed crossings of a ray, all signs certain;
    None if no ray gives a decision.
    """
    for ray in ((1, 0, 0), (0, 1, 0), (0, 0, 1), (3, 5, 7), (-7, 4, 3), (5, -8, 6), (-2, -7, 9)):
        total = 0
        for face in mesh.faces[float_filter.crossed(mesh, y, ray)]:
            w = [add(vector(mesh.vertices[i]), y, -1) for i in face]
            edges = [arb(dot(ray, cross(w[i], w[(i + 1) % 3]))) for i in range(3)]
            volume = arb(dot(w[0], cross(w[1], w[2])))
            up, down = [z > 0 for z in edges], [z < 0 for z in edges]
            if any(up) and any(down):
                continue
            if not ((all(up) or all(down)) and (volume > 0 or volume < 0)):
                break
            total += (1 if all(up) else -1) if all(up) == (volume > 0) else 0
        else:
            return total
    return None
