"""Opposing Face Geometry itself, behind the same contract as the engines."""

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
    """The article's steps and nothing else: no acceleration, no repair. What its own arithmetic
    costs, and what it answers.

    k: faces per selection; "inf" for all. toi, order, broad: his two ways to the time, the order of
    his tests, and step 1 at the start pose, as it reads literally, or with swept spheres. `ofg`
    gives the same answers to the same options, sooner.
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
        "a hit is a contact of faces to double rounding; nothing is promised about what it does not"
        " find"
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
    """The article with accelerations that change no answer; with `repairs` (see ofg.REPAIRS: "all",
    "all-but-X", "X", "X+Y") more.

    k: faces per selection; "inf" for all. concave: how a body that is not convex is asked: "object"
    (OFG picks one pair of pieces; a mesh is first decomposed by CoACD, cached), "undivided" (its
    surface as one mesh), "all-pairs" of pieces. With adaptive k, which needs no convexity, a mesh
    is asked as it is: CoACD's pieces are not quite the mesh, and 1 of 9 linked tori 1e-5 deep was
    missed in them.
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
        "a hit is a contact of faces to double rounding; without repairs nothing is promised about"
        " what it does not find"
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
        """Whether meshes are decomposed before they are asked."""
        options = self.options()
        return options.get("concave") != "undivided" and not options.get("adaptive_k")

    def options(self) -> dict:
        """What the core is asked with: the repairs, overruled by what is given by name. ValueError
        for an unknown repair.
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
    """ValueError where OFG refuses the options."""
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
