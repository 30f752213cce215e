"""The independent checker: it verifies a label by its certificate alone
(experiments/truth/README.md describes it).

A label is decomposed into obligations: convex sets apart over an interval, a point inside a
tetrahedron or a mesh, an exact time. Each is settled by doubles with an error bound
(float_filter.py) or else here, by rationals and balls of 256 bits (Arb). Points, in the frame of
geometry.Pair: x(t) = t d + Rot(k_A, theta_A t) R(q_A) (v - about_A) for A, and y(t) = dp + Rot(k_B,
theta_B t) R(q_B) (v - about_B) for B.
"""

from math import isfinite
from typing import NamedTuple

import flint
import numpy as np
from flint import arb

from . import float_filter
from .balls import (
    BITS,
    add,
    cross,
    dot,
    finite,
    greatest,
    least,
    mul,
    norm,
    number,
    rational,
    transposed,
    vector,
)
from .geometry import Pair, Points, centre, elements, parts, support

FRAMES = ("W", "A", "B")


class Check(NamedTuple):
    """ok: the certificate proves the label, its bracket, its start and end, and its gap if
    positive. reason: else why not.
    """

    ok: bool
    reason: str = ""


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


def check(query, truth) -> Check:
    """Verify a Truth about a Query. Never raises; refuses what it cannot verify. An uncertain
    label makes no claim.
    """
    return check_many([(query, truth)])[0]


def check_many(labelled, doubles=True) -> list[Check]:
    """`check` for (query, truth) pairs, with the double arithmetic in one batch. doubles=False:
    everything by balls (slow).
    """
    verdicts, owed = [], []
    for i, (query, truth) in enumerate(labelled):
        found, verdict = _refusal(_owed, query, truth)
        owed += [(i, o) for o in found or ()]
        verdicts.append(verdict)
    open_ = _settled([o for _, o in owed]) if doubles else _all_open(owed)
    for j, *undecided in open_:
        i, o = owed[j]
        if verdicts[i].ok:
            _, verdicts[i] = _refusal(_shown, o, *undecided)
    return verdicts


def _settled(owed):
    """The obligations that doubles leave open. If the batch fails, all of them: balls then
    settle each one separately, so a forged certificate is refused without affecting the others.
    """
    try:
        return float_filter.settle(owed)
    except Exception:
        return _all_open(owed)


def _all_open(owed):
    return [(j, None, None) for j in range(len(owed))]


def _owed(query, truth):
    return list(obligations(Pair(query), truth, truth.certificate))


def _shown(o, *undecided):
    return {Apart: apart, Within: within, Without: without}[type(o)](o, *undecided)


def _refusal(work, *given):
    """work(*given) and its verdict: refused if it raises, whatever error a forged certificate
    causes.
    """
    try:
        with flint.ctx.workprec(BITS):
            return work(*given), Check(True)
    except Refused as refusal:
        return None, Check(False, str(refusal))
    except Exception as error:
        words = f"{type(error).__name__}: {error}"
        return None, Check(False, f"malformed certificate ({words[:200]})")


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
