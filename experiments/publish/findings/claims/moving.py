# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Claims on the algorithms for translating and rotating bodies."""

from __future__ import annotations

import json
import re

import numpy as np
import pandas as pd

from baselines import registry
from experiments.analysis import costs, metrics
from experiments.publish.findings.runs import (
    FAILS,
    HOLDS,
    LATE,
    MISSES,
    PART,
    Missing,
    Runs,
    are_small,
    by_family,
    listed,
    or_reason,
    overall,
    rate,
    ratios_listed,
    rows,
    share_of,
    spread,
    worst_families,
)

from .claim import TIME, TURN, claim


@claim(
    "Virtual edges prevent tunnelling through thin walls",
    TIME,
    f"the rate of tunnelling with k = 8 is under {MISSES:.0%} in each family of walls",
    "tunnelling/tables/tunnelling-straight.md tunnelling/tables/tunnelling-thin.md"
    " tunnelling/tables/tunnelling-turning.md",
    "The walls are larger than the body and are hit by its vertices. The next claim covers edges"
    " and the vertices of B.",
)
def thin_walls(runs: Runs):
    found = runs.answers("tunnelling")
    own, all_faces, sampled = (
        by_family(found, m, "tunnelled")
        for m in ("ofg k=8", "brute-force", "fcl-convex-substeps n=16")
    )
    return (
        are_small(own.values()),
        f"tunnelled with k=8: {spread(own)}",
        (
            f"{found.level.min():g} to {found.level.max():g} thicknesses per step. k = 8:"
            f" {listed(own)}. All faces: {listed(all_faces)}. 16 samples of the path:"
            f" {listed(sampled)}."
        ),
    )


@claim(
    "Virtual edges, the start and the end find all other collisions of translating bodies",
    TIME,
    f"the rate of misses of translations is under {MISSES:.0%} with all faces instead of k (misses"
    " that are not due to the selection)",
    "{board}/tables/scenarios-translation.md {board}/tables/accuracy-translation.md"
    " k/tables/k-feature.md",
    "The families are designed to be difficult, and are pooled with the numbers of cases of the"
    " run. Brute force applies the same three tests to all faces.",
)
def flights(runs: Runs):
    found = rows(runs.answers(runs.board), question="translation")
    every, own, whole = (
        rate(found, method="brute-force"),
        *(or_reason(rate, found, method=m) for m in ("ofg k=8", "ofg k=8 repairs=all")),
    )

    def features():
        aimed = rows(runs.answers("k"), method="brute-force", scenario="contact", label="hit")
        return listed(
            {
                feature: rate(part)
                for feature, part in aimed.groupby(
                    aimed.tags.map(lambda t: json.loads(t)["feature"])
                )
            }
        )

    return (
        are_small([every]),
        f"missed: all faces {every}, k=8 {own}",
        (
            f"With all repairs: {whole}. Families with the highest rates for all faces:"
            f" {worst_families(found, 'brute-force')}. Misses of all faces in `contact`, by the"
            f" features of A and B in contact: {or_reason(features)}."
        ),
    )


@claim(
    "Step 1, with spheres at the start, is sufficient for moving bodies",
    f"{TIME}, step 2 read literally",
    f"the share of hits found with swept spheres but not with spheres at the start is under"
    f" {MISSES:.0%}, both for translations and for motions",
    "{board}/tables/accuracy-translation.md {board}/tables/accuracy-motion.md",
    "The bounding sphere of a large wall contains the body from the start, so that both readings"
    " give the same answer.",
)
def start_spheres(runs: Runs):
    found, lost = rows(runs.answers(runs.board), label="hit", status="ok"), {}
    for question in ("translation", "motion"):
        missed = (
            rows(found, method=["ofg k=8 broad=start", "ofg k=8"], question=question)
            .assign(missed=lambda t: t.outcome == "miss")
            .pivot(index="case", columns="method", values="missed")
            .dropna()
        )
        if missed.shape[1] < 2:
            raise Missing(f"run {runs.board} has only one of the two readings")
        missed = missed.astype(bool)
        lost[question] = share_of(missed["ofg k=8 broad=start"] & ~missed["ofg k=8"])
    return (
        are_small(lost.values()),
        f"hits lost: {listed(lost)}",
        "Swept spheres, the other reading, are the default in this project.",
    )


IMPACT = "impact/tables/impact-angle.md impact/tables/impact-turn.md impact/tables/impact-net.md"
ESTIMATES = (
    "The figures cover hits found in steps that start clear, except those found at an end of the"
    " step. Rows do not record which features met; if the time by relative velocity is exactly 0 or"
    " 1, the hit counts as found at an end, for every estimate of the same method. The table"
    " impact/tables/impact-misses.md contains the misses."
)
READINGS = {"ends first": "", "order of the article's steps": " order=steps"}
WITHIN = f"95 % of the times have an error of at most {LATE:g} of the step"


def estimates(runs: Runs, method: str) -> pd.DataFrame:
    """Hits found that start clear and are not found at an end; `error` is NaN without a time."""
    found = rows(runs.answers("impact"), outcome="right", label="hit", start="clear")
    hits = rows(found, method=method)
    alike = rows(found, method=re.sub(r" toi=\S+", "", method))  # the method with default estimate
    between = hits[~hits.case.isin(alike.case[alike.time.isin([0.0, 1.0])])]
    if between.empty:
        raise Missing(f"no estimate of {method} in run impact")
    return between


def impact(runs: Runs, method: str) -> tuple[str, str]:
    """(verdict, number) of an estimate of the time of impact; a missing time counts as wrong."""
    found = estimates(runs, method)
    off = found.error.abs()
    share = (off <= LATE).mean()
    verdict = HOLDS if share >= 0.95 else PART if share >= 0.5 else FAILS
    lost = f"; {off.isna().sum()} of {len(off)} hits without a time" if off.isna().any() else ""
    error = metrics.times_of_impact(found, ["method"])
    if error.empty:
        return verdict, f"no times{lost}"
    e = error.iloc[0]
    timed = found.assign(off=off).dropna(subset=["off"])
    middle = costs.medians(timed, "off", ["method"]).iloc[0]
    return (
        verdict,
        (
            f"median {e['median']:.1e} [{middle.low:.1e}, {middle.high:.1e}], 95 % within"
            f" {e.p95:.1e}, all from {e.worst_early:.1e} to {e.worst_late:.1e}, {100 * share:.0f} %"
            f" within {LATE:g}; n={e.times}{lost}"
        ),
    )


def impacts(runs: Runs, methods: dict[str, str]) -> tuple[str, str]:
    """(verdict, number) of several estimates; verdicts that differ give "holds in part"."""
    each = {name: impact(runs, method) for name, method in methods.items()}
    number = "; ".join(f"{name}: {said}" for name, (_, said) in each.items())
    verdict = overall(verdict for verdict, _ in each.values())
    return verdict, f"error as a share of the step: {number}"


def others(runs: Runs, methods: dict[str, str]) -> str:
    return listed({n: or_reason(lambda m: impact(runs, m)[1], m) for n, m in methods.items()})


@claim(
    "Relative velocity gives the time of impact",
    f"{TIME}, first estimate; {TURN}",
    f"{WITHIN} (in part: half of them, or in one of the two readings), both with the ends tested"
    " before the virtual edges and with the article's list of steps read literally",
    f"{IMPACT} impact/tables/impact-latest.md",
    ESTIMATES,
)
def velocity(runs: Runs):
    verdict, number = impacts(runs, {n: f"ofg k=8{order}" for n, order in READINGS.items()})
    instead = {
        "earliest of all virtual edges of the selection (repair `earliest`)": (
            "ofg k=8 repairs=earliest"
        ),
        "all repairs": "ofg k=8 repairs=all",
    }
    text = "The time is that of the first virtual edge found, not of the earliest. Alternatives: "
    return verdict, number, f"{text}{others(runs, instead)}."


@claim(
    "Halving the step gives the time of impact",
    f"{TIME}, second estimate; {TURN}",
    f"{WITHIN}, where a hit without a time counts as an error (in part: half of them, or in one of"
    " the two readings), both read literally (`toi=halving`) and as a bisection that keeps a"
    " bracket (`toi=bisection`)",
    f"{IMPACT} impact/tables/impact-latest.md",
    f"{ESTIMATES} Read literally, each iteration moves the body by half of the rest of the step, to"
    " 1/2, 3/4 and so on; the time is that of the first position with contact, and there is no time"
    " if no position has contact.",
)
def halving(runs: Runs):
    ways = {"halving": "ofg k=8 toi=halving", "bisection": "ofg k=8 toi=bisection"}
    verdict, number = impacts(runs, ways)
    price = {
        way: ratios_listed(lambda: runs.times("impact"), method, "ofg k=8", "situation")
        for way, method in ways.items()
    }
    steps = others(runs, {way: f"{method} order=steps" for way, method in ways.items()})
    halvings = registry.methods()["ofg"].parameters["iterations"]
    return (
        verdict,
        number,
        (
            f"In the order of the article's steps: {steps}. Ratio of net time to that of the"
            f" velocity estimate: {listed(price)}. The article's log n iterations are at most"
            f" {halvings} here."
        ),
    )


@claim(
    "Faces that meet at the start or at the end need no time",
    f"{TIME}, last paragraph",
    "among the hits found with k = 8 at an end of the step, the share for which OFG does not name"
    f" two faces that intersect there is under {MISSES:.0%}",
    "impact/tables/impact-latest.md impact/tables/impact-misses.md",
    "OFG is run again on the sweeps of the run that are certified to start or end in contact; a"
    " separating axis test checks whether the two faces intersect. The reported time is that end, 0"
    " or 1. Its error does not affect the verdict, as the article needs no time in this case.",
)
def untimed(runs: Runs):
    found = runs.known("impact")
    at_end = rows(found, found=["start", "end"])
    unknown = share_of(~at_end.meet)
    met = int(found.meet.sum())
    late = at_end.late
    ways = found.found.value_counts()
    return (
        are_small([unknown]),
        (
            f"faces known for {met} of {len(at_end)}, unknown for {unknown}; the time is late by"
            f" {late.median():.1e} (median) and at most {late.max():.1e} of the step"
        ),
        f"The faces are known for {met} of all {len(found)} such sweeps. Sweeps by how the hit was"
        f" found: {listed(ways)}.",
    )


@claim(
    "Linearised vertex paths suffice for rotation",
    TURN,
    f"the rate of misses with k = 8 is under {MISSES:.0%} in each family of rotations",
    "rotation/tables/rotation-side.md rotation/tables/rotation-contact.md"
    " rotation/tables/rotation-turns.md rotation/tables/rotation-chord.md",
    "The families are designed to expose the linearisation error, and most rotations exceed the 45"
    " degrees per step that the article calls very fast.",
)
def chords(runs: Runs):
    found = runs.answers("rotation")
    own = by_family(found, "ofg k=8")
    every, arcs, later = (
        or_reason(rate, found, method=m)
        for m in ("brute-force", "ofg k=8 repairs=arcs", "ofg k=8 repairs=selection-times")
    )
    text = (
        f"By family, k = 8: {listed(own)}. All families together: k = 8"
        f" {rate(found, method='ofg k=8')}; all faces, without a selection, {every}; only the"
        f" repair with selections at several times {later}; only the repair with arcs instead of"
        f" chords {arcs}."
    )
    # levels of both are angles
    gentle = found[
        found.scenario.isin(["spin_side", "rotational_contact"]) & (found.level <= np.pi / 4)
    ]
    if len(gentle):
        text += (
            " Up to 45 degrees per step (`spin_side`, `rotational_contact`): k = 8"
            f" {rate(gentle, method='ofg k=8')}."
        )
    return are_small(own.values()), f"missed with k=8: {spread(own)}", text
