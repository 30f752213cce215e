"""What may be chosen in a query: OFG as written by default, and every repair as a switch of its own."""

from __future__ import annotations

from typing import Any, Mapping

from . import _core

TOI = ("none", "velocity", "bisection")
BROAD = ("start", "swept")
CONCAVE = ("object", "undivided", "all-pairs")
SELECTION = ("centroid", "point-triangle")

#: name of a repair -> the options that it sets, and what they are without it.
REPAIRS: Mapping[str, tuple[Mapping[str, Any], Mapping[str, Any]]] = {
    "point-triangle": ({"selection": "point-triangle"}, {"selection": "centroid"}),
    "adaptive-k": ({"adaptive_k": True}, {"adaptive_k": False}),
    "swept-spheres": ({"broad": "swept"}, {"broad": "start"}),
    "both-vertices": ({"both_vertices": True}, {"both_vertices": False}),
    "edge-edge": ({"edge_edge": True}, {"edge_edge": False}),
    "selection-times": ({"selections": 3}, {"selections": 1}),
    "arcs": ({"arc_tolerance": 1e-6}, {"arc_tolerance": 0.0}),
    "containment": ({"containment": True}, {"containment": False}),
    "all-pieces": ({"concave": "all-pairs"}, {"concave": "object"}),
    "earliest": ({"earliest": True}, {"earliest": False}),
}


def repair_options(repairs: str) -> dict[str, Any]:
    """Options for a word: "none", "all", "all-but-X", "X" or "X+Y" with X, Y names of REPAIRS.

    "all-but-X" sets X's options to what they are without it ("all-but-swept-spheres" tests step 1 at the start pose).
    Raises ValueError for a name that is not one.
    """
    if repairs == "none":
        return {}
    off = [repairs.removeprefix("all-but-")] if repairs.startswith("all-but-") else []
    on = list(REPAIRS) if off or repairs == "all" else repairs.split("+")
    unknown = [name for name in [*on, *off] if name not in REPAIRS]
    if unknown:
        raise ValueError(
            f"repairs = '{repairs}' names no repair '{unknown[0]}'; there are none, all, all-but-X, X and X+Y with X and Y of: "
            f"{', '.join(REPAIRS)}."
        )
    options: dict[str, Any] = {}
    for name in on:
        options.update(REPAIRS[name][1 if name in off else 0])
    return options


def core_options(*, k: int = 8, toi: str = "velocity", repairs: str = "none", **own: Any) -> _core.Options:
    """The core's options. `repairs` is applied first; what is given by its own name overrules it. See `discrete` for each."""
    chosen = {**repair_options(repairs), **own}
    o = _core.Options()
    o.k = _whole("k", k, 1)
    o.toi = _one_of("toi", toi, TOI)
    o.broad = _one_of("broad", chosen.pop("broad", "swept"), BROAD)
    o.concave = _one_of("concave", chosen.pop("concave", "object"), CONCAVE)
    o.nearest = _one_of("selection", chosen.pop("selection", "centroid"), SELECTION)
    o.selections = _whole("selections", chosen.pop("selections", 1), 1, 3)
    o.iterations = _whole("iterations", chosen.pop("iterations", 20), 1, 60)
    o.arc_tolerance = float(chosen.pop("arc_tolerance", 0.0))
    if not 0 <= o.arc_tolerance < 1:
        raise ValueError(
            f"arc_tolerance = {o.arc_tolerance} must lie in [0, 1): the share of A's radius that a chord may stray by; 0 cuts no arcs."
        )
    for name in ("adaptive_k", "both_vertices", "edge_edge", "containment", "earliest", "screen"):
        setattr(o, name, bool(chosen.pop(name, False)))
    if chosen:
        raise TypeError(
            f"OFG has no option '{next(iter(chosen))}'; it has k, toi, broad, concave, iterations, repairs, selection, adaptive_k, "
            "both_vertices, edge_edge, selections, arc_tolerance, containment, earliest, screen."
        )
    return o


def _one_of(name: str, value: str, known: tuple[str, ...]) -> int:
    if value not in known:
        raise ValueError(f"{name} = {value!r} is unknown; use one of {', '.join(known)}.")
    return known.index(value)


def _whole(name: str, value: int, least: int, most: int = 2**31 - 1) -> int:
    if isinstance(value, bool) or int(value) != value or not least <= value <= most:
        raise ValueError(
            f"{name} = {value!r} must be a whole number of {least} or more{f', at most {most}' if most < 2**31 - 1 else ''}."
        )
    return int(value)
