"""What a method declares by its class attributes: all there, and of the kind that tables and
records expect.
"""

from __future__ import annotations

from collections.abc import Mapping

from ofg import QUESTIONS

from .contract import Method, Tolerance

WORDS = ("name", "engine", "imports", "configuration", "guarantee")
SETS = {"questions": frozenset(QUESTIONS), "bodies": frozenset({"convex", "union", "mesh"})}
OF_A_CLASS = (
    "It is a subclass of baselines.contract.Method, whose attributes experiments/EXTENDING.md"
    " lists."
)


def fault(cls: object) -> str:
    """What is wrong with the declaration of a method, as a sentence with the remedy; "" if nothing
    is.
    """
    if not (isinstance(cls, type) and issubclass(cls, Method)):
        return f"{cls!r} in METHODS is no class of a method. {OF_A_CLASS}"
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
    if not isinstance(cls.solid, bool):
        yield "solid", f"is {cls.solid!r}; it must be True (tests solids) or False (tests surfaces)"
    if hasattr(cls, "margin"):
        yield (
            "margin",
            (
                "is not read any more; declare tolerance = Tolerance(length=...), of"
                " baselines.contract"
            ),
        )
    if not isinstance(cls.tolerance, (Tolerance, property)):
        yield "tolerance", f"is {cls.tolerance!r}; it must be a Tolerance, of baselines.contract"
    if not isinstance(cls.parameters, Mapping):
        yield "parameters", f"is {cls.parameters!r}; it must be a dict of defaults by name"
