# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Exact signs of geometric predicates: doubles with an error bound, and integers where it fails."""

from __future__ import annotations

from fractions import Fraction

import numpy as np

UNIT = 2.0**-53
SURE = 1e-280  #: smaller terms may have lost digits to underflow


def whole(points: np.ndarray) -> np.ndarray:
    """(..., 3) doubles as Python integers (dtype object), all scaled by the same power of two."""
    mantissa, exponent = np.frexp(points)
    mantissa = (mantissa * 2.0**53).astype(np.int64)
    used = mantissa != 0
    low = exponent[used].min() if used.any() else 0
    shift = np.where(used, exponent - low, 0).astype(object)
    shifted: np.ndarray = np.left_shift(mantissa.astype(object), shift)
    return shifted


def cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Cross product row by row, of doubles or of Python integers."""
    i, j = [1, 2, 0], [2, 0, 1]
    product: np.ndarray = a[..., i] * b[..., j] - a[..., j] * b[..., i]
    return product


def sides(a: np.ndarray, b: np.ndarray, c: np.ndarray, p: np.ndarray) -> np.ndarray:
    """(n,) of -1, 0, 1: whether p lies behind, in or in front of the plane of a, b, c. All (n, 3).

    The front is the side from which a, b, c run counter-clockwise. Bound: Shewchuk 1997, "Adaptive
    precision floating-point arithmetic and fast robust geometric predicates", o3derrboundA.
    """
    a, b, c, p = np.broadcast_arrays(a, b, c, p)
    with np.errstate(all="ignore"):
        u, v, w = a - p, b - p, c - p
        i, j = [1, 2, 0], [2, 0, 1]
        terms = (np.abs(v[:, i] * w[:, j]) + np.abs(v[:, j] * w[:, i])) * np.abs(u)
        height = -(u * cross(v, w)).sum(1)
        bound = (8 + 64 * UNIT) * UNIT * terms.sum(1)
        sure = (np.abs(height) > bound) & (bound > SURE) & np.isfinite(bound)
    sign = np.where(sure, np.sign(height), 0).astype(np.int8)
    for corner in (a, b, c):
        sure |= (corner == p).all(axis=1)
    for way in (_by_words, _by_integers):
        open_ = np.flatnonzero(~sure)
        if len(open_):
            sign[open_], sure[open_] = way(a[open_], b[open_], c[open_], p[open_])
    return sign


def _by_integers(
    a: np.ndarray, b: np.ndarray, c: np.ndarray, p: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    u, v, w, o = whole(np.stack([a, b, c, p]))
    exact = -((u - o) * cross(v - o, w - o)).sum(1)
    return np.array([(x > 0) - (x < 0) for x in exact.tolist()]), np.ones(len(p), bool)


def _by_words(
    a: np.ndarray, b: np.ndarray, c: np.ndarray, p: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Signs where the differences to p are exact and of at most 26 bits, as on a grid."""
    x = np.stack([a, b, c]) - p
    exact = (x + p == [a, b, c]) & (np.stack([a, b, c]) - x == p)
    mantissa, exponent = np.frexp(x)
    mantissa = (mantissa * 2.0**53).astype(np.int64)
    low = np.where(
        mantissa == 0,
        9999,
        exponent + np.log2((mantissa & -mantissa) | (mantissa == 0)).astype(int),
    )
    shift = low.min(axis=(0, 2))[None, :, None]
    fits = exact.all(axis=(0, 2)) & (
        np.where(mantissa == 0, -9999, exponent - shift + 53) <= 26
    ).all(axis=(0, 2))
    with np.errstate(all="ignore"):
        u, v, w = np.where(fits[None, :, None], np.ldexp(x, 53 - shift), 0.0).astype(np.int64)
    normal = cross(v, w)  # below 2^54: its halves times u stay below 2^63
    high, rest = -(u * (normal >> 27)).sum(axis=1), -(u * (normal & (2**27 - 1))).sum(axis=1)
    high, rest = high + (rest >> 27), rest & (2**27 - 1)
    return np.where(high != 0, np.sign(high), np.sign(rest)), fits


def flat(v: np.ndarray, f: np.ndarray) -> np.ndarray:
    """(m,) bool: faces whose three corners are exactly collinear, so that they have no area."""
    with np.errstate(all="ignore"):
        b, c = v[f[:, 1]] - v[f[:, 0]], v[f[:, 2]] - v[f[:, 0]]
        i, j = [1, 2, 0], [2, 0, 1]
        size = np.abs(v[f]).max(axis=(1, 2), initial=0.0)
        terms = np.abs(b[:, i] * c[:, j]) + np.abs(b[:, j] * c[:, i])
        reach = np.abs(b).max(axis=1, initial=0.0) + np.abs(c).max(axis=1, initial=0.0)
        bound = 8 * UNIT * (terms + reach[:, None] * UNIT * size[:, None])
        sure = ((np.abs(cross(b, c)) > bound) & (bound > SURE) & np.isfinite(bound)).any(axis=1)
    out = np.zeros(len(f), bool)
    open_ = np.flatnonzero(~sure)
    if len(open_):
        x = whole(v[f[open_]])
        out[open_] = ~(cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0]) != 0).any(axis=1)
    return out


def volume_sign(v: np.ndarray, f: np.ndarray) -> int:
    """The sign of the signed volume of a closed surface: 1 if its faces are mostly outward."""
    with np.errstate(all="ignore"):
        a, b, c = (v[f[:, i]] - v[f[0, 0]] for i in range(3))
        terms = (a * cross(b, c)).sum(1)
        # A difference has a relative error of UNIT, so a product of three has a few units.
        reach = np.abs(a).sum(1) * np.abs(b).sum(1) * np.abs(c).sum(1)
        total, bound = terms.sum(), (32 + len(f)) * UNIT * reach.sum()
    if SURE < bound < abs(total):
        return 1 if total > 0 else -1
    x = whole(v)
    a, b, c = (x[f[:, i]] - x[f[0, 0]] for i in range(3))
    total = (a * cross(b, c)).sum()
    return int(total > 0) - int(total < 0)


def rational(point: np.ndarray) -> list[Fraction]:
    """The (3,) doubles as exact rationals."""
    return [Fraction(float(c)) for c in point]
