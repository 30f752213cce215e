"""The checker's doubles: settles an obligation only by more than its rounding error, in batches; the rest is left to the balls.

Error of n.x(t) in double: at most E = 256 u (1 + |theta|) |n|_1 reach, u = 2**-53, `reach` bounding |v|_1 + |b|_1 + |dp|_1 + |d|_1.
(Rotation entries 10 u, products and sums of three 6 u, sin and cos of a rounded theta t: 2 u + 2 u |theta|, the turn about k 40 u,
dp and t d rounded once each: together below 128 u.) Sums that may have been rounded below 2**-1022 are left to the balls.
"""

from __future__ import annotations

import numpy as np

from . import checker, geometry
from .balls import add, nearest_double, vector

UNIT = 2.0**-53


def settle(obligations) -> list[tuple]:
    """(j, vertices, near) for each obligation j that doubles leave open; indices of what is open in it, None for all."""
    groups = {kind: [(j, o) for j, o in enumerate(obligations) if type(o) is kind] for kind in (checker.Apart, checker.Within)}
    left = [(j, None, None) for j, o in enumerate(obligations) if type(o) is checker.Without and not _outside_box(o)]
    with np.errstate(all="ignore"):
        left += _apart(groups[checker.Apart]) + _within(groups[checker.Within])
    return sorted(left, key=lambda entry: entry[0])


def _apart(jobs) -> list[tuple]:
    if not jobs:
        return []
    os = [o for _, o in jobs]
    pairs, index = _unique([o.pair for o in os])
    RA, RB, dp, d, k = (np.array([getattr(p, name) for p in pairs])[index] for name in ("RA", "RB", "dp", "d", "k"))
    theta, reach = np.array([(p.theta, p.reach) for p in pairs])[index].T
    n = np.array([[nearest_double(c) for c in o.n] for o in os])
    s, e, gap, turning = (np.array(column) for column in zip(*((o.s, o.e, o.gap, o.turning) for o in os)))
    error = 256 * UNIT * (1 + np.abs(theta)) * np.abs(n).sum(1) * reach
    margin = gap * _norm(n) * (1 + 8 * UNIT) + 2 * error

    P, p_first, p_of = _blocks([o.A if o.turning else o.B for o in os])
    Q, q_first, q_of = _blocks([o.B if o.turning else o.A for o in os])
    RP, RQ = (np.where(turning[:, None, None], x, y) for x, y in ((RA, RB), (RB, RA)))
    sign = np.where(turning, 1.0, -1.0)
    key = _along(P, (_apply(RP, n) * sign[:, None])[p_of])
    top = np.maximum.reduceat(key, p_first)
    fixed = np.where(turning, -top, (dp * n).sum(1) - top)

    ends = []
    for t in (s, e):
        w = _turned(np.where(turning, 1.0, -1.0) * theta * t, k, n)
        shift = dp - t[:, None] * d
        c = fixed + np.where(turning, (shift * w).sum(1), -t * (d * n).sum(1))
        ends.append(c[q_of] + _along(Q, (_apply(RQ, w) * sign[:, None])[q_of]) - margin[q_of])
    low, high = np.minimum(*ends), np.maximum(*ends)
    bend = 0.0
    if theta.any() and (e > s).any():
        kQ, arms = _apply(RQ, k), []
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
        keys = key[of:of + len(os[i].A if os[i].turning else os[i].B)]
        trusted = 1e-140 < error[i] < 1e140
        open_.append((jobs[i][0], np.flatnonzero(~sure[mine]), np.flatnonzero(keys >= top[i] - 4 * error[i]) if trusted else None))
    return open_


def _within(jobs) -> list[tuple]:
    """Tetrahedra: the signs of four determinants of corners relative to the point, each by more than 32 L^2 (rho + 8 u L)."""
    left = [(j, None, None) for j, o in jobs if o.corners is None]
    jobs = [(j, o) for j, o in jobs if o.corners is not None]
    if not jobs:
        return left
    x, k, R, d, size = [], [], [], [], []
    for _, o in jobs:
        pair, pose = o.pair, o.pair.query.pose_b if o.of_b else o.pair.query.pose_a
        x.append([nearest_double(c) for c in add(o.x, vector(pose.position), -1)])
        k.append(pair.k)
        R.append(pair.RB if o.of_b else pair.RA)
        d.append(np.zeros(3) if o.of_b else pair.d)
        size.append((0.0 if o.of_b else -pair.theta * o.t, o.t, pair.reach, pair.theta))
    x, k, R, d, (angle, t, reach, theta) = np.array(x), np.array(k), np.array(R), np.array(d), np.array(size).T
    y = _apply(R, _turned(angle, k, x - t[:, None] * d))
    w = np.array([o.corners for _, o in jobs]) - y[:, None, :]
    rho = 256 * UNIT * (1 + np.abs(theta)) * (reach + np.abs(x).sum(1))
    L = np.abs(w).max(axis=(1, 2)) + rho
    bound = 32 * L * L * (rho + 8 * UNIT * L)
    c01, c23 = _cross(w[:, 0], w[:, 1]), _cross(w[:, 2], w[:, 3])
    dets = np.stack([(w[:, 1] * c23).sum(1), -(w[:, 0] * c23).sum(1), (c01 * w[:, 3]).sum(1), -(c01 * w[:, 2]).sum(1)], 1)
    sure = ((dets > bound[:, None]).all(1) | (dets < -bound[:, None]).all(1)) & (bound > 1e-140) & (bound < 1e140)
    return left + [(jobs[i][0], None, None) for i in np.flatnonzero(~sure)]


def _outside_box(o) -> bool:
    """Is the vertex outside the bounding box of the mesh's vertices?"""
    pair, t = o.pair, o.t
    if o.of_b:
        mesh, y = pair.a, pair.RA.T @ _turned(np.array([-pair.theta * t]), pair.k[None], (pair.RB @ o.v + pair.dp - t * pair.d)[None])[0]
    else:
        mesh, y = pair.b, pair.RB.T @ (_turned(np.array([pair.theta * t]), pair.k[None], (pair.RA @ o.v)[None])[0] + t * pair.d - pair.dp)
    error = 256 * UNIT * (1 + abs(pair.theta)) * pair.reach
    return bool(((y > mesh.vertices.max(0) + error) | (y < mesh.vertices.min(0) - error)).any())


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


def _blocks(arrays):
    """All rows in one block, the first row of each array, and the array that each row is of."""
    counts = np.array([len(a) for a in arrays])
    return np.concatenate(arrays), np.concatenate([[0], np.cumsum(counts)[:-1]]), np.repeat(np.arange(len(arrays)), counts)


def _unique(pairs):
    seen = {}
    index = [seen.setdefault(id(p), len(seen)) for p in pairs]
    return list({id(p): p for p in pairs}.values()), np.array(index)


def _apply(R, v):
    """Transposed rotation times vector, row by row."""
    return np.einsum("tij,ti->tj", R, v)


def _along(X, n):
    return X[:, 0] * n[:, 0] + X[:, 1] * n[:, 1] + X[:, 2] * n[:, 2]


def _cross(a, b):
    return np.stack([a[:, 1] * b[:, 2] - a[:, 2] * b[:, 1], a[:, 2] * b[:, 0] - a[:, 0] * b[:, 2],
                     a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]], 1)


def _norm(x):
    return np.sqrt((x * x).sum(-1))


def _turned(angle, k, v):
    """Rot(k, angle) v, row by row."""
    c, s = np.cos(angle)[:, None], np.sin(angle)[:, None]
    return v * c + _cross(k, v) * s + k * ((k * v).sum(1)[:, None] * (1 - c))
