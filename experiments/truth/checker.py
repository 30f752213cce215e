"""The independent checker: it believes a label only by its certificate. Imports no prover and no engine.

Body frame points v, b; world x(t) = p_A + t d + Rot(k/|k|, theta t) R(q_A) v; B at rest. All lengths relative to p_A. Every
claim is settled by a double with an error bound, or else by balls of 256 bits (Arb). Certificate: see README.md beside this.
"""

from dataclasses import dataclass

import flint
import numpy as np
from flint import arb, fmpq

UNIT, BITS = 2.0**-53, 256
RAYS = ((1, 0, 0), (0, 1, 0), (0, 0, 1), (3, 5, 7), (-7, 4, 3), (5, -8, 6), (-2, -7, 9))


@dataclass(frozen=True)
class Check:
    """ok: the certificate proves the label, its bracket, its start and end, and its positive gap. reason: else why not."""

    ok: bool
    reason: str = ""


class Refused(Exception):
    pass


def check(query, truth) -> Check:
    """Verify a Truth about a Query from its certificate alone. Never raises; refuses what it cannot verify."""
    try:
        with flint.ctx.workprec(BITS):
            return _check(Pair(query), truth, truth.certificate, query.question != "overlap")
    except Refused as refusal:
        return Check(False, str(refusal))
    except (KeyError, TypeError, ValueError, IndexError, AttributeError, ArithmeticError) as error:
        return Check(False, f"malformed certificate ({type(error).__name__}: {error})")


def _check(pair, truth, c, sweep):
    if truth.label == "uncertain":
        return Check(True)
    if truth.label == "clear":
        _require(truth.start == truth.end == "clear" and not truth.gap < 0, "a clear label starts and ends clear")
        _require(np.isnan(truth.t_lo) and np.isnan(truth.t_hi), "a clear label has no time of impact")
        clear(pair, c["clear"], 0.0, float(sweep), max(truth.gap, 0.0) if truth.gap == truth.gap else 0.0)
        return Check(True)
    _require(truth.label == "hit" and not truth.gap > 0, f"label {truth.label} with gap {truth.gap}")
    if not sweep:
        _require(truth.start == truth.end == "hit" and np.isnan(truth.t_lo) and np.isnan(truth.t_hi), "an overlap has no times")
        hit(pair, c["hit"], 0.0)
        return Check(True)
    _require(0 <= truth.t_lo <= truth.t_hi <= 1, "the bracket lies outside [0, 1]")
    hit(pair, c["hit"], truth.t_hi)
    if truth.start == "clear":
        clear(pair, c["clear"], 0.0, truth.t_lo, 0.0)
    else:
        _require(truth.start == "hit" and truth.t_hi == 0, "a bracket needs a certified start")
    if truth.end == "clear":
        clear(pair, c["end_clear"], 1.0, 1.0, 0.0)
    elif truth.end == "hit":
        hit(pair, c["end_hit"], 1.0)
    else:
        _require(truth.end == "uncertain", f"unknown end {truth.end}")
    if "exact" in c:
        exact(pair, c["exact"], truth.t_lo, truth.t_hi)
    return Check(True)


class Pair:
    """Both bodies as lists of convex elements (hull, pieces or triangles), the poses and the motion; floats and balls of them."""

    def __init__(self, query):
        self.query, m = query, query.motion
        self.a, self.b = query.a, query.b
        self.d, self.theta = m.displacement, float(m.angle)
        self.dp = query.pose_b.position - query.pose_a.position
        self.k = m.axis / np.sqrt(m.axis @ m.axis) if self.theta else np.zeros(3)
        self.RA, self.RB = (rotation(*p.quaternion.tolist()) for p in (query.pose_a, query.pose_b))
        self.reach = _reach(query.a) + _reach(query.b) + np.abs(self.dp).sum() + np.abs(self.d).sum()
        self.unit = 256 * UNIT * (1 + abs(self.theta)) * self.reach  # times |n|_1: bounds the error of n.x in double
        self._exact = None

    def turn(self, t, n):
        """Rot(k, theta t) n in double."""
        c, s = np.cos(self.theta * t), np.sin(self.theta * t)
        kx, ky, kz = self.k
        nx, ny, nz = n
        return n * c + np.array([ky * nz - kz * ny, kz * nx - kx * nz, kx * ny - ky * nx]) * s + self.k * ((self.k @ n) * (1 - c))

    def exact(self):
        """(RA, RB, dp, d) as rationals, the axis and theta as balls."""
        if self._exact is None:
            q, m = self.query, self.query.motion
            RA, RB = (rotation(*map(rational, p.quaternion)) for p in (q.pose_a, q.pose_b))
            dp = [rational(b) - rational(a) for a, b in zip(q.pose_a.position, q.pose_b.position)]
            k = [arb(rational(x)) for x in m.axis]
            length = sum(x * x for x in k).sqrt()
            self._exact = RA, RB, dp, [rational(x) for x in m.displacement], [x / length for x in k] if self.theta else k
        return self._exact

    def turn_ball(self, t, n):
        if not self.theta or not t:
            return n
        k = self.exact()[4]
        s, c = (arb(self.theta) * arb(t)).sin_cos()
        kn = dot(k, n) * (1 - c)
        return [x * c + y * s + z * kn for x, y, z in zip(n, cross(k, n), k)]


def clear(pair, cert, start, end, gap):
    """Every element of A is apart from every element of B by more than `gap` over [start, end], and neither contains the other."""
    orders = [np.asarray(cert.get(key, np.arange(_count(body)))) for key, body in (("order_a", pair.a), ("order_b", pair.b))]
    for order, body in zip(orders, (pair.a, pair.b)):
        _require(np.array_equal(np.sort(order), np.arange(_count(body))), "the order is no permutation of the elements")
    stack = [(cert["tree"], (0, len(orders[0])), (0, len(orders[1])), start, True)]
    while stack:
        (segments, split), ra, rb, s, first = stack.pop()
        for e, frame, *n in segments:
            _require(s <= e and len(n) == 3 and frame in ("W", "A"), "segments are out of order")
            A, B = _points(pair.a, orders[0][slice(*ra)]), _points(pair.b, orders[1][slice(*rb)])
            _require(leaf(pair, A, B, s, e, frame, n, gap), f"plane {n} does not separate elements {ra}, {rb} over [{s}, {e}]")
            s, first = e, False
        if s < end or first:
            _require(split is not None, f"elements {ra}, {rb} are not shown apart from {s} on")
            side, cuts, children = split
            lo, hi = ra if side == "a" else rb
            ends = [lo, *cuts, hi]
            _require(side in ("a", "b") and len(children) == len(ends) - 1 and all(x < y for x, y in zip(ends, ends[1:])), "bad split")
            for x, y, child in zip(ends, ends[1:], children):
                stack.append((child, (x, y), rb, s, first) if side == "a" else (child, ra, (x, y), s, first))
    for solid, other, back in ((pair.a, pair.b, False), (pair.b, pair.a, True)):
        if solid.kind == "mesh":  # surfaces apart: one point of each connected part of the other decides its containment
            for v in _one_point_each(other):
                _require(winding(solid, pair_point(pair, v, start, back)) == 0, "a body may contain a part of the other")


def leaf(pair, A, B, s, e, frame, n, gap):
    """n separates A from B by gap |n| over [s, e]; |f''| <= M, so f >= chord - (M h^2 / 2) x (1 - x), h = e - s."""
    nf = np.array([float(number(x)) for x in n])
    margin, error = gap * np.sqrt(nf @ nf), pair.unit * np.abs(nf).sum()
    h = (e - s) + 4 * UNIT
    P, Q, turned = (B, A, False) if frame == "W" else (A, B, True)  # P fixed in the frame of n: c is its support
    if turned:
        c = (P @ (pair.RA.T @ nf)).max()
        rows = [(pair.turn(t, nf), t) for t in (s, e)]
        f = [Q @ (pair.RB.T @ w) + ((pair.dp - t * pair.d) @ w - c) for w, t in rows]
    else:
        pb = P @ (pair.RB.T @ nf)
        c = pb.min() + pair.dp @ nf
        f = [(c - t * (pair.d @ nf)) - Q @ (pair.RA.T @ pair.turn(-t, nf)) for t in (s, e)]
    bend = 0.0
    if pair.theta and e > s:
        nk = _norm(np.cross(nf, pair.k))
        if turned:
            w = Q @ pair.RB.T + pair.dp
            arm = np.maximum(*(_norm(np.cross(pair.k, w - t * pair.d)) for t in (s, e)))
            M = nk * (pair.theta**2 * arm + 2 * abs(pair.theta) * _norm(np.cross(pair.k, pair.d)))
        else:
            M = nk * pair.theta**2 * _norm(np.cross(pair.RA.T @ pair.k, Q))
        bend = (M * (1 + 1e-9) + pair.theta**2 * error) * (h * h / 2)
    slack = 2 * error + 4 * UNIT * margin
    lo, hi = np.minimum(*f) - margin - slack, np.maximum(*f) - margin - slack
    sure = (lo > 0) & (hi + 3 * lo > bend) & (1e-140 < error < 1e140)
    if sure.all():
        return True
    # P's supports: all that the doubles cannot tell from the best one. Q: the vertices not settled above.
    key = P @ (pair.RA.T @ nf) if turned else -pb
    near = P[key >= key.max() - 4 * error] if 1e-140 < error < 1e140 else P
    return all(leaf_ball(pair, v, near, s, e, turned, n, gap) for v in Q[~sure])


def leaf_ball(pair, v, P, s, e, turned, n, gap):
    """The same for one vertex v, in balls; P: candidates for the support of the side whose frame the plane keeps."""
    RA, RB, dp, d, k = pair.exact()
    n = [arb(number(x)) for x in n]
    length = dot(n, n).sqrt()
    if turned:
        c = maximum([dot(n, mul(RA, p)) for p in P])
        b = [x + y for x, y in zip(mul(RB, v), dp)]
        ws = [[x - arb(t) * y for x, y in zip(b, d)] for t in (s, e)]
        f = [dot(pair.turn_ball(t, n), w) - c for w, t in zip(ws, (s, e))]
        arm = maximum([norm(cross(k, w)) for w in ws]) * pair.theta**2 + 2 * abs(pair.theta) * norm(cross(k, d))
    else:
        c = -maximum([-dot(n, mul(RB, p)) for p in P]) + dot(n, dp)
        r = mul(RA, v)
        f = [c - arb(t) * dot(n, d) - dot(n, pair.turn_ball(t, r)) for t in (s, e)]
        arm = norm(cross(k, r)) * arb(pair.theta) ** 2
    f = [x - arb(gap) * length for x in f]
    bend = norm(cross(n, k)) * arm * (arb(e) - arb(s)) ** 2 / 2 if pair.theta and e > s else arb(0)
    return all(x > 0 for x in f) and -maximum([-x for x in f]) * 3 + maximum(f) > bend


def hit(pair, cert, t):
    """cert["point"], in the world, lies strictly inside both bodies at time t: in a tetrahedron of four vertices of a piece
    (cert["a"], cert["b"] = [piece, i, j, k, l]), or at a winding number other than 0 of a mesh (null)."""
    x = [number(c) for c in cert["point"]]
    for key, body, back in (("a", pair.a, False), ("b", pair.b, True)):
        if body.kind == "mesh":
            _require(winding(body, _to_body(pair, x, t, back)) != 0, f"the point is not inside mesh {key}")
        else:
            piece, *ids = cert[key]
            _require(len(set(ids)) == 4 and min(ids) >= 0 and piece >= 0, "four vertices make a tetrahedron")
            _require(in_tetrahedron(pair, body.pieces[piece].vertices[ids], x, t, back), f"the point is not inside tetrahedron {key}")


def in_tetrahedron(pair, corners, x, t, back):
    y = _to_body(pair, x, t, back)
    w = [[arb(rational(c)) - yi for c, yi in zip(v, y)] for v in corners]
    dets = [det(w[1], w[2], w[3]), -det(w[0], w[2], w[3]), det(w[0], w[1], w[3]), -det(w[0], w[1], w[2])]
    return all(z > 0 for z in dets) or all(z < 0 for z in dets)


def winding(mesh, y):
    """Winding number of a closed mesh about y (balls, body frame): signed crossings of a ray, all signs certain."""
    V = np.array([float(c.mid()) for c in y])
    for ray in RAYS:
        total = _winding(mesh, y, mesh.vertices - V, ray)
        if total is not None:
            return total
    raise Refused("the point lies on the surface, or every ray meets an edge")


def _winding(mesh, y, W, ray):
    tri, u = W[mesh.faces], np.array(ray, float)
    L = np.abs(W).max(axis=1)[mesh.faces].max(axis=1)
    Ly = np.abs(mesh.vertices).max() + np.abs(W).max()
    edge = np.stack([np.cross(tri[:, i], tri[:, (i + 1) % 3]) @ u for i in range(3)], axis=1)
    bound = 64 * UNIT * np.abs(u).sum() * L * Ly
    if not bound.min() > 1e-140:
        bound = np.full(len(bound), np.inf)
    volume = np.einsum("ij,ij->i", tri[:, 0], np.cross(tri[:, 1], tri[:, 2]))
    out = (edge > bound[:, None]).any(axis=1) & (edge < -bound[:, None]).any(axis=1)
    total = 0
    for i in np.flatnonzero(~out):
        side = sign(edge[i], bound[i])
        vol = sign([volume[i]], 64 * UNIT * L[i] * L[i] * Ly)
        if side is None or vol is None:
            w = [[arb(rational(c)) - yi for c, yi in zip(mesh.vertices[j], y)] for j in mesh.faces[i]]
            e3 = [dot([arb(z) for z in ray], cross(w[j], w[(j + 1) % 3])) for j in range(3)]
            if any(z > 0 for z in e3) and any(z < 0 for z in e3):
                continue
            side, vol = sign(e3, 0), sign([det(*w)], 0)
            if side is None or vol is None:
                return None
        total += side if side and side == vol else 0
    return total


def exact(pair, cert, t_lo, t_hi):
    """Rational time t* of a translation: plane n touches one element of each body at t*, and n.d > 0; in rationals throughout."""
    _require(not pair.theta, "an exact time is for translations")
    RA, RB, dp, d, _ = pair.exact()
    t, n = number(cert["time"]), [number(x) for x in cert["normal"]]
    A, B = ([[rational(c) for c in v] for v in body.pieces[cert[key]["piece"]].vertices] for key, body in (("a", pair.a), ("b", pair.b)))
    A, B = [mul(RA, v) for v in A], [[x + y for x, y in zip(mul(RB, v), dp)] for v in B]
    _require(rational(t_lo) <= t <= rational(t_hi), "the exact time lies outside its bracket")
    _require(dot(n, d) > 0 and min(dot(n, b) for b in B) - max(dot(n, a) for a in A) == t * dot(n, d), "the plane does not touch at t*")
    sums = []
    for key, X in (("a", A), ("b", B)):
        w = [number(x) for x in cert[key]["weights"]]
        _require(min(w) >= 0 and sum(w) == 1 and min(cert[key]["vertices"]) >= 0, "weights are not convex")
        sums.append([sum(wi * X[i][c] for wi, i in zip(w, cert[key]["vertices"], strict=True)) for c in range(3)])
    _require(all(b - a == t * z for a, b, z in zip(*sums, d)), "the weights do not touch at t*")


def pair_point(pair, v, t, from_a):
    """A body point of one body (of A if from_a) in the body frame of the other, at time t; balls."""
    RA, RB, dp, d, _ = pair.exact()
    v = [rational(c) for c in v]
    if from_a:
        world = [x + arb(t) * y for x, y in zip(pair.turn_ball(t, [arb(z) for z in mul(RA, v)]), d)]
        return [dot(row, [x - y for x, y in zip(world, dp)]) for row in zip(*RB)]
    world = [x + y - arb(t) * z for x, y, z in zip(mul(RB, v), dp, d)]
    return [dot(row, pair.turn_ball(-t, world)) for row in zip(*RA)]


def _to_body(pair, x, t, of_b):
    """World point x (rationals) in the frame of B, or of A at time t; balls."""
    RA, RB, _, d, _ = pair.exact()
    pose = pair.query.pose_b if of_b else pair.query.pose_a
    x = [arb(xi - rational(p)) for xi, p in zip(x, pose.position)]
    x = x if of_b else pair.turn_ball(-t, [xi - arb(t) * di for xi, di in zip(x, d)])
    return [dot(row, x) for row in zip(*(RB if of_b else RA))]


def _count(body):
    return len(body.faces) if body.kind == "mesh" else len(body.pieces)


def _points(body, ids):
    if body.kind == "mesh":
        return body.vertices[np.unique(body.faces[ids])]
    return body.pieces[ids[0]].vertices if len(ids) == 1 else np.concatenate([body.pieces[i].vertices for i in ids])


def _one_point_each(body):
    """One vertex of each convex piece, or of each edge-connected part of a mesh."""
    if body.kind != "mesh":
        return [p.vertices[0] for p in body.pieces]
    part = np.arange(len(body.vertices))
    while True:
        low = part[body.faces].min(axis=1)
        before = part.copy()
        for i in range(3):
            np.minimum.at(part, body.faces[:, i], low)
        part = part[part]
        if np.array_equal(part, before):
            return body.vertices[np.unique(part[body.faces])]


def _reach(body):
    return float(np.abs(body.vertices).max()) * 3


def rotation(w, x, y, z):
    """N(q) / |q|^2 in the arithmetic of its arguments."""
    s = w * w + x * x + y * y + z * z
    R = [[w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
         [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
         [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z]]
    R = [[c / s for c in row] for row in R]
    return np.array(R) if isinstance(w, float) else R


def rational(x):
    return fmpq(*float(x).as_integer_ratio())


def number(x):
    """A number of a certificate: a double, an integer, or a rational "p/q" or "p"."""
    if isinstance(x, str):
        p, _, q = x.partition("/")
        return fmpq(int(p), int(q or 1))
    return fmpq(x) if isinstance(x, int) else rational(x)


def sign(values, bound):
    """1 or -1 if all values certainly have this sign, 0 if two certainly differ, None if unknown."""
    up, down = [z > bound for z in values], [z < -bound for z in values]
    return 0 if any(up) and any(down) else 1 if all(up) else -1 if all(down) else None


def mul(R, v):
    return [sum(c * (x if not isinstance(x, float) else rational(x)) for c, x in zip(row, v)) for row in R]


def dot(x, y):
    return sum((a * b for a, b in zip(x, y)), fmpq(0))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def det(a, b, c):
    return dot(a, cross(b, c))


def norm(x):
    """Upper and lower: the square root of a ball that contains 0 is taken of its upper end."""
    s = arb(dot(x, x))
    return s.sqrt() if s > 0 else arb(0, s.abs_upper().sqrt().abs_upper())


def maximum(values):
    best = arb(values[0])
    for x in values[1:]:
        best = best.max(arb(x))
    return best


def _norm(x):
    return np.sqrt((x * x).sum(axis=-1))


def _require(fact, reason):
    if not fact:
        raise Refused(reason)
