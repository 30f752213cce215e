"""Claims of the remedy for concave bodies."""

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
    f"misses with k = 8 under {MISSES:.0%} in each concave family",
    "concavity/tables/concavity-misses.md concavity/tables/concavity-wrong.md",
    "Pieces by CoACD at its default threshold; where they are not quite the mesh, all pairs of"
    " pieces err too.",
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
        f"By family, k = 8: {listed(own)}. All of them: {listed(others)}.",
    )


@claim(
    "Some concave bodies work undivided, and some case will fail",
    f"{PROBLEMS}, first",
    "the undivided surface is right of some concave hits and misses others",
    "concavity/tables/concavity-wrong.md",
    "Surfaces of up to thousands of faces: the selection misses some of it whatever the shape,"
    " hence k = 64 and all faces beside it.",
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
        f"k = 64: {rate(found, method=more)}; all faces:"
        f" {or_reason(rate, found, method='brute-force')}. Missed at rest by"
    )
    text += (
        f" both k, found by all faces: `ofg-bench explain {shown[0]} --run results/concavity`."
        if shown
        else " both k: no case."
    )
    return (HOLDS if 0 < missed.count < missed.total else FAILS), f"missed with k=8: {missed}", text
