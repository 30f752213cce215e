# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The faulty methods as a method file: ofg-bench run mine.toml --methods
experiments/drill/faulty/methods.py
"""

from itertools import count

from baselines.contract import Method, Verdict
from experiments.drill.faulty import (  # noqa: F401 - each adds its kinds
    answers,
    ends,
    errors,
    hangs,
    leftovers,
    surroundings,
)
from experiments.drill.faulty.kind import KINDS, Kind
from ofg import QUESTIONS


def method(kind: Kind) -> type[Method]:
    """The class of a method with this fault."""

    def prepare(self, query):
        if kind.built:
            kind.act(query, 1)
            return lambda: Verdict(True)
        calls = count(1)
        return lambda: kind.act(query, next(calls))

    return type(
        kind.name,
        (Method,),
        {
            "__module__": __name__,  # by which the registry recognises a file's own methods
            "name": kind.name,
            "engine": "numpy",
            "imports": "numpy",
            "configuration": "default",
            "solid": True,
            "movers": 2,
            "about": True,
            "questions": frozenset(QUESTIONS),
            "bodies": frozenset({"convex", "union", "mesh"}),
            "guarantee": "none: it is faulty",
            "prepare": prepare,
        },
    )


METHODS = [method(kind) for kind in KINDS.values()]
