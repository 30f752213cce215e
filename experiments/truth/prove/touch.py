# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Planes and common points of touching convex pieces, in rationals, which no rounded search can
propose.

Two pieces with disjoint interiors have a separating plane; cone.py finds it in integers. If they
rotate, it must hold for some time, so the search requires that it also separates them at a later
instant.
"""

from __future__ import annotations

from dataclasses import dataclass

import flint
import numpy as np
from flint import fmpq, fmpq_mat
from scipy.optimize import linprog

from experiments.truth.check.balls import BITS, add, dot, mul, nearest_double, rational, vector
from experiments.truth.check.geometry import Pair
from experiments.truth.check.obligations import FRAMES, Apart, Refused
from experiments.truth.check.proof import apart
from ofg import Query

from .cone import separating
from .meet import meeting

SPANS = tuple(10.0**-k for k in range(10))  #: of the step: times for which a plane is tested


@dataclass(frozen=True)
class Plane:
    """A plane with normal n (rationals, from A to B) that keeps two pieces apart over [0, end],
    in frame "W", "A" or "B".
    """

    n: list
    frame: str
    end: float


class Pieces:
    """Piece i of A and piece j of B at t = 0, relative to A's centre of rotation: exact
    vertices, and doubles of them.
    """

    def __init__(self, query: Query, i: int, j: int):
        self.query, self.pair = query, Pair(query)
        X, self.d = self.pair.exact, self.pair.exact.d
        self.a, self.b = query.a.pieces[i], query.b.pieces[j]
        self.A = [mul(X.RA, add(vector(v), X.about_a, -1)) for v in self.a.vertices]
        self.B = [add(mul(X.RB, add(vector(v), X.about_b, -1)), X.dp) for v in self.b.vertices]
        self.turns = bool(X.turn_a.theta or X.turn_b.theta)

    def swept(self) -> list:
        """A's vertices at t = 0 and at t = 1, without rotation: the hull of A's sweep relative
        to B.
        """
        return self.A + [add(x, self.d) for x in self.A]

    def later(self, t) -> tuple[list, list]:
        """Both pieces' vertices at another time."""
        X, pair = self.pair.exact, self.pair
        a = [add(pair.turn_a(t, x), self.d, t) for x in self.A]
        return a, [add(pair.turn_b(t, add(y, X.dp, -1)), X.dp) for y in self.B]

    def back(self, frame: str, t, x: list) -> list:
        """A later point in a plane's frame, in which the plane stays as it is at the start."""
        turn = {"A": self.pair.turn_a, "B": self.pair.turn_b}.get(frame)
        return [_middle(c) for c in (turn(-rational(t), x) if turn else x)]


def _middle(c) -> fmpq:
    """A rational, or the middle of a ball."""
    if isinstance(c, fmpq):
        return c
    mantissa, exponent = c.mid().man_exp()
    mantissa, exponent = int(mantissa), int(exponent)
    return fmpq(mantissa << max(exponent, 0), 1 << max(-exponent, 0))


def plane(query: Query, i: int, j: int) -> Plane | None:
    """A plane between piece i of A and piece j of B, which touch or nearly do, over as much of
    the step as can be shown.
    """
    with flint.ctx.workprec(BITS):
        p = Pieces(query, i, j)
        if p.turns:
            return _turning(p)
        if any(p.d):
            if n := separating((p.swept(), p.B)):
                return Plane(n, "W", 1.0)
        n = separating((p.A, p.B))
        return n and Plane(n, "W", 0.0 if any(p.d) else 1.0)


def witness(query: Query, i: int, j: int, found: Plane) -> dict | None:
    """A common point of two pieces separated by a plane of `plane`: the certificate's
    `touching`. None if there is none.
    """
    with flint.ctx.workprec(BITS):
        p = Pieces(query, i, j)
        swept = not p.turns and found.end > 0 and any(p.d)
        X = p.swept() if swept else p.A
        ids_a, ids_b = _on(X, found.n, max), _on(p.B, found.n, min)
        if dot(found.n, X[ids_a[0]]) != dot(found.n, p.B[ids_b[0]]):
            return None
        on_a, on_b = [X[k] for k in ids_a], [p.B[k] for k in ids_b]
        weights = _meeting(on_a, on_b) or meeting(on_a, on_b, found.n)
        if weights is None:
            return None
        wa, wb = weights
        m = len(p.A)
        time = sum((w for k, w in zip(ids_a, wa) if k >= m), fmpq(0))
        return {
            "time": str(time),
            "a": _weights(i, [(k % m, w) for k, w in zip(ids_a, wa)]),
            "b": _weights(j, list(zip(ids_b, wb))),
        }


def _weights(piece, pairs) -> dict:
    total = {}
    for k, w in pairs:
        if w:
            total[k] = total.get(k, fmpq(0)) + w
    return {"piece": piece, "vertices": list(total), "weights": [str(w) for w in total.values()]}


def _turning(p: Pieces) -> Plane | None:
    """The plane that can be shown to hold longest, in the first frame that has one."""
    at_rest = separating((p.A, p.B))
    if at_rest is None:
        return None
    for end in SPANS:
        later = p.later(rational(end))
        for frame in FRAMES:
            sides = tuple([p.back(frame, end, x) for x in side] for side in later)
            for n in (at_rest, separating((p.A, p.B), sides)):
                if n and _holds(p, n, frame, end):
                    return Plane(n, frame, end)
    return Plane(at_rest, "W", 0.0)


def _holds(p: Pieces, n: list, frame: str, end: float) -> bool:
    try:
        apart(Apart(p.pair, p.a.vertices, p.b.vertices, 0.0, end, frame, n, 0.0, True))
        return True
    except Refused:
        return False


def _on(points: list, n: list, extreme) -> list[int]:
    keys = [dot(n, x) for x in points]
    most = extreme(keys)
    return [k for k, key in enumerate(keys) if key == most]


def _meeting(A: list, B: list) -> tuple[list, list] | None:
    """Exact convex weights of a common point of two hulls in one plane: a vertex of the linear
    program, solved in rationals.
    """
    rows = [[*(x[c] for x in A), *(-y[c] for y in B), fmpq(0)] for c in range(3)]
    rows += [
        [fmpq(1)] * len(A) + [fmpq(0)] * len(B) + [fmpq(1)],
        [fmpq(0)] * len(A) + [fmpq(1)] * len(B) + [fmpq(1)],
    ]
    # Relative to a point of A and in units of the size, or the solver's tolerance would be a
    # length.
    a, b = (
        np.array([[nearest_double(c) for c in add(x, A[0], -1)] for x in side]) for side in (A, B)
    )
    size = max(np.abs(a).max(), np.abs(b).max()) or 1.0
    equal = np.zeros((5, len(A) + len(B)))
    equal[:3] = np.concatenate([a, -b]).T / size
    equal[3, : len(A)] = equal[4, len(A) :] = 1
    rng = np.random.default_rng(0)
    for _ in range(4):
        r = linprog(
            rng.uniform(size=equal.shape[1]), A_eq=equal, b_eq=[0, 0, 0, 1, 1], method="highs-ds"
        )
        if r.status != 0:
            return None
        used = np.flatnonzero(r.x > 1e-12)
        exact = _solved([[row[k] for k in used] + [row[-1]] for row in rows])
        if exact is not None and min(exact) >= 0:
            weights = [fmpq(0)] * equal.shape[1]
            for k, w in zip(used, exact):
                weights[k] = w
            return weights[: len(A)], weights[len(A) :]
    return None


def _solved(rows: list) -> list | None:
    """A solution of the linear equations [matrix | right side]; free unknowns are 0. None if
    there is none.
    """
    reduced, rank = fmpq_mat(rows).rref()
    unknowns = len(rows[0]) - 1
    solution = [fmpq(0)] * unknowns
    for i in range(rank):
        pivot = next(k for k in range(unknowns + 1) if reduced[i, k] != 0)
        if pivot == unknowns:
            return None
        solution[pivot] = reduced[i, unknowns]
    return solution
