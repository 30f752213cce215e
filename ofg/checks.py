"""Is a value what it should be? Each check raises a TypeError or a ValueError of one sentence."""

from __future__ import annotations

from typing import Any, Sequence

import numpy as np

#: Greatest length in poses, motions and bodies: the core multiplies a few of them with one another.
LONGEST = 1e60
#: Least of the largest coordinate of a body: what is smaller has products that vanish.
SMALLEST = 1e-60
#: The same two with precision = "float".
LONGEST_FLOAT, SMALLEST_FLOAT = 1e10, 1e-10
#: Range of the largest component of a quaternion or of an axis, which may have any length within.
LEAST_COMPONENT, MOST_COMPONENT = 1e-300, 1e300
#: Greatest angle of a turn, in radians: one more turn is still one in double rounding.
LARGEST_ANGLE = 1e9


def of_type(value: Any, kind: type, name: str, remedy: str) -> Any:
    """The value, which is of this type. TypeError if not."""
    if isinstance(value, kind):
        return value
    article = "an" if type(value).__name__[:1] in "aeiouAEIOU" else "a"
    raise TypeError(
        f"{name} must be an ofg.{kind.__name__}, not {article} {type(value).__name__}; {remedy}."
    )


def body(value: Any, name: str) -> Any:
    """The value, which is an ofg.Body. TypeError if not."""
    from .body import Body

    remedy = "make one with Body.convex, Body.mesh, Body.union, Body.from_trimesh or Body.from_file"
    return of_type(value, Body, name, remedy)


def pose(value: Any, name: str) -> Any:
    """The value, which is an ofg.Pose. TypeError if not."""
    from .pose import Pose

    return of_type(value, Pose, name, "give Pose(quaternion, position)")


def query(value: Any) -> Any:
    """The value, which is an ofg.Query. TypeError if not."""
    from .query import Query

    return of_type(value, Query, "query", "give Query(question, a, b, ...)")


def motion(value: Any, name: str) -> Any:
    """The value, which is an ofg.Motion. TypeError if not."""
    from .motion import Motion

    remedy = "give Motion(displacement, axis, angle, about), or Motion() for rest"
    return of_type(value, Motion, name, remedy)


def vector(value: Any, size: int, name: str) -> np.ndarray:
    """(size,) float64, finite, that nobody can write to. TypeError or ValueError if not."""
    try:
        v = np.array(value, dtype=np.float64)
    except (TypeError, ValueError):
        raise TypeError(f"{name} must hold {size} numbers, but is {value!r}.") from None
    if v.shape != (size,):
        raise ValueError(f"{name} must have shape ({size},), not {v.shape}.")
    if not np.isfinite(v).all():
        raise ValueError(
            f"{name} = {v.tolist()} holds a number that is not finite; every component must be "
            "finite."
        )
    v.setflags(write=False)
    return v


def number(value: Any, name: str) -> float:
    """A finite float. TypeError or ValueError if not."""
    try:
        x = float(value)
    except (TypeError, ValueError):
        raise TypeError(f"{name} must be a number, but is {value!r}.") from None
    if not np.isfinite(x):
        raise ValueError(f"{name} = {x} is not finite.")
    return x


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


def coordinates(body, precision: str = "double") -> None:
    """ValueError for a body that is too small or too large for the core."""
    single = precision == "float"
    least, most = (SMALLEST_FLOAT, LONGEST_FLOAT) if single else (SMALLEST, LONGEST)
    largest = float(np.abs(body.vertices).max())
    if not least <= largest <= most:
        raise ValueError(
            f"Body '{body.name}' has {largest:g} as its largest coordinate; precision = "
            f"'{precision}' takes bodies from {least:g} to {most:g}, so use another unit of length"
            f"{', or double' if single else ''}."
        )


def whole(name: str, value: Any, least: int, most: int = 2**31 - 1) -> int:
    """An int within a range. ValueError if not."""
    try:
        fits = not isinstance(value, (bool, np.bool_)) and int(value) == value
    except (TypeError, ValueError, OverflowError):
        fits = False
    if not fits or not least <= value <= most:
        raise ValueError(f"{name} = {value!r} must be a whole number from {least} to {most}.")
    return int(value)


def truth(name: str, value: Any) -> bool:
    """A bool. TypeError for anything else: the word "False" would count as true."""
    if isinstance(value, (bool, np.bool_)):
        return bool(value)
    raise TypeError(f"{name} = {value!r} must be True or False.")


def one_of(name: str, value: Any, known: Sequence[str]) -> int:
    """The place of a word among those known. ValueError if it is not there."""
    if not isinstance(value, str) or value not in known:
        raise ValueError(f"{name} = {value!r} is unknown; use one of {', '.join(known)}.")
    return list(known).index(value)
