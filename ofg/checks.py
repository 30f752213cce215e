# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Argument checks, each of which raises a TypeError or a ValueError of one sentence."""

from __future__ import annotations

from collections.abc import Sequence
from numbers import Real
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from .body import Body

#: Greatest length in poses, motions and bodies: the core multiplies a few of them together.
LONGEST = 1e60
#: Smallest value of the largest coordinate of a body: products of smaller ones underflow.
SMALLEST = 1e-60
#: The same two limits with precision = "float".
LONGEST_FLOAT, SMALLEST_FLOAT = 1e10, 1e-10
#: Range of the largest component of a quaternion or an axis, whose length is otherwise arbitrary.
LEAST_COMPONENT, MOST_COMPONENT = 1e-300, 1e300
#: Greatest angle of rotation, in radians: adding one more turn is still resolved in doubles.
LARGEST_ANGLE = 1e9


def of_type(value: Any, kind: type, name: str, remedy: str) -> Any:
    """Return the value if it is of this type. TypeError if not."""
    if isinstance(value, kind):
        return value
    article = "an" if type(value).__name__[:1] in "aeiouAEIOU" else "a"
    raise TypeError(
        f"{name} must be an ofg.{kind.__name__}, not {article} {type(value).__name__}; {remedy}."
    )


def body(value: Any, name: str) -> Any:
    """Return the value if it is an ofg.Body. TypeError if not."""
    from .body import Body

    remedy = "make one with Body.convex, Body.mesh, Body.union, Body.from_trimesh or Body.from_file"
    return of_type(value, Body, name, remedy)


def pose(value: Any, name: str) -> Any:
    """Return the value if it is an ofg.Pose. TypeError if not."""
    from .pose import Pose

    return of_type(value, Pose, name, "give Pose(quaternion, position)")


def query(value: Any) -> Any:
    """Return the value if it is an ofg.Query. TypeError if not."""
    from .query import Query

    return of_type(value, Query, "query", "give Query(question, a, b, ...)")


def motion(value: Any, name: str) -> Any:
    """Return the value if it is an ofg.Motion. TypeError if not."""
    from .motion import Motion

    remedy = "give Motion(displacement, axis, angle, about), or Motion() for rest"
    return of_type(value, Motion, name, remedy)


def vector(value: Any, size: int, name: str) -> np.ndarray:
    """(size,) float64, finite and read-only. TypeError or ValueError if the value does not fit."""
    try:
        v = reals(value)
    except TypeError:
        raise TypeError(f"{name} must contain {size} numbers, but is {shown(value)}.") from None
    if v.shape != (size,):
        raise ValueError(f"{name} must have shape ({size},), not {v.shape}.")
    if not np.isfinite(v).all():
        raise ValueError(
            f"{name} = {v.tolist()} contains a number that is not finite; every component must be "
            "finite."
        )
    v.setflags(write=False)
    return v


def reals(value: Any) -> np.ndarray:
    """A new array of doubles. TypeError for anything but real numbers: NumPy would convert strings
    and booleans. Numbers too large for a double become infinite.
    """
    try:
        a = np.array(value)
    except ValueError as error:
        raise TypeError(str(error)) from None
    if a.dtype == object:
        if not all(isinstance(x, Real) and not isinstance(x, bool) for x in a.flat):
            raise TypeError("not all are numbers")
        return np.array([_double(x) for x in a.flat]).reshape(a.shape)
    if a.dtype.kind not in "fiu" and a.size:
        raise TypeError(f"{a.dtype} is not a type of real numbers")
    return a.astype(np.float64)


def _double(x: Any) -> float:
    try:
        return float(x)
    except OverflowError:
        return np.inf if x > 0 else -np.inf


def shown(value: Any) -> str:
    """A value as one short line for an error message."""
    text = " ".join(repr(value).split())
    return text if len(text) <= 80 else f"{text[:60]}..., a {type(value).__name__}"


def word(value: Any, name: str) -> str:
    """A str. TypeError for anything else."""
    if isinstance(value, str):
        return value
    raise TypeError(f"{name} = {shown(value)} must be a string.")


def points(value: Any, name: str) -> np.ndarray:
    """(n, 3) or (3,) float64. TypeError or ValueError if not."""
    try:
        v = reals(value)
    except TypeError:
        raise TypeError(f"{name} must contain numbers, but is {shown(value)}.") from None
    if v.ndim not in (1, 2) or v.shape[-1] != 3:
        raise ValueError(f"{name} must have shape (n, 3), not {v.shape}.")
    return v


def number(value: Any, name: str) -> float:
    """A finite float. TypeError or ValueError if not."""
    try:
        x = reals(value)
    except TypeError:
        x = np.empty(1)
    if x.ndim:
        raise TypeError(f"{name} must be a number, but is {shown(value)}.")
    found = float(x)
    if not np.isfinite(found):
        raise ValueError(f"{name} = {found} is not finite.")
    return found


def lengths(v: np.ndarray, name: str, most: float = LONGEST) -> None:
    """ValueError for a length out of range."""
    if v.size and np.abs(v).max() > most:
        raise ValueError(
            f"{name} = {v.tolist()} is out of range; lengths up to {most:g} are supported."
        )


def direction(v: np.ndarray, name: str) -> None:
    """ValueError for a quaternion or an axis whose largest component is out of range."""
    largest = np.abs(v).max()
    if not LEAST_COMPONENT <= largest <= MOST_COMPONENT:
        raise ValueError(
            f"{name} = {v.tolist()} is out of range; its largest component must be between "
            f"{LEAST_COMPONENT:g} and {MOST_COMPONENT:g} in size."
        )


def angle(x: float, name: str) -> None:
    """ValueError for an angle out of range."""
    if abs(x) > LARGEST_ANGLE:
        raise ValueError(
            f"{name} = {x:g} is out of range; angles up to {LARGEST_ANGLE:g} radians are supported."
        )


def coordinates(body: Body, precision: str = "double") -> None:
    """ValueError for a body that is too small or too large for the core."""
    single = precision == "float"
    least, most = (SMALLEST_FLOAT, LONGEST_FLOAT) if single else (SMALLEST, LONGEST)
    largest = float(np.abs(body.vertices).max())
    if not least <= largest <= most:
        raise ValueError(
            f"Body '{body.name}' has {largest:g} as its largest coordinate; precision = "
            f"'{precision}' supports bodies from {least:g} to {most:g}, so use another unit of "
            f"length{', or double' if single else ''}."
        )


def whole(name: str, value: Any, least: int, most: int = 2**31 - 1) -> int:
    """An int within a range. ValueError if not."""
    try:
        fits = not isinstance(value, (bool, np.bool_)) and int(value) == value
    except (TypeError, ValueError, OverflowError):
        fits = False
    if not fits or not least <= value <= most:
        raise ValueError(f"{name} = {shown(value)} must be a whole number from {least} to {most}.")
    return int(value)


def truth(name: str, value: Any) -> bool:
    """A bool. TypeError for anything else: the string "False" would count as true."""
    if isinstance(value, (bool, np.bool_)):
        return bool(value)
    raise TypeError(f"{name} = {shown(value)} must be True or False.")


def one_of(name: str, value: Any, known: Sequence[str]) -> int:
    """The index of a string among the known ones. ValueError if it is unknown."""
    if not isinstance(value, str) or value not in known:
        raise ValueError(f"{name} = {shown(value)} is unknown; use one of {', '.join(known)}.")
    return list(known).index(value)
