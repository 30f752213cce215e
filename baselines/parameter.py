"""A parameter of a method: whether a value is of its kind and within what the method declares."""

from __future__ import annotations

from collections.abc import Sequence
from math import inf, isfinite
from typing import Any

#: (least, most) of a number, or the words that a text may be
Allowed = Sequence[Any]


def fault(value: Any, default: Any, allowed: Allowed | None, unlimited: bool) -> str | None:
    """What the value must be, where it is not that: "must be ..."; None where it is.

    default: tells the kind. allowed: None for every value of that kind. unlimited: inf will do.
    """
    if unlimited and value in ("inf", inf):
        return None
    if not _of_kind(value, default):
        return f"must be {_KINDS.get(type(default), type(default).__name__)}"
    if allowed is None:
        return None
    if isinstance(default, str):
        return None if value in allowed else f"must be one of {', '.join(allowed)}"
    least, most = allowed
    if least <= value <= most:
        return None
    return f"must be {least} or more" if most == inf else f"must be from {least} to {most}"


_KINDS = {bool: "True or False", int: "a whole number", float: "a finite number", str: "a word"}


def _of_kind(value: Any, default: Any) -> bool:
    if isinstance(default, bool) or isinstance(value, bool):
        return isinstance(default, bool) and isinstance(value, bool)
    if isinstance(default, float):
        return isinstance(value, (int, float)) and isfinite(value)
    return isinstance(value, type(default))
