# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The checker's filter in doubles: settles an obligation only by more than its rounding error, in
batches; the rest is left to the balls.

Error of n.x(t) in double: at most E = 256 u (1 + |theta_A| + |theta_B|) |n|_1 reach, u = 2**-53,
reach >= |v|_1 + |b|_1 + |about_A|_1 + |about_B|_1 + |dp|_1 + |d|_1. (Rotation entries 10 u,
products and sums of three 6 u, sin and cos of a rounded theta t 2 u + 2 u |theta|, a rotation about
k 40 u and at most two of them, dp, d, t d and v - about rounded once each: together below 128 u.)
Sums that may have been rounded below 2**-1022 are left to the balls.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from . import geometry
from .balls import add, nearest_double, number, rational, rotation, vector
from .obligations import Apart, Without

UNIT = 2.0**-53


def settle(obligations) -> list[tuple]:
    """(j, vertices, near) for each obligation j that doubles leave open; the indices of its open
    parts, None for all.
    """
    apart = [(j, o) for j, o in enumerate(obligations) if type(o) is Apart]
    points = [(j, o) for j, o in enumerate(obligations) if type(o) is not Apart]
    with np.errstate(all="ignore"):
        return sorted(_apart(apart) + _points(points), key=lambda entry: entry[0])


class Side(NamedTuple):
    """A body's numbers, a row per obligation: R (n, 3, 3), about, k (n, 3), theta (n,)."""

    R: np.ndarray
    about: np.ndarray
    k: np.ndarray
    theta: np.ndarray

    def where(self, here, other: Side) -> Side:
        """This side's rows where `here`, else the other's."""
        return Side(
            *(np.where(here.reshape(-1, *[1] * (x.ndim - 1)), x, y) for x, y in zip(self, other))
        )

    def turned(self, t, v):
        """Rot(k, theta t) v, row by row."""
        return _turned(self.theta * t, self.k, v) if self.theta.any() else v

    def spins(self, points, of):
        """(rows of `points`) |k x R (v - about)|."""
        return _norm(_cross(_apply(self.R, self.k)[of], points - self.about[of]))


class Numbers:
    """The pairs' numbers, a row per obligation: a, b (Side), dp, d (n, 3), reach, swing (n,): 1 +
    |theta_A| + |theta_B|.
    """

    def __init__(self, pairs):
        seen = {}
        index = [seen.setdefault(id(p), len(seen)) for p in pairs]
        rows = np.array([p.row for p in {id(p): p for p in pairs}.values()])
        ka, kb = (
            k / np.where(k.any(1), _norm(k), 1.0)[:, None] for k in (rows[:, 14:17], rows[:, 17:20])
        )
        self.a = Side(
            *(x[index] for x in (_rotation(rows[:, 0:4]), rows[:, 20:23], ka, rows[:, 26]))
        )
        self.b = Side(
            *(x[index] for x in (_rotation(rows[:, 4:8]), rows[:, 23:26], kb, rows[:, 27]))
        )
        self.dp, self.d, self.reach = (
            x[index] for x in (rows[:, 8:11], rows[:, 11:14], rows[:, 28])
        )
        self.swing = 1 + np.abs(self.a.theta) + np.abs(self.b.theta)


def _apart(jobs) -> list[tuple]:
    if not jobs:
        return []
    os = [o for _, o in jobs]
    N = Numbers([o.pair for o in os])
    n = np.array(
        [
            o.n if all(type(c) is float for c in o.n) else [nearest_double(c) for c in o.n]
            for o in os
        ]
    )
    s, e, gap = (np.array([getattr(o, name) for o in os]) for name in ("s", "e", "gap"))
    frame = np.array([o.frame for o in os])
    # Q, the side whose vertices are tested one by one, is B if the plane rotates with A
    on_b, fixed = (
        frame == "A",
        frame == "W",
    )
    P, Q, sign = N.a.where(on_b, N.b), N.b.where(on_b, N.a), np.where(on_b, 1.0, -1.0)
    error = 256 * UNIT * N.swing * np.abs(n).sum(1) * N.reach
    margin = gap * _norm(n) * (1 + 8 * UNIT) + 2 * error

    Ps, Qs = (
        [o.A if o.frame == "A" else o.B for o in os],
        [o.B if o.frame == "A" else o.A for o in os],
    )
    p_first, p_of = _rows(Ps)
    q_first, q_of = _rows(Qs)
    ends, keys, tops = [], [], []
    for t in (s, e):
        if t is e and (s == e).all():
            ends, keys, tops = 2 * ends, 2 * keys, 2 * tops
            break
        normal = np.where(fixed[:, None], n, P.turned(t, n))
        m = _apply(P.R, np.where(fixed[:, None], P.turned(-t, n), n)) * sign[:, None]
        keys.append(_products(Ps, m, p_of))
        tops.append(np.maximum.reduceat(keys[-1], p_first))
        line = _apply(Q.R, Q.turned(-t, normal)) * sign[:, None]
        shift = N.dp - t[:, None] * N.d
        c = (normal * shift).sum(1) - tops[-1] + (m * P.about).sum(1) - (line * Q.about).sum(1)
        ends.append((c - margin)[q_of] + _products(Qs, line, q_of))
    low, high = np.minimum(*ends), np.maximum(*ends)
    bend = 0.0
    if (N.swing > 1).any() and (e > s).any():
        M = _bend(
            N,
            P,
            Q,
            n,
            s,
            e,
            sign,
            fixed,
            (np.concatenate(Ps), p_first, p_of),
            (np.concatenate(Qs), q_of),
        )
        room = ((N.swing**2) * error)[q_of]
        bend = (M * (1 + 1e-9) + room) * (((e - s) + 4 * UNIT) ** 2 / 2)[q_of]
    sure = (low > 0) & (high + 3 * low > bend) & ((error > 1e-140) & (error < 1e140))[q_of]
    open_ = []
    for i in np.flatnonzero(~np.logical_and.reduceat(sure, q_first)):
        mine, its = (
            slice(first[i], first[i] + len(side[i]))
            for first, side in ((q_first, Qs), (p_first, Ps))
        )
        trusted = 1e-140 < error[i] < 1e140
        near = np.logical_or.reduce(
            [key[its] >= top[i] - 4 * error[i] for key, top in zip(keys, tops)]
        )
        open_.append(
            (jobs[i][0], np.flatnonzero(~sure[mine]), np.flatnonzero(near) if trusted else None)
        )
    return open_


def _bend(N, P, Q, n, s, e, sign, fixed, of_p, of_q):  # noqa: PLR0913 - the bound's symbols
    """The bound M of proof._bend, a row per vertex of Q. A fixed plane uses the reach of all
    of P, which needs no support.
    """
    points, q_of = of_q
    wP, wQ = np.abs(P.theta), np.abs(Q.theta)
    spin = Q.spins(points, q_of) if wQ.any() else np.zeros(len(points))
    M = (wQ**2 * _norm(_cross(n, Q.k)))[q_of] * spin
    if (wP[fixed] > 0).any():
        block, p_first, p_of = of_p
        reach = np.maximum.reduceat(P.spins(block, p_of), p_first)
        M = M + (wP**2 * _norm(_cross(n, P.k)) * reach)[q_of]
    if fixed.all():
        return M
    k, arm = _apply(Q.R, Q.turned(-s, P.k)), np.zeros(len(points))
    for t in (s, e):
        shift = sign[:, None] * (N.dp - t[:, None] * N.d)
        offset = _apply(Q.R, Q.turned(-s, shift)) - Q.about
        arm = np.maximum(arm, _norm(_cross(k[q_of], points + offset[q_of])))
    slide = _norm(_cross(P.k, N.d))
    spun = wQ[q_of] * spin
    turning = _norm(_cross(n, P.k))[q_of] * (
        (wP**2)[q_of] * (arm + (e - s)[q_of] * spun) + 2 * wP[q_of] * (slide[q_of] + spun)
    )
    return np.where(fixed[q_of], M, turning + (_norm(n) * wQ)[q_of] * spun)


def _points(jobs) -> list[tuple]:
    """Points strictly inside or outside: transformed into the body's frame, y with error rho;
    then tetrahedra and meshes.
    """
    if not jobs:
        return []
    os = [o for _, o in jobs]
    N = Numbers([o.pair for o in os])
    vertex = np.array([type(o) is Without for o in os])
    of_b, t = np.array([o.of_b for o in os]), np.array([o.t for o in os])
    x = np.array([o.v if type(o) is Without else _offset(o) for o in os])
    span = N.reach + np.abs(x).sum(1)
    between = N.dp - t[:, None] * N.d
    # A vertex of one body (B's if of_b) relative to the other's centre of rotation; a point already
    # is.
    own = N.b.where(of_b, N.a)
    out = own.turned(t, np.einsum("tij,tj->ti", own.R, x - own.about)) + np.where(
        of_b[:, None], between, -between
    )
    seen = N.a.where(vertex == of_b, N.b)
    y = _apply(seen.R, seen.turned(-t, np.where(vertex[:, None], out, x))) + seen.about
    rho = 256 * UNIT * N.swing * span
    solid = np.array([getattr(o, "corners", None) is not None for o in os])
    open_ = ~solid
    if solid.any():
        open_[solid] = ~_in_tetrahedra(
            np.array([os[i].corners for i in np.flatnonzero(solid)]), y[solid], rho[solid]
        )
    for i in np.flatnonzero(~solid):
        o = os[i]
        mesh = o.pair.a if vertex[i] == of_b[i] else o.pair.b
        count = winding(mesh, y[i], rho[i])
        open_[i] = count is None or (count != 0) == vertex[i]
    return [(jobs[i][0], None, None) for i in np.flatnonzero(open_)]


def _in_tetrahedra(corners, y, rho):
    """Four determinants of corners relative to y have the same sign, each by more than 32 L^2
    (rho + 8 u L).
    """
    w = corners - y[:, None, :]
    L = np.abs(w).max(axis=(1, 2)) + rho
    bound = 32 * L * L * (rho + 8 * UNIT * L)
    c01, c23 = _cross(w[:, 0], w[:, 1]), _cross(w[:, 2], w[:, 3])
    dets = np.stack(
        [
            (w[:, 1] * c23).sum(1),
            -(w[:, 0] * c23).sum(1),
            (c01 * w[:, 3]).sum(1),
            -(c01 * w[:, 2]).sum(1),
        ],
        1,
    )
    return (
        ((dets > bound[:, None]).all(1) | (dets < -bound[:, None]).all(1))
        & (bound > 1e-140)
        & (bound < 1e140)
    )


def _offset(o):
    """x at time t, relative to the body's centre of rotation, in doubles, each coordinate
    rounded once.
    """
    q = o.pair.query
    pose, motion = (q.pose_b, q.motion_b) if o.of_b else (q.pose_a, q.motion)
    if o.t == 0 and not motion.angle and all(type(c) is float for c in o.x):
        return [c - p for c, p in zip(o.x, pose.position.tolist())]
    there = add(geometry.centre(pose, motion), vector(motion.displacement), rational(o.t))
    return [nearest_double(c) for c in add([number(c) for c in o.x], there, -1)]


def winding(mesh, y, rho):
    """Winding number of a mesh about y, each coordinate of which has an error of at most rho;
    None if doubles cannot decide.
    """
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
        edges = np.stack(
            [
                w[:, c, i] * w[:, (c + 1) % 3, j] - w[:, c, j] * w[:, (c + 1) % 3, i]
                for c in range(3)
            ],
            1,
        )
        volume = (w[:, 0] * _cross(w[:, 1], w[:, 2])).sum(1)
        up, down = edges > bound[:, None], edges < -bound[:, None]
        missed = up.any(1) & down.any(1)
        told = (up.all(1) | down.all(1)) & (np.abs(volume) > L * bound) & (bound > 1e-140)
        if (missed | told).all():
            forward = told & (up[:, 0] == (volume > 0))
            return int(up[forward, 0].sum()) - int(down[forward, 0].sum())
    return None


def crossed(mesh, y, ray) -> np.ndarray:
    """(m,) bool: the faces that the line through y (rationals or balls) along `ray` may cross,
    as far as doubles can decide.
    """
    y0 = np.array([nearest_double(c) if not hasattr(c, "mid") else float(c.mid()) for c in y])
    blur = sum(float(c.rad()) for c in y if hasattr(c, "rad")) * 2
    w = mesh.vertices - y0
    reach = geometry.reach(mesh) + np.abs(y0).sum()
    rho = 8 * UNIT * reach + blur
    wf = w[mesh.faces]
    side = np.stack(
        [_cross(wf[:, i], wf[:, (i + 1) % 3]) @ np.array(ray, float) for i in range(3)], 1
    )
    L = np.abs(w).sum(1)[mesh.faces].max(1) + rho
    bound = (16 * np.abs(ray).sum() * L * (rho + 8 * UNIT * L))[:, None]
    if not 1e-140 < bound.min() < 1e140:
        return np.ones(len(mesh.faces), bool)
    return ~((side > bound).any(1) & (side < -bound).any(1))


def _rows(arrays):
    """The rows of all arrays in one block: the first row of each array, and the array of each
    row.
    """
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
        [
            a[:, 1] * b[:, 2] - a[:, 2] * b[:, 1],
            a[:, 2] * b[:, 0] - a[:, 0] * b[:, 2],
            a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0],
        ],
        1,
    )


def _norm(x):
    return np.sqrt((x * x).sum(-1))


def _turned(angle, k, v):
    """Rot(k, angle) v, row by row."""
    c, s = np.cos(angle)[:, None], np.sin(angle)[:, None]
    return v * c + _cross(k, v) * s + k * ((k * v).sum(1)[:, None] * (1 - c))
