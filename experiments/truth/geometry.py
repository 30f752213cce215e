"""What the checker's two arithmetics share: a query's poses and motion as doubles and as exact numbers; bodies as elements."""

from __future__ import annotations

from functools import cached_property
from math import lcm
from weakref import WeakKeyDictionary

import numpy as np
from flint import arb, fmpq, fmpz, fmpz_mat

from .balls import add, cross, dot, norm, rational, rotation, vector

CACHES = _reaches, _parts, _boxes, _integers = tuple(WeakKeyDictionary() for _ in range(4))  #: by body


class Pair:
    """A query taken apart. row: its numbers in doubles for the filter: q_A, q_B (4 each), dp = p_B - p_A, d, the motion's axis
    divided by its largest component (3 each), theta, and a bound on |v|_1 + |b|_1 + |dp|_1 + |d|_1."""

    def __init__(self, query):
        m = query.motion
        self.query, self.a, self.b, self.theta = query, query.a, query.b, float(m.angle)
        d, axis, pa, pb = m.displacement.tolist(), m.axis.tolist(), query.pose_a.position.tolist(), query.pose_b.position.tolist()
        dp = [y - x for x, y in zip(pa, pb)]
        top = max(map(abs, axis)) or 1.0
        span = reach(self.a) + reach(self.b) + sum(map(abs, dp)) + sum(map(abs, d))
        self.row = [
            *query.pose_a.quaternion.tolist(),
            *query.pose_b.quaternion.tolist(),
            *dp,
            *d,
            *(c / top for c in axis),
            self.theta,
            span,
        ]

    @cached_property
    def exact(self):
        """(RA, RB, dp, d, k, theta): rationals, but for the unit axis k, whose length is a root: balls."""
        q, m = self.query, self.query.motion
        RA, RB = (rotation(*map(rational, p.quaternion)) for p in (q.pose_a, q.pose_b))
        dp = add(vector(q.pose_b.position), vector(q.pose_a.position), -1)
        axis = vector(m.axis)
        k = [arb(c) / norm(axis) for c in axis] if self.theta else vector((0, 0, 0))
        return RA, RB, dp, vector(m.displacement), k, rational(self.theta)

    def turn(self, t, v):
        """Rot(k, theta t) v in balls; v itself where nothing turns, so that rationals stay rational."""
        k, theta = self.exact[4:]
        if not theta or not t:
            return v
        s, c = arb(theta * t).sin_cos()
        return add(add([c * x for x in v], cross(k, v), s), k, (1 - c) * dot(k, v))


class points:
    """Vertices of a body's elements in a given order (n integers or None); `of(lo, hi)` are those of elements lo to hi - 1."""

    def __init__(self, body, order):
        self.mesh = body if body.kind == "mesh" else None
        if self.mesh:
            self.known, self.ids = {}, (body.faces if order is None else body.faces[order]).ravel()
        elif len(body.pieces) == 1:
            self.block, self.first = body.pieces[0].vertices, (0, len(body.pieces[0].vertices))
        else:
            pieces = [body.pieces[i].vertices for i in (range(len(body.pieces)) if order is None else order)]
            self.block, self.first = np.concatenate(pieces), np.cumsum([0] + [len(p) for p in pieces])

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
    """The convex sets that a body is made of as far as planes go: its pieces, or the triangles of a mesh."""
    return body.faces if body.kind == "mesh" else body.pieces


def parts(body):
    """(n, 3): one vertex of each convex piece, or of each edge-connected part of a mesh."""
    if body not in _parts:
        if body.kind != "mesh":
            _parts[body] = [p.vertices[0] for p in body.pieces]
        else:
            part, before = np.arange(len(body.vertices)), None
            while not np.array_equal(part, before) and part[body.faces].any():  # all 0: one part, as most bodies are
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
    """(value, index) of the largest m.v over a convex body's vertices, m of rationals: in integers."""
    if piece not in _integers:
        shift = max(0, *(53 - e for e in np.frexp(piece.vertices[piece.vertices != 0])[1].tolist()))
        _integers[piece] = (
            fmpz_mat(
                [[int(fmpz(p) * 2**shift // q) for p, q in map(float.as_integer_ratio, v)] for v in piece.vertices.tolist()]
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
        _boxes[mesh] = np.ascontiguousarray(corners.min(1).T), np.ascontiguousarray(corners.max(1).T)
    return _boxes[mesh]
