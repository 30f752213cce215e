"""The faulty methods as a method file: ofg-bench run mine.toml --methods experiments/drill/faulty/methods.py"""

from itertools import count

from baselines.contract import Method, Verdict
from experiments.drill.faulty import answers, ends, errors, hangs, leftovers, surroundings  # noqa: F401: each adds its kinds
from experiments.drill.faulty.kind import KINDS, Kind
from ofg import QUESTIONS


def method(kind: Kind) -> type[Method]:
    """The class of methods that are faulty in this way."""

    def prepare(self, query):
        if kind.built:
            kind.act(query, 1)
            return lambda: Verdict(True)
        calls = count(1)
        return lambda: kind.act(query, next(calls))

    return type(kind.name, (Method,), {
        "name": kind.name, "engine": "numpy", "imports": "numpy", "configuration": "default", "solid": True, "movers": 2, "about": True,
        "questions": frozenset(QUESTIONS), "bodies": frozenset({"convex", "union", "mesh"}), "guarantee": "none: it is faulty", "prepare": prepare})


METHODS = [method(kind) for kind in KINDS.values()]
