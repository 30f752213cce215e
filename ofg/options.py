# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The options of a query: the article by default, and every repair as a separate switch."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from . import _core, checks

TOI = ("none", "velocity", "bisection", "halving")
ORDER = ("ends", "steps")
BROAD = ("start", "swept")
CONCAVE = ("object", "undivided", "all-pairs")
PRECISION = ("double", "float")
NEAREST = ("centroid", "point-triangle")
SWITCHES = (
    "adaptive_k",
    "both_vertices",
    "edge_edge",
    "containment",
    "end_moment",
    "earliest",
    "screen",
)
#: former names of options
RENAMED = {"selection": "nearest", "selections": "selection_times"}

#: Name of a repair -> the options that it sets, and their values without it.
REPAIRS: Mapping[str, tuple[Mapping[str, Any], Mapping[str, Any]]] = {
    "point-triangle": ({"nearest": "point-triangle"}, {"nearest": "centroid"}),
    "adaptive-k": ({"adaptive_k": True}, {"adaptive_k": False}),
    "swept-spheres": ({"broad": "swept"}, {"broad": "start"}),
    "both-vertices": ({"both_vertices": True}, {"both_vertices": False}),
    "edge-edge": ({"edge_edge": True}, {"edge_edge": False}),
    "selection-times": ({"selection_times": 3}, {"selection_times": 1}),
    "arcs": ({"arc_tolerance": 1e-6}, {"arc_tolerance": 0.0}),
    "containment": ({"containment": True}, {"containment": False}),
    "all-pieces": ({"concave": "all-pairs"}, {"concave": "object"}),
    "end-moment": ({"end_moment": True}, {"end_moment": False}),
    "pieces-over-time": ({"piece_times": 3}, {"piece_times": 1}),
    "earliest": ({"earliest": True}, {"earliest": False}),
}


def repair_options(repairs: str) -> dict[str, Any]:
    """Options for a string: "none", "all", "all-but-X", "X" or "X+Y" with X, Y names of REPAIRS.

    "all-but-X" sets X's options to their values without it ("all-but-swept-spheres" tests step 1 at
    the start pose). Raises TypeError for a value that is not a string, ValueError for an unknown
    name.
    """
    if not isinstance(repairs, str):
        raise TypeError(
            f"repairs = {checks.shown(repairs)} must be a string; join several repairs with +, as "
            "in 'arcs+containment'."
        )
    if repairs == "none":
        return {}
    off = [repairs.removeprefix("all-but-")] if repairs.startswith("all-but-") else []
    on = list(REPAIRS) if off or repairs == "all" else repairs.split("+")
    unknown = [name for name in [*on, *off] if name not in REPAIRS]
    if unknown:
        raise ValueError(
            f"repairs = '{repairs}' contains an unknown repair '{unknown[0]}'; use none, all, "
            f"all-but-X, X or X+Y with X and Y of: {', '.join(REPAIRS)}."
        )
    options: dict[str, Any] = {}
    for name in on:
        options.update(REPAIRS[name][1 if name in off else 0])
    return options


def core_options(
    *, k: int = 8, toi: str = "velocity", repairs: str = "none", **own: Any
) -> _core.Options:
    """The core's options. `repairs` is applied first; an option given by its own name overrides it.
    See `discrete` for the options and errors.
    """
    chosen = {**repair_options(repairs), **own}
    o = _core.Options()
    o.k = checks.whole("k", k, 1)
    o.toi = checks.one_of("toi", toi, TOI)
    o.broad = checks.one_of("broad", chosen.pop("broad", "swept"), BROAD)
    o.concave = checks.one_of("concave", chosen.pop("concave", "object"), CONCAVE)
    o.order = checks.one_of("order", chosen.pop("order", "ends"), ORDER)
    o.nearest = checks.one_of("nearest", chosen.pop("nearest", "centroid"), NEAREST)
    o.selection_times = checks.whole("selection_times", chosen.pop("selection_times", 1), 1, 3)
    o.piece_times = checks.whole("piece_times", chosen.pop("piece_times", 1), 1, 3)
    o.iterations = checks.whole("iterations", chosen.pop("iterations", 20), 1, 60)
    o.arc_tolerance = _tolerance(chosen.pop("arc_tolerance", 0.0))
    for name in SWITCHES:
        setattr(o, name, checks.truth(name, chosen.pop(name, False)))
    if chosen:
        _refuse(next(iter(chosen)))
    return o


def check_options(*, precision: str = "double", **options: Any) -> None:
    """Raise TypeError or ValueError for options that `discrete` would reject."""
    checks.one_of("precision", precision, PRECISION)
    core_options(**options)


def check_article(options: Mapping[str, Any]) -> None:
    """Raise TypeError for an option that the article's steps do not have."""
    known = ("k", "toi", "order", "iterations", "broad", "precision")
    for name in options:
        if name not in known:
            raise TypeError(f"The article has no option '{name}'; it has {', '.join(known)}.")


def _tolerance(value: Any) -> float:
    tolerance = checks.number(value, "arc_tolerance")
    if not 0 <= tolerance < 1:
        raise ValueError(
            f"arc_tolerance = {tolerance} must lie in [0, 1): the largest deviation of a chord as "
            "a share of A's radius; 0 divides no arcs."
        )
    return tolerance


def _refuse(name: str) -> None:
    if name in RENAMED:
        raise TypeError(f"OFG no longer has an option '{name}'; it is called '{RENAMED[name]}'.")
    raise TypeError(
        f"OFG has no option '{name}'; it has k, toi, broad, concave, order, iterations, repairs,"
        " nearest, adaptive_k, both_vertices, edge_edge, selection_times, arc_tolerance,"
        " containment, end_moment, piece_times, earliest, screen."
    )
