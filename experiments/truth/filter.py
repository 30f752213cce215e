"""The checker's doubles: settles an obligation only by more than its rounding error, in batches; the rest is left to the balls.

Error of n.x(t) in double: at most E = 256 u (1 + |theta|) |n|_1 reach, u = 2**-53, reach >= |v|_1 + |b|_1 + |dp|_1 + |d|_1.
(Rotation entries 10 u, products and sums of three 6 u, sin and cos of a rounded theta t 2 u + 2 u |theta|, turn about k 40 u,
dp and t d rounded once each: together below 128 u.) Sums that may have been rounded below 2**-1022 are left to the balls.
"""

from __future__ import annotations

import numpy as np

from . import checker, geometry
from .balls import add, nearest_double, number, rotation, vector

UNIT = 2.0**-53


def settle(obligations) -> list[tuple]:
    """(j, vertices, near) for each obligation j that doubles leave open; indices of what is open in it, None for all."""
    apart = [(j, o) for j, o in enumerate(obligations) if type(o) is checker.Apart]
    points = [(j, o) for j, o in enumerate(obligations) if type(o) is not checker.Apart]
    with np.errstate(all="ignore"):
        return sorted(_apart(apart) + _points(points), key=lambda entry: entry[0])


class Numbers:
    """The pairs' numbers, a row each: RA, RB (n, 3, 3), dp, d, k (n, 3), theta, reach (n,)."""

    def __init__(self, pairs):
        seen = {}
        index = [seen.setdefault(id(p), len(seen)) for p in pairs]
        rows = np.array([p.row for p in {id(p): p for p in pairs}.values()])
        k = rows[:, 14:17]
        self.RA, self.RB, self.dp, self.d, self.k, self.theta, self.reach = (
            x[index]
            for x in (
                _rotation(rows[:, 0:4]),
                _rotation(rows[:, 4:8]),
                rows[:, 8:11],
                rows[:, 11:14],
                k / np.where(k.any(1), _norm(k), 1.0)[:, None],
                rows[:, 17],
                rows[:, 18],
            )
        )


def _apart(jobs) -> list[tuple]:
    if not jobs:
        return []
    os = [o for _, o in jobs]
    N = Numbers([o.pair for o in os])
    RA, RB, dp, d, k, theta, reach = N.RA, N.RB, N.dp, N.d, N.k, N.theta, N.reach
    n = np.array([o.n if all(type(c) is float for c in o.n) else [nearest_double(c) for c in o.n] for o in os])
    s, e, turning, gap = (np.array(column) for column in zip(*[(*o[3:6], o[7]) for o in os]))
    error = 256 * UNIT * (1 + np.abs(theta)) * np.abs(n).sum(1) * reach
    margin = gap * _norm(n) * (1 + 8 * UNIT) + 2 * error

    Ps, Qs = [o.A if o.turning else o.B for o in os], [o.B if o.turning else o.A for o in os]
    p_first, p_of = _rows(Ps)
    q_first, q_of = _rows(Qs)
    RP, RQ = (np.where(turning[:, None, None], x, y) for x, y in ((RA, RB), (RB, RA)))
    sign = np.where(turning, 1.0, -1.0)
    key = _products(Ps, _apply(RP, n) * sign[:, None], p_of)
    top = np.maximum.reduceat(key, p_first)
    fixed = np.where(turning, -top, (dp * n).sum(1) - top)

    ends = []
    for t in (s, e):
        w = _turned(np.where(turning, 1.0, -1.0) * theta * t, k, n)
        shift = dp - t[:, None] * d
        c = fixed + np.where(turning, (shift * w).sum(1), -t * (d * n).sum(1))
        ends.append((c - margin)[q_of] + _products(Qs, _apply(RQ, w) * sign[:, None], q_of))
        if (s == e).all():
            ends.append(ends[0])
            break
    low, high = np.minimum(*ends), np.maximum(*ends)
    bend = 0.0
    if theta.any() and (e > s).any():
        Q, kQ, arms = np.concatenate(Qs), _apply(RQ, k), []
        for t in (s, e):
            offset = np.where(turning[:, None], _apply(RQ, dp - t[:, None] * d), 0.0)
            arms.append(_norm(_cross(kQ[q_of], Q + offset[q_of])))
        slide = np.where(turning, 2 * np.abs(theta) * _norm(_cross(k, d)), 0.0)
        bound = _norm(_cross(n, k))[q_of] * (theta[q_of] ** 2 * np.maximum(*arms) + slide[q_of])
        bend = (bound * (1 + 1e-9) + ((theta**2 + np.abs(theta)) * error)[q_of]) * (((e - s) + 4 * UNIT) ** 2 / 2)[q_of]
    sure = (low > 0) & (high + 3 * low > bend) & ((error > 1e-140) & (error < 1e140))[q_of]
    open_ = []
    for i in np.flatnonzero(~np.logical_and.reduceat(sure, q_first)):
        mine, of = slice(q_first[i], q_first[i] + len(os[i].B if os[i].turning else os[i].A)), p_first[i]
        keys = key[of : of + len(os[i].A if os[i].turning else os[i].B)]
        trusted = 1e-140 < error[i] < 1e140
        open_.append(
            (jobs[i][0], np.flatnonzero(~sure[mine]), np.flatnonzero(keys >= top[i] - 4 * error[i]) if trusted else None)
        )
    return open_


def _points(jobs) -> list[tuple]:
    """Points strictly inside or outside: carried into the body's frame, y with error rho; then tetrahedra and meshes."""
    if not jobs:
        return []
    os = [o for _, o in jobs]
    N = Numbers([o.pair for o in os])
    vertex = np.array([type(o) is checker.Without for o in os])
    of_b, t = np.array([o.of_b for o in os]), np.array([o.t for o in os])
    x = np.array([o.v if type(o) is checker.Without else _offset(o) for o in os])
    span = N.reach + np.abs(x).sum(1)
    shift = t[:, None] * N.d
    b = np.where(vertex[:, None], _apply(N.RB.transpose(0, 2, 1), x) + N.dp, x) - shift  # Without: B's vertex seen from A
    a = _turned(N.theta * t, N.k, _apply(N.RA.transpose(0, 2, 1), x)) + shift - N.dp  # Without: A's vertex seen from B
    in_a = _apply(N.RA, _turned(-N.theta * t, N.k, b))
    in_b = _apply(N.RB, np.where(vertex[:, None], a, x))
    y = np.where((vertex == of_b)[:, None], in_a, in_b)
    rho = 256 * UNIT * (1 + np.abs(N.theta)) * span
    solid = np.array([getattr(o, "corners", None) is not None for o in os])
    open_ = ~solid
    if solid.any():
        open_[solid] = ~_in_tetrahedra(np.array([os[i].corners for i in np.flatnonzero(solid)]), y[solid], rho[solid])
    for i in np.flatnonzero(~solid):
        o = os[i]
        mesh = o.pair.a if vertex[i] == of_b[i] else o.pair.b
        count = winding(mesh, y[i], rho[i])
        open_[i] = count is None or (count != 0) == vertex[i]
    return [(jobs[i][0], None, None) for i in np.flatnonzero(open_)]


def _in_tetrahedra(corners, y, rho):
    """Four determinants of corners relative to y have one sign, each by more than 32 L^2 (rho + 8 u L)."""
    w = corners - y[:, None, :]
    L = np.abs(w).max(axis=(1, 2)) + rho
    bound = 32 * L * L * (rho + 8 * UNIT * L)
    c01, c23 = _cross(w[:, 0], w[:, 1]), _cross(w[:, 2], w[:, 3])
    dets = np.stack([(w[:, 1] * c23).sum(1), -(w[:, 0] * c23).sum(1), (c01 * w[:, 3]).sum(1), -(c01 * w[:, 2]).sum(1)], 1)
    return ((dets > bound[:, None]).all(1) | (dets < -bound[:, None]).all(1)) & (bound > 1e-140) & (bound < 1e140)


def _offset(o):
    """x - p of the body in doubles, each coordinate rounded once."""
    position = (o.pair.query.pose_b if o.of_b else o.pair.query.pose_a).position.tolist()
    if all(type(c) is float for c in o.x):
        return [c - p for c, p in zip(o.x, position)]
    return [nearest_double(c) for c in add([number(c) for c in o.x], vector(position), -1)]


def winding(mesh, y, rho):
    """Winding number of a mesh about y, each coordinate of which is off by at most rho; None where doubles cannot tell."""
    low, high = geometry.face_boxes(mesh)
    for axis in range(3):
        i, j = (axis + 1) % 3, (axis + 2) % 3
        met = np.flatnonzero(
            (low[i] <= y[i] + rho)
            & (high[i] >= y[i] - rho)
            & (low[j] <= y[j] + rho)
            & (high[j] >= y[j] - rho)
            & (high[axis] >= y[axis] - rho)
        )
        if not len(met):
            return 0
        w = mesh.vertices[mesh.faces[met]] - y
        L = np.abs(w).max(axis=(1, 2)) + rho
        bound = 32 * L * (rho + 8 * UNIT * L)
        edges = np.stack([w[:, c, i] * w[:, (c + 1) % 3, j] - w[:, c, j] * w[:, (c + 1) % 3, i] for c in range(3)], 1)
        volume = (w[:, 0] * _cross(w[:, 1], w[:, 2])).sum(1)
        up, down = edges > bound[:, None], edges < -bound[:, None]
        missed = up.any(1) & down.any(1)
        told = (up.all(1) | down.all(1)) & (np.abs(volume) > L * bound) & (bound > 1e-140)
        if (missed | told).all():
            forward = told & (up[:, 0] == (volume > 0))
            return int(up[forward, 0].sum()) - int(down[forward, 0].sum())
    return None


def crossed(mesh, y, ray) -> np.ndarray:
    """(m,) bool: the faces that the line through y (rationals or balls) along `ray` may cross, as far as doubles can tell."""
    y0 = np.array([nearest_double(c) if not hasattr(c, "mid") else float(c.mid()) for c in y])
    blur = sum(float(c.rad()) for c in y if hasattr(c, "rad")) * 2
    w = mesh.vertices - y0
    reach = geometry.reach(mesh) + np.abs(y0).sum()
    rho = 8 * UNIT * reach + blur
    wf = w[mesh.faces]
    side = np.stack([_cross(wf[:, i], wf[:, (i + 1) % 3]) @ np.array(ray, float) for i in range(3)], 1)
    L = np.abs(w).sum(1)[mesh.faces].max(1) + rho
    bound = (16 * np.abs(ray).sum() * L * (rho + 8 * UNIT * L))[:, None]
    if not 1e-140 < bound.min() < 1e140:
        return np.ones(len(mesh.faces), bool)
    return ~((side > bound).any(1) & (side < -bound).any(1))


def _rows(arrays):
    """Of all arrays' rows in one block: the first row of each array, and the array that each row is of."""
    counts = np.array([len(a) for a in arrays])
    return np.cumsum(counts) - counts, np.repeat(np.arange(len(arrays)), counts)


def _products(arrays, n, of):
    """Each row of arrays[i] times n[i], in one block."""
    if len(of) > 300 * len(arrays):
        return np.concatenate([a @ v for a, v in zip(arrays, n)])
    X, n = np.concatenate(arrays), n[of]
    return X[:, 0] * n[:, 0] + X[:, 1] * n[:, 1] + X[:, 2] * n[:, 2]


def _rotation(q):
    """(n, 4) -> (n, 3, 3), rows of N(q) / |q|^2."""
    w, x, y, z = (q / np.abs(q).max(1)[:, None]).T
    return np.moveaxis(np.array(rotation(w, x, y, z)), 2, 0)


def _apply(R, v):
    """Transposed rotation times vector, row by row."""
    return np.einsum("tij,ti->tj", R, v)


def _cross(a, b):
    return np.stack(
        [a[:, 1] * b[:, 2] - a[:, 2] * b[:, 1], a[:, 2] * b[:, 0] - a[:, 0] * b[:, 2], a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]], 1
    )


def _norm(x):
    return np.sqrt((x * x).sum(-1))


def _turned(angle, k, v):
    """Rot(k, angle) v, row by row."""
    c, s = np.cos(angle)[:, None], np.sin(angle)[:, None]
    return v * c + _cross(k, v) * s + k * ((k * v).sum(1)[:, None] * (1 - c))
