# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""All faces against all faces: the answer that OFG approaches as k grows."""

from __future__ import annotations

from collections.abc import Callable

import ofg
from ofg import QUESTIONS, Query
from ofg.algorithm import BRUTE_FORCE

from .contract import Method, Verdict


class BruteForce(Method):
    """Tests every pair of faces and, in a sweep, every virtual edge of A against every face of
    B. It tests surfaces, and sweeps only A's vertices.
    """

    name = "brute-force"
    engine = "ofg"
    imports = "ofg"
    configuration = "article"
    questions = frozenset(QUESTIONS)
    bodies = frozenset({"convex", "union", "mesh"})
    solid = False
    movers, about = 2, True
    gives_time = True
    guarantee = (
        "overlap: finds surfaces that intersect, to double rounding; sweeps: finds only what A's "
        "vertices hit along their chords"
    )

    def prepare(self, query: Query) -> Callable[[], Verdict]:
        self.refuse(query)
        ask = ofg.prepare(query, algorithm=BRUTE_FORCE)
        return lambda: Verdict(*ask())


METHODS = [BruteForce]
