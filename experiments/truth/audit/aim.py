# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Measure how well the families achieve their aim, by the truth: python -m
experiments.truth.audit.aim [-n CASES] [FAMILY ...]

Per family and level: the number of cases by certified label; the number of rejected draws of
sweeps; the number of hits that tunnel if missed (start and end clear); and, if the family aims at a
signed gap, the median and the worst of reached / aimed (a clear case reaches its certified
clearance, a hit its estimated depth, which may be smaller in another direction).
"""

from __future__ import annotations

import argparse
from collections import Counter

import numpy as np

from experiments.cases.families import get, scenarios
from experiments.cases.scenario import Scenario
from experiments.truth import label

REDRAWS = 50


def survey(scenario: Scenario, level: float, cases: int, seed: int = 1) -> dict:
    """Counts of one family at one level, and the ratios of reached to aimed gap."""
    count, ratios = Counter(), []
    for index in range(cases):
        for attempt in range(REDRAWS):
            case = scenario.case(seed, level, index, attempt)
            truth = label(case.query)
            if not scenario.useless(truth):
                break
            count["redrawn"] += 1
        count[truth.label] += 1
        count["tunnels"] += truth.label == "hit" and truth.start == truth.end == "clear"
        if case.tags.get("aim") and truth.gap == truth.gap:
            ratios.append(truth.gap / case.tags["aim"])
    return {
        **{k: count[k] for k in ("hit", "clear", "uncertain", "redrawn", "tunnels")},
        "ratios": ratios,
    }


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("-n", "--cases", type=int, default=10, help="cases per level (10)")
    parser.add_argument("families", nargs="*", help="names (all)")
    options = parser.parse_args()
    counts = ("hit", "clear", "uncertain", "redrawn", "tunnels")
    print(
        f"{'family':20}{'level':>12}"
        + "".join(f"{c:>10}" for c in counts)
        + "   reached / aimed: median (worst)"
    )
    for name in options.families or scenarios():
        for level in get(name).levels:
            found = survey(get(name), level, options.cases)
            r = np.array(found["ratios"])
            reached = f"{np.median(r):.6g} ({r[np.argmax(np.abs(r - 1))]:.6g})" if len(r) else ""
            print(
                f"{name:20}{level:12g}"
                + "".join(f"{found[c]:10}" for c in counts)
                + "   "
                + reached,
                flush=True,
            )


if __name__ == "__main__":
    main()
