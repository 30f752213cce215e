# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Checks that a method's class attributes are complete and of the types that tables and records
need.
"""

from __future__ import annotations

from collections.abc import Mapping

from ofg import QUESTIONS

from .contract import Method, Tolerance

WORDS = ("name", "engine", "imports", "configuration", "guarantee")
SETS = {"questions": frozenset(QUESTIONS), "bodies": frozenset({"convex", "union", "mesh"})}
OF_A_CLASS = (
    "It must be a subclass of baselines.contract.Method, whose attributes "
    "experiments/EXTENDING.md lists."
)


def fault(cls: object) -> str:
    """The fault of a method's declaration, as a sentence with the remedy; "" if there is none."""
    if not (isinstance(cls, type) and issubclass(cls, Method)):
        return f"{cls!r} in METHODS is not the class of a method. {OF_A_CLASS}"
    lacking = [name for name in (*WORDS, *SETS, "solid") if not hasattr(cls, name)]
    if lacking:
        return (
            f"{cls.__name__} lacks {', '.join(lacking)}. Set"
            f" {'it' if len(lacking) == 1 else 'them'} in the class."
        )
    return next((f"{cls.__name__}.{name} {why}." for name, why in _wrong(cls)), "")


def _wrong(cls: type[Method]):
    for name in WORDS:
        if not (
            isinstance(value := getattr(cls, name), str) and value.strip() and value.isprintable()
        ):
            yield name, f"is {value!r}; it must be text on one line"
    if " " in cls.name:
        yield "name", f"is '{cls.name}'; it must have no spaces"
    for name, known in SETS.items():
        value = getattr(cls, name)
        if (
            not isinstance(value, (set, frozenset, tuple, list))
            or not value
            or not set(value) <= known
        ):
            yield name, f"is {value!r}; it must be a set of {', '.join(sorted(known))}"
    if cls.swept is not None and not set(cls.swept) <= set(cls.bodies):
        yield "swept", f"is {cls.swept!r}; it must be some of the method's bodies, or None"
    if not isinstance(cls.solid, bool):
        yield "solid", f"is {cls.solid!r}; it must be True (tests solids) or False (tests surfaces)"
    if hasattr(cls, "margin"):
        yield (
            "margin",
            (
                "is no longer supported; declare tolerance = Tolerance(length=...), of "
                "baselines.contract"
            ),
        )
    if not isinstance(cls.tolerance, (Tolerance, property)):
        yield "tolerance", f"is {cls.tolerance!r}; it must be a Tolerance, of baselines.contract"
    if not isinstance(cls.parameters, Mapping):
        yield "parameters", f"is {cls.parameters!r}; it must be a dict of defaults by name"
