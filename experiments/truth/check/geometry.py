# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Data shared by the checker's two arithmetics: a query's poses and motion as doubles and as
exact numbers; bodies as elements.
"""

from __future__ import annotations

from functools import cached_property
from math import lcm
from typing import NamedTuple
from weakref import WeakKeyDictionary

import numpy as np
from flint import arb, fmpq, fmpz, fmpz_mat

from .balls import add, cross, dot, mul, nearest_double, norm, rational, rotation, vector

#: by body
CACHES = _reaches, _parts, _boxes, _integers = tuple(WeakKeyDictionary() for _ in range(4))


class Pair:
    """A query decomposed in a frame that moves with B's displacement and has its origin at the
    start of A's centre of rotation.

    There A's centre of rotation moves by d = d_A - d_B, and B's stays at dp. row: the numbers in
    doubles for the filter: q_A, q_B (4 each), dp, d, the axes divided by their largest component (3
    each), the centres of rotation about_A, about_B (3 each), the angles, and a bound on |v|_1 +
    |b|_1 + |about_A|_1 + |about_B|_1 + |dp|_1 + |d|_1.
    """

    def __init__(self, query):
        ma, mb = query.motion, query.motion_b
        self.query, self.a, self.b, self.theta_a, self.theta_b = (
            query,
            query.a,
            query.b,
            float(ma.angle),
            float(mb.angle),
        )
        about = [(m.about if m.angle else 0 * m.about).tolist() for m in (ma, mb)]
        self.about_a, self.about_b = about
        positions = [p.position.tolist() for p in (query.pose_a, query.pose_b)]
        if any(about[0]) or any(about[1]):
            dp = [nearest_double(c) for c in self.exact.dp]
        else:
            dp = [y - x for x, y in zip(*positions)]
        d = [x - y for x, y in zip(ma.displacement.tolist(), mb.displacement.tolist())]
        span = reach(self.a) + reach(self.b) + sum(map(abs, (*dp, *d, *about[0], *about[1])))
        self.row = [
            *query.pose_a.quaternion.tolist(),
            *query.pose_b.quaternion.tolist(),
            *dp,
            *d,
            *_scaled(ma.axis.tolist()),
            *_scaled(mb.axis.tolist()),
            *about[0],
            *about[1],
            self.theta_a,
            self.theta_b,
            span,
        ]

    @cached_property
    def exact(self):
        """Rationals, except the unit axes, whose length is a root: balls."""
        q = self.query
        RA, RB = (rotation(*map(rational, p.quaternion)) for p in (q.pose_a, q.pose_b))
        dp = add(centre(q.pose_b, q.motion_b), centre(q.pose_a, q.motion), -1)
        d = add(vector(q.motion.displacement), vector(q.motion_b.displacement), -1)
        turns = [Turn(_axis(m), rational(m.angle), vector(m.axis)) for m in (q.motion, q.motion_b)]
        return Exact(RA, RB, dp, d, *turns, vector(self.about_a), vector(self.about_b))

    def turn_a(self, t, v):
        """Rot(k_A, theta_A t) v in balls; v itself without rotation, so that rationals stay
        rational.
        """
        return self.exact.turn_a.by(t, v)

    def turn_b(self, t, v):
        return self.exact.turn_b.by(t, v)


class Turn(NamedTuple):
    """k: the unit axis (balls, or 0 without rotation). theta: the angle over the step. axis: as
    given, in rationals.
    """

    k: list
    theta: fmpq
    axis: list

    def by(self, t, v):
        """Rot(k, theta t) v in balls; v itself without rotation, so that rationals stay
        rational.
        """
        if not self.theta or not t or not any(self._off_axis(v)):
            return v
        s, c = arb(self.theta * t).sin_cos()
        return add(add([c * x for x in v], cross(self.k, v), s), self.k, (1 - c) * dot(self.k, v))

    def across(self, v):
        """|v x k|: exactly 0, not a ball, if v is along the axis."""
        off = self._off_axis(v)
        return norm(off) / norm(self.axis) if self.theta and any(off) else 0

    def _off_axis(self, v) -> list:
        return cross(v, self.axis) if all(isinstance(c, fmpq) for c in v) else v


class Exact(NamedTuple):
    """RA, RB: rows of the rotations at the start. dp, d: see Pair. about: centres of rotation.
    All but turns.k in rationals.
    """

    RA: list
    RB: list
    dp: list
    d: list
    turn_a: Turn
    turn_b: Turn
    about_a: list
    about_b: list


def centre(pose, motion) -> list:
    """The start of a body's centre of rotation, in the world, in rationals; its position without
    rotation.
    """
    if not (motion.angle and motion.about.any()):
        return vector(pose.position)
    return add(
        vector(pose.position), mul(rotation(*map(rational, pose.quaternion)), vector(motion.about))
    )


def _axis(motion) -> list:
    if not motion.angle:
        return vector((0, 0, 0))
    axis = vector(motion.axis)
    return [arb(c) / norm(axis) for c in axis]


def _scaled(axis):
    top = max(map(abs, axis)) or 1.0
    return [c / top for c in axis]


class Points:
    """Vertices of a body's elements in a given order (n integers or None); `of(lo, hi)` are
    those of elements lo to hi - 1.
    """

    def __init__(self, body, order):
        self.mesh = body if body.kind == "mesh" else None
        if self.mesh:
            self.known, self.ids = {}, (body.faces if order is None else body.faces[order]).ravel()
        elif len(body.pieces) == 1:
            self.block, self.first = body.pieces[0].vertices, (0, len(body.pieces[0].vertices))
        else:
            pieces = [
                body.pieces[i].vertices
                for i in (range(len(body.pieces)) if order is None else order)
            ]
            self.block, self.first = (
                np.concatenate(pieces),
                np.cumsum([0] + [len(p) for p in pieces]),
            )

    def of(self, lo, hi):
        if not self.mesh:
            return self.block[self.first[lo] : self.first[hi]]
        if (lo, hi) not in self.known:
            ids = self.ids[3 * lo : 3 * hi]
            if len(ids) > 100:  # a vertex belongs to about six faces: each once
                met = np.zeros(len(self.mesh.vertices), bool)
                met[ids] = True
                ids = met
            self.known[lo, hi] = self.mesh.vertices[ids]
        return self.known[lo, hi]


def elements(body):
    """The convex sets that make up a body for the planes: its pieces, or the triangles of a
    mesh.
    """
    return body.faces if body.kind == "mesh" else body.pieces


def parts(body):
    """(n, 3): one vertex of each convex piece, or of each edge-connected part of a mesh."""
    if body not in _parts:
        if body.kind != "mesh":
            _parts[body] = [p.vertices[0] for p in body.pieces]
        else:
            part, before = np.arange(len(body.vertices)), None
            while (
                not np.array_equal(part, before) and part[body.faces].any()
            ):  # all 0: one part, as for most bodies
                before, low = part.copy(), part[body.faces].min(axis=1)
                for i in range(3):
                    np.minimum.at(part, body.faces[:, i], low)
                part = part[part]
            _parts[body] = body.vertices[np.unique(part[body.faces])]
    return _parts[body]


def reach(body) -> float:
    """Bound on |x| + |y| + |z| of a body's vertices, in its frame."""
    if body not in _reaches:
        _reaches[body] = float(np.abs(body.vertices).sum(axis=1).max())
    return _reaches[body]


def support(piece, m):
    """(value, index) of the largest m.v over a convex body's vertices, m of rationals: in
    integers.
    """
    if piece not in _integers:
        shift = max(0, *(53 - e for e in np.frexp(piece.vertices[piece.vertices != 0])[1].tolist()))
        _integers[piece] = (
            fmpz_mat(
                [
                    [int(fmpz(p) * 2**shift // q) for p, q in map(float.as_integer_ratio, v)]
                    for v in piece.vertices.tolist()
                ]
            ),
            2**shift,
        )
    vertices, scale = _integers[piece]
    m = [fmpq(c) for c in m]
    common = lcm(*(int(c.q) for c in m))
    column = (vertices * fmpz_mat([[c.p * (common // c.q)] for c in m])).entries()
    best = max(range(len(column)), key=column.__getitem__)
    return fmpq(column[best], common * scale), best


def face_boxes(mesh):
    """(3, m) lower and upper bounds of each face."""
    if mesh not in _boxes:
        corners = mesh.vertices[mesh.faces]
        _boxes[mesh] = (
            np.ascontiguousarray(corners.min(1).T),
            np.ascontiguousarray(corners.max(1).T),
        )
    return _boxes[mesh]
