# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Checks that a parameter's value has the right type and lies in the range that the method
declares.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import inf, isfinite
from typing import Any

#: (least, most) of a number, or the allowed strings
Allowed = Sequence[Any]


def fault(value: Any, default: Any, allowed: Allowed | None, unlimited: bool) -> str | None:
    """What the value must be, if it is not: "must be ..."; None if it is valid.

    default: gives the type. allowed: None for every value of that type. unlimited: inf is allowed.
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


_KINDS = {bool: "True or False", int: "a whole number", float: "a finite number", str: "a string"}


def _of_kind(value: Any, default: Any) -> bool:
    if isinstance(default, bool) or isinstance(value, bool):
        return isinstance(default, bool) and isinstance(value, bool)
    if isinstance(default, float):
        return isinstance(value, (int, float)) and isfinite(value)
    return isinstance(value, type(default))
