# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Exact and ball arithmetic of three-vectors for the checker: rationals (fmpq) without rotation,
balls (arb) with it.
"""

from __future__ import annotations

import re
from math import inf, isfinite

from flint import arb, fmpq

BITS = 256
#: the integers that int() accepts
_RATIONAL = re.compile(r"(-?[0-9]{1,4300})(?:/([0-9]{1,4300}))?")


def rational(x) -> fmpq:
    """The exact rational value of a double."""
    return fmpq(*float(x).as_integer_ratio())


def number(x) -> fmpq:
    """A number of a certificate: a double, or a rational "p/q" or "p". ValueError for anything
    else.
    """
    if isinstance(x, str):
        if not (read := _RATIONAL.fullmatch(x)):
            raise ValueError(f"{x[:40]!r} is not a number")
        return fmpq(int(read[1]), int(read[2] or 1))
    return x if isinstance(x, fmpq) else rational(x)


def finite(x):
    """The same, with a double kept as a double. Raises if it is not a finite number."""
    if type(x) is not float:
        return number(x)
    if not isfinite(x):
        raise ValueError(f"{x} is not a finite number")
    return x


def nearest_double(x) -> float:
    """The double next to a number (error: one unit in the last place); infinite beyond their
    range, which the filter leaves to the balls.
    """
    try:
        return int(x.p) / int(x.q) if isinstance(x, fmpq) else float(x)
    except OverflowError:
        return inf if x > 0 else -inf


def vector(v) -> list:
    return [rational(c) for c in v]


def ball(v) -> list:
    return [arb(c) for c in v]


def rotation(w, x, y, z) -> list:
    """Rows of N(q) / |q|^2, in the arithmetic of the arguments."""
    s = w * w + x * x + y * y + z * z
    return [
        [(w * w + x * x - y * y - z * z) / s, 2 * (x * y - w * z) / s, 2 * (x * z + w * y) / s],
        [2 * (x * y + w * z) / s, (w * w - x * x + y * y - z * z) / s, 2 * (y * z - w * x) / s],
        [2 * (x * z - w * y) / s, 2 * (y * z + w * x) / s, (w * w - x * x - y * y + z * z) / s],
    ]


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b) -> list:
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def add(a, b, factor=1) -> list:
    return [x + factor * y for x, y in zip(a, b)]


def mul(R, v) -> list:
    return [dot(row, v) for row in R]


def transposed(R, v) -> list:
    return [dot(column, v) for column in zip(*R)]


def norm(v) -> arb:
    """The square root of a ball; for a ball that reaches below 0, from 0 to the root of its
    upper end, never NaN.
    """
    s = arb(dot(v, v))
    return s.sqrt() if s > 0 else arb(0, s.abs_upper().sqrt().abs_upper())


def greatest(values):
    """The largest: a rational if all are rational, else a ball."""
    if all(isinstance(x, (int, fmpq)) for x in values):
        return max(values)
    best = arb(values[0])
    for x in values[1:]:
        best = best.max(arb(x))
    return best


def least(values):
    return -greatest([-x for x in values])
