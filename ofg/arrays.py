# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Poses and motions as rows of arrays, the form that the core takes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from . import checks
from .motion import Motion
from .pose import Pose

#: One for all queries, one for each query, or the rows of an array.
Poses = Pose | Sequence[Pose] | np.ndarray
Motions = Motion | Sequence[Motion] | np.ndarray
#: For each type: the columns of the core's rows, the allowed columns of an array, and a
#: description.
_COLUMNS = {
    Pose: (7, (7,), "(n, 7): quaternion (w, x, y, z), position"),
    Motion: (10, (7, 10), "(n, 10): displacement, axis, angle, about; or (n, 7) without about"),
}


def row(value: Pose | Motion) -> np.ndarray:
    """(7,) of a Pose: quaternion, position; (10,) of a Motion: displacement, axis, angle, about."""
    if isinstance(value, Pose):
        return np.concatenate([value.quaternion, value.position])
    return np.concatenate([value.displacement, value.axis, [value.angle], value.about])


def rows_of(values: Poses | Motions, kind: type[Pose] | type[Motion], name: str) -> np.ndarray:
    """`row` of a Pose or a Motion; (n, 7) or (n, 10) of a sequence or an array.

    Raises TypeError for items of another type, ValueError for a wrong shape or a number out of
    range.
    """
    if isinstance(values, kind):
        return row(values)
    columns, given, words = _COLUMNS[kind]
    if not isinstance(values, np.ndarray):
        return np.array([row(v) for v in _all_of(values, kind, name)]).reshape(-1, columns)
    if values.dtype.kind not in "fiu":
        raise TypeError(f"{name} is an array of {values.dtype}; give {words}, of floats.")
    rows = values.astype(np.float64)
    if rows.ndim != 2 or rows.shape[1] not in given:
        raise ValueError(f"{name} has shape {rows.shape}; give {words}.")
    rows = np.pad(rows, ((0, 0), (0, columns - rows.shape[1])))
    _check_finite(rows, name)
    (_check_poses if kind is Pose else _check_motions)(rows, name)
    return rows


def broadcast(rows: Sequence[np.ndarray]) -> list[np.ndarray]:
    """Repeat single rows so that all arrays have equally many. ValueError if the counts differ."""
    counts = sorted({len(r) for r in rows if r.ndim == 2})
    if len(counts) > 1:
        raise ValueError(
            f"Arrays of poses and motions have {counts[0]} and {counts[1]} rows; give all the same "
            "number, or one Pose or Motion for all."
        )
    n = counts[0] if counts else 1
    return [np.ascontiguousarray(np.broadcast_to(r, (n, r.shape[-1]))) for r in rows]


def check_float(
    poses_a: np.ndarray, poses_b: np.ndarray, motions_a: np.ndarray, motions_b: np.ndarray
) -> None:
    """Raise ValueError if the core would leave the range of single precision.

    Positions far from the world's origin are allowed: only relative positions enter.
    """
    for name, lengths in (
        ("The position of A relative to B", poses_a[:, 4:] - poses_b[:, 4:]),
        ("The displacement of A relative to B", motions_a[:, :3] - motions_b[:, :3]),
        ("The point that A rotates about", motions_a[:, 7:]),
        ("The point that B rotates about", motions_b[:, 7:]),
    ):
        far = _first(np.abs(lengths) > checks.LONGEST_FLOAT)
        if far is not None:
            raise ValueError(
                f"{name} is {lengths[far].tolist()} in row {far}; precision = 'float' supports "
                f"lengths up to {checks.LONGEST_FLOAT:g}, so use double."
            )


def _all_of(values: Any, kind: type[Pose] | type[Motion], name: str) -> list[Pose | Motion]:
    shape = _COLUMNS[kind][2].split(":")[0]
    give = f"give {kind.__name__} objects or an {shape} float array"
    try:
        every = list(values)
    except TypeError:
        raise TypeError(f"{name} is {checks.shown(values)}; {give}.") from None
    wrong = next((v for v in every if not isinstance(v, kind)), None)
    if any(not isinstance(v, kind) for v in every):
        raise TypeError(f"{name} contains {checks.shown(wrong)}; {give}.")
    return every


def _first(bad: np.ndarray) -> int | None:
    """The first row that contains a true value."""
    found = np.flatnonzero(bad.any(axis=1) if bad.ndim == 2 else bad)
    return int(found[0]) if len(found) else None


def _check_finite(rows: np.ndarray, name: str) -> None:
    i = _first(~np.isfinite(rows))
    if i is not None:
        raise ValueError(
            f"{name}[{i}] = {rows[i].tolist()} contains a number that is not finite; every number "
            "must be finite."
        )


def _check_poses(rows: np.ndarray, name: str) -> None:
    i = _first((rows[:, :4] == 0).all(axis=1))
    if i is not None:
        raise ValueError(
            f"{name}[{i}] has a zero quaternion, which is not a rotation; use (1, 0, 0, 0) for "
            "none."
        )
    _check_directions(rows[:, :4], np.full(len(rows), True), f"{name}[{{}}].quaternion")
    _check_lengths(rows[:, 4:], f"{name}[{{}}].position")


def _check_motions(rows: np.ndarray, name: str) -> None:
    axes, turns = rows[:, 3:6], rows[:, 6] != 0
    i = _first(~axes.any(axis=1) & turns)
    if i is not None:
        raise ValueError(
            f"{name}[{i}] has an angle about a zero axis, which is not a rotation; give an axis."
        )
    _check_directions(axes, turns, f"{name}[{{}}].axis")
    _check_lengths(rows[:, :3], f"{name}[{{}}].displacement")
    _check_lengths(rows[:, 7:], f"{name}[{{}}].about")
    i = _first(np.abs(rows[:, 6]) > checks.LARGEST_ANGLE)
    if i is not None:
        checks.angle(rows[i, 6], f"{name}[{i}].angle")


def _check_directions(v: np.ndarray, used: np.ndarray, name: str) -> None:
    largest = np.abs(v).max(axis=1, initial=0)
    i = _first(used & ~((largest >= checks.LEAST_COMPONENT) & (largest <= checks.MOST_COMPONENT)))
    if i is not None:
        checks.direction(v[i], name.format(i))


def _check_lengths(v: np.ndarray, name: str) -> None:
    i = _first(np.abs(v) > checks.LONGEST)
    if i is not None:
        checks.lengths(v[i], name.format(i))
