# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Opposing Face Geometry itself, under the same contract as the engines."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import inf

import ofg
from ofg import QUESTIONS, Query
from ofg.algorithm import ARTICLE
from ofg.options import check_options

from .contract import Method, Unsupported, Verdict

#: options that the article does not have; `broad` and `concave` are readings of it
_REPAIRED = frozenset(
    {
        "nearest",
        "adaptive_k",
        "both_vertices",
        "edge_edge",
        "selection_times",
        "arc_tolerance",
        "containment",
        "end_moment",
        "piece_times",
        "earliest",
    }
)


class Article(Method):
    """The article's steps only, without acceleration or repairs: the cost and the answers of its
    own arithmetic.

    k: faces per selection; "inf" for all. toi, order, broad: the article's two ways to compute the
    time, the order of its tests, and step 1 at the start pose, the literal reading, or with swept
    spheres. `ofg` gives the same answers with the same options, faster.
    """

    name = "ofg-article"
    engine = "ofg"
    imports = "ofg"
    configuration = "article"
    questions = frozenset(QUESTIONS)
    bodies = frozenset({"convex", "union", "mesh"})
    solid = False
    movers, about = 2, True
    decomposes = True
    gives_time = True
    guarantee = (
        "a hit is a contact of faces to double rounding; contacts may be missed without bound"
    )
    parameters = {
        "k": 8,
        "toi": "velocity",
        "order": "ends",
        "broad": "start",
        "iterations": 20,
        "precision": "double",
    }
    unlimited = frozenset({"k"})

    def __init__(self, **parameters):
        super().__init__(**parameters)
        _check(self.name, self.options)
        self.precision = "single" if self.parameters["precision"] == "float" else "double"

    def prepare(self, query: Query) -> Callable[[], Verdict]:
        self.refuse(query)
        query = replace(query, a=_pieces(query.a), b=_pieces(query.b))
        ask = ofg.prepare(query, algorithm=ARTICLE, **self.options())
        return lambda: Verdict(*ask())

    def options(self) -> dict:
        return {**self.parameters, "k": _faces(self.parameters["k"])}


class OpposingFaceGeometry(Method):
    """The article with accelerations that do not change the answer, and with `repairs` (see
    ofg.REPAIRS: "all", "all-but-X", "X", "X+Y") that do.

    k: faces per selection; "inf" for all. concave: how a body that is not convex is tested:
    "object" (OFG selects one pair of pieces; a mesh is first decomposed by CoACD, cached),
    "undivided" (its surface as one mesh), "all-pairs" of pieces. With adaptive k, which does not
    need convexity, a mesh is tested undivided: CoACD's pieces only approximate the mesh, and 1 of 9
    linked tori 1e-5 deep was missed in them.
    """

    name = "ofg"
    engine = "ofg"
    imports = "ofg"
    configuration = "article"
    questions = frozenset(QUESTIONS)
    bodies = frozenset({"convex", "union", "mesh"})
    solid = False
    movers, about = 2, True
    gives_time = True
    guarantee = (
        "a hit is a contact of faces to double rounding; without repairs contacts may be missed "
        "without bound"
    )
    parameters = {
        "k": 8,
        "toi": "velocity",
        "broad": "swept",
        "concave": "object",
        "repairs": "none",
        "nearest": "centroid",
        "adaptive_k": False,
        "both_vertices": False,
        "edge_edge": False,
        "selection_times": 1,
        "arc_tolerance": 0.0,
        "containment": False,
        "end_moment": False,
        "piece_times": 1,
        "earliest": False,
        "order": "ends",
        "iterations": 20,
        "screen": False,
        "precision": "double",
    }
    unlimited = frozenset({"k"})

    def __init__(self, **parameters):
        super().__init__(**parameters)
        _check(self.name, self.options)
        repaired = {
            name
            for name, value in self.options().items()
            if name in _REPAIRED and value != type(self).parameters[name]
        }
        self.solid = "containment" in repaired
        self.precision = "single" if self.parameters["precision"] == "float" else "double"
        if repaired:
            self.configuration = (
                "best effort" if self.parameters["repairs"] == "all" else "alternative"
            )

    def prepare(self, query: Query) -> Callable[[], Verdict]:
        self.refuse(query)
        options = self.options()
        if self.decomposes:
            query = replace(query, a=_pieces(query.a), b=_pieces(query.b))
        ask = ofg.prepare(query, **options)
        return lambda: Verdict(*ask())

    @property
    def decomposes(self) -> bool:
        """Whether meshes are decomposed before the query."""
        options = self.options()
        return options.get("concave") != "undivided" and not options.get("adaptive_k")

    def options(self) -> dict:
        """The core's options: the repairs, overridden by options given by name. ValueError for
        an unknown repair.
        """
        given = {
            name: value
            for name, value in self.parameters.items()
            if value != type(self).parameters[name]
        }
        return {
            **ofg.repair_options(given.pop("repairs", "none")),
            **given,
            "k": _faces(self.parameters["k"]),
        }


def _check(name: str, options: Callable[[], dict]) -> None:
    """Raise ValueError if OFG rejects the options."""
    try:
        check_options(**options())
    except (TypeError, ValueError) as error:
        raise ValueError(f"Method '{name}': {error}") from error


def _faces(k) -> int:
    return 2**31 - 1 if k in ("inf", inf) else k


def _pieces(body: ofg.Body) -> ofg.Body:
    try:
        return ofg.decompose(body)
    except ofg.BodyError as error:
        raise Unsupported(f"no convex pieces: {error}") from error


METHODS = [OpposingFaceGeometry, Article]
