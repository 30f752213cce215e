# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Claims on the algorithm for concave bodies."""

from __future__ import annotations

from experiments.publish.findings.runs import (
    FAILS,
    HOLDS,
    MISSES,
    Runs,
    are_small,
    by_family,
    listed,
    or_reason,
    rate,
    rows,
    spread,
)

from .claim import CONCAVE, PROBLEMS, claim


@claim(
    "The pieces with the closest centres are the ones to test",
    CONCAVE,
    f"the rate of misses with k = 8 is under {MISSES:.0%} in each concave family",
    "concavity/tables/concavity-misses.md concavity/tables/concavity-wrong.md",
    "CoACD makes the pieces at its default threshold. Where they differ from the mesh, testing all"
    " pairs of pieces also gives wrong answers.",
)
def one_pair_of_pieces(runs: Runs):
    found = runs.answers("concavity")
    own = by_family(found, "ofg k=8")
    others = {
        name: or_reason(rate, found, method=m)
        for name, m in (
            ("one pair of pieces", "ofg k=8"),
            ("all pairs of pieces", "ofg k=8 concave=all-pairs"),
            ("all repairs", "ofg k=8 repairs=all"),
        )
    }
    return (
        are_small(own.values()),
        f"missed with k=8: {spread(own)}",
        f"By family, k = 8: {listed(own)}. All families together: {listed(others)}.",
    )


@claim(
    "Some concave bodies work undivided, and some case will fail",
    f"{PROBLEMS}, first",
    "with the undivided surface, some concave hits are found and others missed",
    "concavity/tables/concavity-wrong.md",
    "The surfaces have up to thousands of faces, of which a selection covers only a part whatever"
    " the shape; k = 64 and all faces are therefore given for comparison.",
)
def undivided(runs: Runs):
    found = runs.answers("concavity")
    missed, more = rate(found, method="ofg k=8 concave=undivided"), "ofg k=64 concave=undivided"
    hits = rows(found, label="hit", question="overlap")
    failed = {m: set(part.case[part.outcome == "miss"]) for m, part in hits.groupby("method")}
    shown = sorted(
        failed[more] & failed["ofg k=8 concave=undivided"] - failed.get("brute-force", set())
    )
    text = (
        f"Missed with k = 64: {rate(found, method=more)}; with all faces:"
        f" {or_reason(rate, found, method='brute-force')}. Example of an overlap missed with both k"
    )
    text += (
        f" and found with all faces: `ofg-bench explain {shown[0]} --run results/concavity`."
        if shown
        else " and found with all faces: none."
    )
    return (HOLDS if 0 < missed.count < missed.total else FAILS), f"missed with k=8: {missed}", text
