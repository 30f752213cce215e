"""Claims of the remedies for moving and turning bodies."""

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
    "Virtual edges stop what flies through a thin wall",
    TIME,
    f"tunnelled with k = 8 under {MISSES:.0%} in each family of walls",
    "tunnelling/tables/tunnelling-straight.md tunnelling/tables/tunnelling-thin.md"
    " tunnelling/tables/tunnelling-turning.md",
    "Walls larger than the body, hit by its vertices. Edges and B's vertices: next.",
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
            f"{found.level.min():g} to {found.level.max():g} thicknesses in a step. k = 8:"
            f" {listed(own)}. All faces: {listed(all_faces)}. 16 samples of the path:"
            f" {listed(sampled)}."
        ),
    )


@claim(
    "Virtual edges, the start and the end find every other collision in flight",
    TIME,
    f"misses of straight flights under {MISSES:.0%} with all faces in place of k (what the"
    " selection cannot be blamed for)",
    "{board}/tables/scenarios-translation.md {board}/tables/accuracy-translation.md"
    " k/tables/k-feature.md",
    "Families are aimed at difficulties, and pooled as the run weights them. Brute force makes the"
    " same three tests with all faces.",
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
            f"All repairs: {whole}. All faces miss most in {worst_families(found, 'brute-force')};"
            f" in `contact` by the features that meet, of A and B: {or_reason(features)}."
        ),
    )


@claim(
    "Step 1, spheres at the start, suits moving bodies",
    f"{TIME}, step 2 read literally",
    f"hits that swept spheres find and spheres at the start do not are under {MISSES:.0%}, in"
    " flight and in turning flight",
    "{board}/tables/accuracy-translation.md {board}/tables/accuracy-motion.md",
    "Where the wall is large, its sphere holds the body from the start, and the reading makes no"
    " difference.",
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
            raise Missing(f"one of the readings in run {runs.board}")
        missed = missed.astype(bool)
        lost[question] = share_of(missed["ofg k=8 broad=start"] & ~missed["ofg k=8"])
    return (
        are_small(lost.values()),
        f"hits lost by it: {listed(lost)}",
        "Swept spheres, the other reading, are the default here.",
    )


IMPACT = "impact/tables/impact-angle.md impact/tables/impact-turn.md impact/tables/impact-net.md"
ESTIMATES = (
    "Estimates only: hits found whose step begins clear, but for those at an end. Rows do not"
    " record what met: where the time by relative velocity is exactly 0 or 1 the hit is taken for"
    " one at an end, by every estimate of the same method."
    " Misses stand in impact/tables/impact-misses.md."
)
READINGS = {"the ends first": "", "his list of steps": " order=steps"}
WITHIN = f"95 % of the times within {LATE:g} of the step"


def estimates(runs: Runs, method: str) -> pd.DataFrame:
    """Hits found that begin clear and are not found at an end: `error` is NaN without a time."""
    found = rows(runs.answers("impact"), outcome="right", label="hit", start="clear")
    hits = rows(found, method=method)
    alike = rows(found, method=re.sub(r" toi=\S+", "", method))  # the same but for the estimate
    between = hits[~hits.case.isin(alike.case[alike.time.isin([0.0, 1.0])])]
    if between.empty:
        raise Missing(f"no estimate of {method} in run impact")
    return between


def impact(runs: Runs, method: str) -> tuple[str, str]:
    """(verdict, number) of an estimate of the time of impact; no time is not within."""
    found = estimates(runs, method)
    off = found.error.abs()
    share = (off <= LATE).mean()
    verdict = HOLDS if share >= 0.95 else PART if share >= 0.5 else FAILS
    lost = f"; {off.isna().sum()} of {len(off)} hits without a time" if off.isna().any() else ""
    error = metrics.times_of_impact(found, ["method"])
    if error.empty:
        return verdict, f"no time at all{lost}"
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
    """(verdict, number) of several estimates: that of all, or in part."""
    each = {name: impact(runs, method) for name, method in methods.items()}
    number = "; ".join(f"{name}: {said}" for name, (_, said) in each.items())
    return overall(verdict for verdict, _ in each.values()), f"error, in steps: {number}"


def others(runs: Runs, methods: dict[str, str]) -> str:
    return listed({n: or_reason(lambda m: impact(runs, m)[1], m) for n, m in methods.items()})


@claim(
    "Relative velocity gives the time of impact",
    f"{TIME}, first estimate; {TURN}",
    f"{WITHIN} (in part: half of them, or in one reading of the two), with the ends tested before"
    " the virtual edges and with his list of steps read literally",
    f"{IMPACT} impact/tables/impact-latest.md",
    ESTIMATES,
)
def velocity(runs: Runs):
    verdict, number = impacts(runs, {n: f"ofg k=8{order}" for n, order in READINGS.items()})
    instead = {
        "the earliest of all virtual edges of the selection (repair `earliest`)": (
            "ofg k=8 repairs=earliest"
        ),
        "with all repairs": "ofg k=8 repairs=all",
    }
    text = "The time is that of the first virtual edge found, not of the earliest. Instead "
    return verdict, number, f"{text}{others(runs, instead)}."


@claim(
    "Halving the step gives the time of impact",
    f"{TIME}, second estimate; {TURN}",
    f"{WITHIN}, and a hit without a time is not (in part: half of them, or in one reading of the"
    " two): read literally (`toi=halving`), and with the bracket kept (`toi=bisection`)",
    f"{IMPACT} impact/tables/impact-latest.md",
    f"{ESTIMATES} Read literally, half of what is left of the step is moved each time, to 1/2, 3/4"
    " and so on, and the first move that meets is the time; where none does there is no time.",
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
            f"By his list of steps: {steps}. Time over that of the velocity estimate, net:"
            f" {listed(price)}. The article's log n is at most {halvings} halvings here."
        ),
    )


@claim(
    "Faces that meet at the start or at the end need no time",
    f"{TIME}, last paragraph",
    "of the hits that k = 8 finds at an end of the step, two faces are named that do meet there but"
    f" for under {MISSES:.0%}",
    "impact/tables/impact-latest.md impact/tables/impact-misses.md",
    "Asked of OFG anew, of the sweeps of the run that are certified to begin or to end in contact;"
    " whether the two faces meet is tested by separating axes. The time is then that end, 0 or 1."
    " How late that is has no part in the verdict, as the article says that none is needed.",
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
            f"faces known: {met} of {len(at_end)}, unknown {unknown}; the time is late by"
            f" {late.median():.1e} (median) and at most {late.max():.1e} of the step"
        ),
        f"Of all {len(found)} such sweeps the faces are known of {met}: found {listed(ways)}.",
    )


@claim(
    "Chords of the vertices' paths do for rotation",
    TURN,
    f"misses with k = 8 under {MISSES:.0%} in each family of turns",
    "rotation/tables/rotation-side.md rotation/tables/rotation-contact.md"
    " rotation/tables/rotation-turns.md rotation/tables/rotation-chord.md",
    "Families are aimed at the chord's error, and most turns are larger than the 45 degrees in a"
    " step that the article calls very fast.",
)
def chords(runs: Runs):
    found = runs.answers("rotation")
    own = by_family(found, "ofg k=8")
    every, arcs, later = (
        or_reason(rate, found, method=m)
        for m in ("brute-force", "ofg k=8 repairs=arcs", "ofg k=8 repairs=selection-times")
    )
    text = (
        f"By family, k = 8: {listed(own)}. All of them: k = 8 {rate(found, method='ofg k=8')}; all"
        f" faces {every}, which is not the selection's doing; selections at several times alone"
        f" {later}; arcs in place of chords alone {arcs}."
    )
    # levels of both are angles
    gentle = found[
        found.scenario.isin(["spin_side", "rotational_contact"]) & (found.level <= np.pi / 4)
    ]
    if len(gentle):
        text += (
            " Up to the article's 45 degrees in a step (`spin_side`, `rotational_contact`): k = 8"
            f" {rate(gentle, method='ofg k=8')}."
        )
    return are_small(own.values()), f"missed with k=8: {spread(own)}", text
