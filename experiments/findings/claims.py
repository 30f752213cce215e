"""The claims of the article, in its order, then what it is silent about.

A claim is a function of the runs that returns a verdict, the number that carries it, and what else was found. The words around it
(the claim, where the article makes it, the rule of the verdict, where the rows are, the limits) are given to the decorator.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Callable

import numpy as np
import pandas as pd

from baselines import registry

from .. import bench_ofg, metrics, sizes
from .runs import FAILS, HOLDS, LATE, MISSES, OPEN, PART, UNMEASURED, Missing, Rate, Runs
from .runs import are_small, interval, listed, or_reason, overall, rate, ratio, ratios_listed, rows, size_rates, spread, times_more, wrong_rate


@dataclass(frozen=True)
class Claim:
    title: str
    section: str
    rule: str
    where: tuple[str, ...]
    limits: str
    find: Callable[[Runs], tuple[str, str, str]]


@dataclass(frozen=True)
class Finding:
    claim: Claim
    verdict: str
    number: str
    text: str


CLAIMS: list[Claim] = []


def claim(title: str, section: str, rule: str, where: str, limits: str):
    """Register a function Runs -> (verdict, number, text). where: tables, with {board} for the run that has every family."""

    def add(find):
        CLAIMS.append(Claim(title, section, rule, tuple(where.split()), limits, find))
        return find

    return add


def finding(asked: Claim, runs: Runs) -> Finding:
    try:
        return Finding(asked, *asked.find(runs))
    except Missing as reason:
        return Finding(asked, UNMEASURED, f"not measured ({reason})", "")


BASIC, TIME, TURN = "The OFG algorithm", "Solving the discrete time problem", "Solving for rotating objects"
CONCAVE, PROBLEMS = "Solving the concavity problem", "Problems with the basic OFG algorithm"
HULLS = "Random hulls of one size against each other."
FEWEST = 3  # cases that a cell of times has at least
FEW, MANY = sizes.FACES[1], sizes.FACES[3]  # "few faces" and "many", of those measured


def depth_range(name: str) -> str:
    low, high = sizes.DEPTHS[name]
    return f"{low:g} to {high:g} radii deep along a contact normal"


@claim(
    "Selecting faces costs O(n + m)",
    f"{BASIC}, steps 2 and 4",
    "at most n + m distances by the article's count in every query, and at most 2 (n + m) really"
    " computed, to faces and to blocks of faces",
    "sizes/tables/operations.md bench-ofg/tables.md",
    f"{HULLS} The count holds by construction: the counter adds n + m. What is computed does not:"
    " blocks of faces are passed over by one bound each.",
)
def selection(runs: Runs):
    found = rows(sizes.operations(runs.file("sizes/sizes.parquet")), question="overlap")
    counted, computed = found.distances_max.max(), found.evaluated_max.max()
    eight = rows(found, k=8).set_index("faces")
    mean = listed(eight.evaluated_mean, lambda v: f"{100 * v:.1f} %")
    number = f"computed: at most {computed:.2f} (n + m); n={found.queries.sum()} queries"
    text = (
        f"Counted: at most {counted:.2f} (n + m), by construction. Computed with k = 8, on average,"
        f" by faces: {mean}. Selecting alone, natively: {or_reason(lambda: growth(runs))}."
    )
    return (HOLDS if counted <= 1 and computed <= 2 else FAILS), number, text


def growth(runs: Runs) -> str:
    """Native time of the steps that select, with the most faces over that with the fewest."""
    steps = bench_ofg.steps(runs.file("bench-ofg/rows.csv"))
    own = rows(steps, method="OFG double k=8")
    own = own[own.cell.str.fullmatch(r"\d+-hull/gap")]
    if len(own) < 2:
        raise Missing("fewer than two sizes of hulls in run bench-ofg")
    spent = (own["2-3 select A"] + own["4-6 select B"]).to_numpy()
    faces = own.cell.str.split("-").str[0].astype(int).to_numpy()
    few, many = faces.argmin(), faces.argmax()
    return (
        f"{faces[few]} faces {spent[few]:.0f} ns, {faces[many]} faces {spent[many]:.0f} ns, so"
        f" {faces[many] / faces[few]:.0f} times the faces take {spent[many] / spent[few]:.1f} times"
        " as long"
    )


@claim(
    "At most k^2 pairs of faces are tested",
    f"{BASIC}, step 8",
    "at most k^2 pairs, and at most k^2 full tests, in every query",
    "sizes/tables/operations.md",
    f"{HULLS} Overlapping pairs, {depth_range('shallow')}, and {depth_range('deep')}. It holds by"
    " construction, as two selections of k faces have no more pairs: how many are tested is what is"
    " found.",
)
def pairs(runs: Runs):
    found = rows(sizes.operations(runs.file("sizes/sizes.parquet")), question="overlap")
    most, full = found.pairs_max.max(), found.full_tests_max.max()
    eight = rows(found, k=8)
    mean, tested = (
        np.average(eight[f"{name}_mean"], weights=eight.queries) for name in ("pairs", "full_tests")
    )
    return (
        HOLDS if max(most, full) <= 1 else FAILS,
        f"full tests with k=8: mean {tested:.2g} k^2, at most {eight.full_tests_max.max():.2g} k^2;"
        f" n={eight.queries.sum()} queries",
        f"Pairs settled with k = 8: {mean:.2g} k^2 on average over all sizes, since the first pair"
        f" that meets ends it; with any k at most {most:.2f} k^2. A full test is of a pair that no"
        " cheap rejection settles.",
    )


@claim(
    "k^2 + 3k operations replace n m",
    f"{BASIC}, step 8",
    "at most k^2 + 3k pairs of faces in every overlap query",
    "sizes/tables/operations.md",
    f"{HULLS} The article says it of overlap only; by construction no query has more than k^2 pairs."
    " Of sweeps it says nothing: they stand beside it without a verdict. There a pair of faces and a"
    " virtual edge against a face each count as one: up to 3k virtual edges against k faces, and two"
    " times k^2 pairs.",
)
def after_selection(runs: Runs):
    found = sizes.operations(runs.file("sizes/sizes.parquet"))
    still = rows(found, question="overlap")
    most = still.after_selection_max.max()
    large = rows(still, k=8, faces=MANY).iloc[0]
    share = large.after_selection_mean * (large.k**2 + 3 * large.k) / MANY**2
    flown = {
        q: or_reason(lambda: f"{rows(found, question=q).after_selection_max.max():.3g}")
        for q in ("translation", "motion")
    }
    return (
        HOLDS if most <= 1 else FAILS,
        f"overlap: at most {most:.3g} (k^2 + 3k); n={still.queries.sum()} queries",
        f"At {MANY} faces and k = 8 an overlap query takes {share:.1e} of n m, on average. Sweeps, at"
        f" most, in k^2 + 3k: {listed(flown)}.",
    )


@claim(
    "A higher k is more accurate",
    BASIC,
    "misses never rise from one k to the next, in any family (in part: not in all families together)",
    "k/tables/k-misses.md",
    "With k at or above the number of faces (inf) all are selected, which leaves what the tests themselves miss.",
)
def higher_k(runs: Runs):
    found = runs.answers("k")
    ks = sorted(
        {float(m.split("=")[1]) for m in found.method.unique() if m.startswith("ofg k=") and m.count(" ") == 1}
    )  # "inf": all faces
    if len(ks) < 2:
        raise Missing("fewer than two k in run k")
    methods = [f"ofg k={k:g}" for k in ks]
    pooled = {k: rate(found, method=m) for k, m in zip(ks, methods)}
    missed = (
        rows(found, method=methods)
        .assign(missed=lambda t: t.outcome == "miss")
        .pivot(index="case", columns="method", values="missed")[methods]
    )
    lost = int((missed.astype(int).diff(axis=1) > 0).any(axis=1).sum())
    families = (
        rows(found, method=methods, label="hit")
        .assign(missed=lambda t: t.outcome == "miss")
        .pivot_table(index="scenario", columns="method", values="missed", aggfunc="sum")[methods]
    )
    rising = list(families.index[(families.diff(axis=1) > 0).any(axis=1)])
    counts = [r.count for r in pooled.values()]
    falls = all(a >= b for a, b in zip(counts, counts[1:])) and counts[0] > counts[-1]
    text = f"Misses by k: {listed(pooled)}. {lost} of {len(missed)} cases are found by some k and missed by the next larger one"
    text += f"; misses rise somewhere in {', '.join(rising)}." if rising else "; misses rise in no family."
    text += (
        f" Net time of k = 64 over that of k = 8: {ratios_listed(lambda: runs.times('k'), 'ofg k=64', 'ofg k=8', 'question')}."
    )
    return (
        (FAILS if not falls else PART if rising else HOLDS),
        f"missed: k={ks[0]:g} {pooled[ks[0]]}, k={ks[-1]:g} {pooled[ks[-1]]}",
        text,
    )


@claim(
    "k of 4 to 8 is enough",
    f"{BASIC}, typical values",
    f"misses of shallow overlaps with k = 8 under {MISSES:.0%} at every size",
    "sizes/tables/misses.md k/tables/k-misses.md",
    f"{HULLS} {depth_range('shallow')}.",
)
def typical_k(runs: Runs):
    eight, four = (size_rates(runs, "shallow", k) for k in (8, 4))
    return (
        are_small(eight.values()),
        f"missed with k=8: {spread(eight)}",
        f"By faces, k = 8: {listed(eight)}. k = 4: {listed(four)}.",
    )


@claim(
    "Small faces need a higher k",
    BASIC,
    "k = 8 misses more of the largest bodies than of the smallest, intervals apart",
    "sizes/tables/misses.md",
    f"{HULLS} Shallow overlaps. k of {', '.join(map(str, sizes.KS))}.",
)
def small_faces(runs: Runs):
    eight = size_rates(runs, "shallow", 8)
    small, large = eight[min(eight)], eight[max(eight)]
    found = rows(sizes.misses(runs.file("sizes/sizes.parquet")), depth="shallow", repairs=False)
    enough = {}
    for faces, part in found.groupby("faces"):
        ok = part[(part.miss_high <= MISSES) & part.k.isin(sizes.KS)].k
        enough[faces] = f"k={ok.min()}" if len(ok) else f"none up to {part.k[part.k.isin(sizes.KS)].max()}"
    verdict = HOLDS if large.low > small.high else FAILS if large.high < small.low else OPEN
    return (
        verdict,
        f"missed with k=8: {min(eight)} faces {small}, {max(eight)} faces {large}",
        f"The smallest k with misses under {MISSES:.0%}, by faces: {listed(enough)}.",
    )


@claim(
    "Best for convex bodies of few faces",
    BASIC,
    f"k = 8 misses less up to {FEW} faces than from {MANY} on, shallow and deep together, intervals apart",
    "sizes/tables/misses.md concavity/tables/concavity-wrong.md",
    f"{HULLS} Concave bodies are measured below.",
)
def low_poly(runs: Runs):
    found = rows(runs.file("sizes/sizes.parquet"), question="overlap", k=8)
    few, many = (pooled(part) for part in (found[found.faces <= FEW], found[found.faces >= MANY]))
    return (
        (HOLDS if few.high < many.low else FAILS if few.low > many.high else OPEN),
        f"missed with k=8: up to {FEW} faces {few}, from {MANY} {many}",
        "",
    )


def pooled(part: pd.DataFrame) -> Rate:
    if part.empty:
        raise Missing("no rows of these sizes in run sizes")
    missed = int((~part.hit).sum())
    return Rate(missed, len(part), *metrics.wilson(missed, len(part)))


@claim(
    "Once bodies are in each other, the closest faces are the wrong ones",
    f"{PROBLEMS}, second",
    "k = 8 misses more deep than shallow overlaps at every size, intervals apart (in part: at some)",
    "sizes/tables/misses.md gap/tables/gap-deep.md",
    f"{HULLS} Deep: {depth_range('deep')}. The article names this problem for moving bodies; it is there at rest too.",
)
def deep(runs: Runs):
    inside, shallow = (size_rates(runs, depth, 8) for depth in ("deep", "shallow"))
    worse = {faces: r.low > shallow[faces].high for faces, r in inside.items()}
    text = f"By faces, k = 8: {listed(inside)}. k = 64: {listed(size_rates(runs, 'deep', 64))}."
    same_centre = {
        f"k = {k}": or_reason(lambda: rate(runs.answers("gap"), method=f"ofg k={k}", scenario="deep")) for k in (8, 64)
    }
    text += f" Bodies with nearly the same centre (`deep`): {listed(same_centre)}."
    return (
        (HOLDS if all(worse.values()) else PART if any(worse.values()) else FAILS),
        f"deep, missed with k=8: {spread(inside)}",
        text,
    )


@claim(
    "Cheaper than all pairs of faces",
    f"{BASIC}, k^2 + 3k against n m",
    "all pairs take longer than k = 8 in every cell of size and situation, interval above 1 (in part:"
    " in some)",
    "faces/tables/faces-ratio.md k/tables/k-net.md",
    f"Net times from Python, paired case by case; both are our own code. No verdict on cells in which"
    " the net time of k = 8 is, in half of the cases or more, no more than the interquartile range of"
    f" its floor's rounds, or of fewer than {FEWEST} other cases. All pairs are tested without a tree:"
    " an engine's mesh test (fcl-mesh) is the fairer rival, below.",
)
def all_pairs(runs: Runs):
    every = ratio(runs.times("faces"), "brute-force", "ofg k=8", ["level", "situation"])
    found = every[every.ratio.notna() & (every.pairs >= FEWEST)]
    left = len(every) - len(found)
    if found.empty:
        raise Missing("no cell of run faces is out of the floor's noise")
    slower, ordered = (found.low > 1).tolist(), found.sort_values("ratio")
    low, high = (f"{interval(r)} ({in_cell(r.Index)})" for r in ordered.iloc[[0, -1]].itertuples())
    named = {in_cell(key): times_more(r) for key, r in found.iterrows()}
    faces = ratios_listed(lambda: runs.times("faces"), "brute-force", "ofg k=64", "level")
    others = ratios_listed(lambda: runs.times("k"), "brute-force", "ofg k=8", "question")
    return (
        HOLDS if all(slower) else PART if any(slower) else FAILS,
        f"slower in {sum(slower)} of {len(slower)} cells, {low} to {high} times as long; {left} cells"
        " left out",
        f"All pairs over k = 8: {listed(named)}. Over k = 64, by faces: {faces}. Over k = 8, other"
        f" cases and sweeps: {others}.",
    )


def in_cell(key: tuple[float, str]) -> str:
    return f"{key[0]:g} faces {key[1]}"


@claim(
    "Faster than the engines (the project's question, not the article's)",
    "-",
    "k = 8 takes less than the fastest engine in every cell of size and situation (in part: in some)",
    "native/native.md faces/tables/faces-ratio.md",
    "Native lane: the libraries in C++, medians over pairs of random hulls, no interval. Speed alone: what k = 8 misses of such"
    " bodies stands above.",
)
def engines_speed(runs: Runs):
    found = runs.file("native/native.csv")
    cells, shares = {}, []
    for (situation, faces), part in found.groupby(["situation", "faces"], sort=False):
        own = rows(part, method="ofg k=8").native.iloc[0]
        rival = part[~part.method.str.startswith("ofg")].sort_values("native").iloc[0]
        cells[f"{situation} {faces}"] = f"{own / rival.native:.2f} ({rival.method})"
        shares.append(own / rival.native)
    repaired = ratios_listed(lambda: runs.times("faces"), "ofg k=8 repairs=all", "ofg k=8", "level")
    wins, third = [s < 1 for s in shares], sum(s <= 1 / 3 for s in shares)
    number = f"faster in {sum(wins)} of {len(wins)} cells; {min(shares):.2f} to {max(shares):.2f} of the fastest engine's time"
    return (
        (HOLDS if all(wins) else PART if any(wins) else FAILS),
        number,
        (
            f"k = 8 over the fastest engine, by situation and faces: {listed(cells)}. At most a third of its time in {third} of"
            f" {len(wins)} cells. All repairs over k = 8, net, from Python, by faces: {repaired}."
        ),
    )


#: faces -> what share of the fastest engine's time k = 8 may take at small gaps: what the project set itself
GOAL = {12: 1 / 3, 320: 1 / 5, 1280: 1 / 5}
#: how the methods of the engines begin that a run has to ask before the aim can be said to hold
RIVALS = ("FCL", "Bullet", "MuJoCo", "parry", "Coal")


@claim(
    "At small gaps, screened by a plane and in batches, a third of the fastest engine's time at 12 faces, a fifth at 320 and 1,280"
    " (the project's aim, not the article's)",
    "-",
    "k = 8 in double, screened in batch, within these shares for every shape (in part: for some, or"
    f" of a run without one of {', '.join(RIVALS)})",
    "bench-ofg/tables.md",
    "A screen is no step of the article: it settles what a plane between the whole bodies keeps apart, with the answers of the eight"
    " steps. Engines are asked pair by pair. Medians over rounds of paired quotients.",
)
def batch_speed(runs: Runs):
    found = runs.file("bench-ofg/rows.csv")
    asked = bench_ofg.engines_of(found.method.unique())
    absent = [e for e in RIVALS if not any(m.lower().startswith(e.lower()) for m in asked)]
    batch, steps = (
        bench_ofg.ratios(found, m).set_index("cell")["ratio to it"]
        for m in ("OFG double k=8 screened in batch", "OFG double k=8")
    )
    gaps = {
        cell: GOAL[int(cell.split("-")[0])]
        for cell in batch.index
        if cell.endswith("/gap") and int(cell.split("-")[0]) in GOAL
    }
    if not gaps:
        raise Missing("no rows at small gaps")
    reached = [batch[cell] <= goal for cell, goal in gaps.items()]
    number, alone = (
        ", ".join(f"{cell.removesuffix('/gap')} {own[cell]:.2f}" for cell in gaps)
        for own in (batch, steps)
    )
    fastest = bench_ofg.ratios(found, "OFG double k=8").set_index("cell").fastest
    held = {cell: f"{batch[cell]:.2f} ({fastest[cell]})" for cell in batch.index}
    verdict = HOLDS if all(reached) else PART if any(reached) else FAILS
    lacking = f", {' and '.join(absent)} not asked" if absent else ""
    return (
        PART if absent and verdict == HOLDS else verdict,
        f"of the time of the fastest engine asked{lacking}: {number}",
        f"Engines asked: {', '.join(asked)}. The eight steps alone, one pair at a time: {alone}."
        f" Screened in batch, all sizes and depths: {listed(held)}.",
    )


@claim(
    "Virtual edges stop what flies through a thin wall",
    TIME,
    f"tunnelled with k = 8 under {MISSES:.0%} in each family of walls",
    "tunnelling/tables/tunnelling-straight.md tunnelling/tables/tunnelling-thin.md tunnelling/tables/tunnelling-turning.md",
    "Walls larger than the body, hit by its vertices. Edges and B's vertices: next.",
)
def thin_walls(runs: Runs):
    found = runs.answers("tunnelling")
    own, all_faces, sampled = (by_family(found, m, "tunnelled") for m in ("ofg k=8", "brute-force", "fcl-convex-substeps n=16"))
    return (
        are_small(own.values()),
        f"tunnelled with k=8: {spread(own)}",
        (
            f"{found.level.min():g} to {found.level.max():g} thicknesses in a step. k = 8: {listed(own)}. All faces:"
            f" {listed(all_faces)}. 16 samples of the path: {listed(sampled)}."
        ),
    )


@claim(
    "Virtual edges, the start and the end find every other collision in flight",
    TIME,
    f"misses of straight flights under {MISSES:.0%} with all faces in place of k (what the selection cannot be blamed for)",
    "{board}/tables/scenarios-translation.md {board}/tables/accuracy-translation.md k/tables/k-feature.md",
    "Families are aimed at difficulties, and pooled as the run weights them. Brute force makes the same three tests with all"
    " faces.",
)
def flights(runs: Runs):
    found = rows(runs.answers(runs.board), question="translation")
    every, own, whole = rate(found, method="brute-force"), *(
        or_reason(lambda: rate(found, method=m)) for m in ("ofg k=8", "ofg k=8 repairs=all")
    )

    def features():
        aimed = rows(runs.answers("k"), method="brute-force", scenario="contact", label="hit")
        return listed(
            {feature: rate(part) for feature, part in aimed.groupby(aimed.tags.map(lambda t: json.loads(t)["feature"]))}
        )

    return (
        are_small([every]),
        f"missed: all faces {every}, k=8 {own}",
        (
            f"All repairs: {whole}. All faces miss most in {worst_families(found, 'brute-force')}; in `contact` by the features"
            f" that meet, of A and B: {or_reason(features)}."
        ),
    )


def worst_families(found: pd.DataFrame, method: str, kind: str = "misses", n: int = 2) -> str:
    """The families with a method's highest rates, of those where it has any count."""
    each = by_family(found, method, kind)
    worst = sorted((name for name in each if each[name].count), key=lambda name: each[name].count / each[name].total)[-n:]
    return listed({name: each[name] for name in reversed(worst)}) or "no family"


def by_family(found: pd.DataFrame, method: str, kind: str = "misses") -> dict[str, Rate]:
    """A method's rate in each family that has such cases."""
    such = rows(found, method=method, label="clear" if kind == "false alarms" else "hit", status="ok")
    return {f"`{name}`": rate(part, kind) for name, part in such.groupby("scenario", sort=False)}


@claim(
    "Step 1, spheres at the start, suits moving bodies",
    f"{TIME}, step 2 read literally",
    f"hits that swept spheres find and spheres at the start do not are under {MISSES:.0%}, in flight and in turning flight",
    "{board}/tables/accuracy-translation.md {board}/tables/accuracy-motion.md",
    "Where the wall is large, its sphere holds the body from the start, and the reading makes no difference.",
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
        count = int((missed["ofg k=8 broad=start"].astype(bool) & ~missed["ofg k=8"].astype(bool)).sum())
        lost[question] = Rate(count, len(missed), *metrics.wilson(count, len(missed)))
    return are_small(lost.values()), f"hits lost by it: {listed(lost)}", "Swept spheres, the other reading, are the default here."


IMPACT = "impact/tables/impact-angle.md impact/tables/impact-turn.md impact/tables/impact-net.md"
ESTIMATES = (
    "Estimates only: hits found whose step begins clear, but for those at an end. Rows do not record"
    " what met; a time of exactly 0 or 1 of a method of ofg is taken for one at an end."
    " Misses stand in impact/tables/impact-misses.md."
)
READINGS = {"the ends first": "", "his list of steps": " order=steps"}
WITHIN = f"95 % of the times within {LATE:g} of the step"


def estimates(runs: Runs, method: str) -> pd.DataFrame:
    """Hits found that begin clear and are not found at an end: `error` is NaN without a time."""
    hits = rows(runs.answers("impact"), method=method, outcome="right", label="hit", start="clear")
    between = hits[~hits.time.isin([0.0, 1.0])]
    if between.empty:
        raise Missing(f"no estimate of {method} in run impact")
    return between


def impact(runs: Runs, method: str) -> tuple[str, str]:
    """(verdict, number) of an estimate of the time of impact; a hit without a time is not within."""
    found = estimates(runs, method)
    off = found.error.abs()
    share = (off <= LATE).mean()
    verdict = HOLDS if share >= 0.95 else PART if share >= 0.5 else FAILS
    lost = f"; {off.isna().sum()} of {len(off)} hits without a time" if off.isna().any() else ""
    error = metrics.times_of_impact(found, ["method"])
    if error.empty:
        return verdict, f"no time at all{lost}"
    e = error.iloc[0]
    middle = metrics.medians(found.assign(off=off).dropna(subset=["off"]), "off", ["method"]).iloc[0]
    return verdict, (
        f"median {e['median']:.1e} [{middle.low:.1e}, {middle.high:.1e}], 95 % within {e.p95:.1e}, all"
        f" from {e.worst_early:.1e} to {e.worst_late:.1e}, {100 * share:.0f} % within {LATE:g};"
        f" n={e.times}{lost}"
    )


def impacts(runs: Runs, methods: dict[str, str]) -> tuple[str, str]:
    """(verdict, number) of several estimates: that of all, or in part."""
    each = {name: impact(runs, method) for name, method in methods.items()}
    number = "; ".join(f"{name}: {said}" for name, (_, said) in each.items())
    return overall(verdict for verdict, _ in each.values()), f"error, in steps: {number}"


def others(runs: Runs, methods: dict[str, str]) -> str:
    return listed({n: or_reason(lambda: impact(runs, m)[1]) for n, m in methods.items()})


@claim(
    "Relative velocity gives the time of impact",
    f"{TIME}, first estimate; {TURN}",
    f"{WITHIN} (in part: half of them, or in one reading of the two), with the ends tested before the"
    " virtual edges and with his list of steps read literally",
    f"{IMPACT} impact/tables/impact-latest.md",
    ESTIMATES,
)
def velocity(runs: Runs):
    verdict, number = impacts(runs, {n: f"ofg k=8{order}" for n, order in READINGS.items()})
    instead = {
        "the earliest of all virtual edges of the selection (repair `earliest`)": "ofg k=8 repairs=earliest",
        "with all repairs": "ofg k=8 repairs=all",
    }
    text = "The time is that of the first virtual edge found, not of the earliest. Instead "
    return verdict, number, f"{text}{others(runs, instead)}."


@claim(
    "Halving the step gives the time of impact",
    f"{TIME}, second estimate; {TURN}",
    f"{WITHIN}, and a hit without a time is not (in part: half of them, or in one reading of the two):"
    " read literally (`toi=halving`), and with the bracket kept (`toi=bisection`)",
    f"{IMPACT} impact/tables/impact-latest.md",
    f"{ESTIMATES} Read literally, half of what is left of the step is moved each time, to 1/2, 3/4 and"
    " so on, and the first move that meets is the time; where none does there is no time.",
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
    return verdict, number, (
        f"By his list of steps: {steps}. Time over that of the velocity estimate, net: {listed(price)}."
        f" The article's log n is at most {halvings} halvings here."
    )


@claim(
    "Faces that meet at the start or at the end need no time",
    f"{TIME}, last paragraph",
    "of the hits that k = 8 finds at an end of the step, two faces are named that do meet there but"
    f" for under {MISSES:.0%}",
    "impact/tables/impact-latest.md impact/tables/impact-misses.md",
    "Asked of OFG anew, of the sweeps of the run that are certified to begin or to end in contact;"
    " whether the two faces meet is tested by separating axes. The time is then that end, 0 or 1: how"
    " late that is no verdict is on, as the article says that none is needed.",
)
def untimed(runs: Runs):
    found = runs.known("impact")
    at_end = rows(found, found=["start", "end"])
    unknown = of_all(~at_end.meet)
    met = int(found.meet.sum())
    late = at_end.late
    ways = found.found.value_counts()
    return (
        are_small([unknown]),
        f"faces known: {met} of {len(at_end)}, unknown {unknown}; the time is late by"
        f" {late.median():.1e} (median) and at most {late.max():.1e} of the step",
        f"Of all {len(found)} such sweeps the faces are known of {met}: found {listed(ways)}.",
    )


def of_all(flags: pd.Series) -> Rate:
    """How many of all are so."""
    count = int(flags.sum())
    return Rate(count, len(flags), *metrics.wilson(count, len(flags)))


@claim(
    "Chords of the vertices' paths do for rotation",
    TURN,
    f"misses with k = 8 under {MISSES:.0%} in each family of turns",
    "rotation/tables/rotation-side.md rotation/tables/rotation-contact.md rotation/tables/rotation-turns.md"
    " rotation/tables/rotation-chord.md",
    "Families are aimed at the chord's error, and most turns are larger than the 45 degrees in a step that the article calls very"
    " fast.",
)
def chords(runs: Runs):
    found = runs.answers("rotation")
    own = by_family(found, "ofg k=8")
    every, arcs, later = (
        or_reason(lambda: rate(found, method=m))
        for m in ("brute-force", "ofg k=8 repairs=arcs", "ofg k=8 repairs=selection-times")
    )
    text = (
        f"By family, k = 8: {listed(own)}. All of them: k = 8 {rate(found, method='ofg k=8')}; all faces {every}, which is not"
        f" the selection's doing; selections at several times alone {later}; arcs in place of chords alone {arcs}."
    )
    gentle = found[
        found.scenario.isin(["spin_side", "rotational_contact"]) & (found.level <= np.pi / 4)
    ]  # levels of both are angles
    if len(gentle):
        text += (
            " Up to the article's 45 degrees in a step (`spin_side`, `rotational_contact`): k = 8"
            f" {rate(gentle, method='ofg k=8')}."
        )
    return are_small(own.values()), f"missed with k=8: {spread(own)}", text


@claim(
    "The pieces with the closest centres are the ones to test",
    CONCAVE,
    f"misses with k = 8 under {MISSES:.0%} in each concave family",
    "concavity/tables/concavity-misses.md concavity/tables/concavity-wrong.md",
    "Pieces by CoACD at its default threshold; where they are not quite the mesh, all pairs of pieces err too.",
)
def one_pair_of_pieces(runs: Runs):
    found = runs.answers("concavity")
    own = by_family(found, "ofg k=8")
    others = {
        name: or_reason(lambda: rate(found, method=m))
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
    "Surfaces of up to thousands of faces: the selection misses some of it whatever the shape, hence k = 64 and all faces"
    " beside it.",
)
def undivided(runs: Runs):
    found = runs.answers("concavity")
    missed, more = rate(found, method="ofg k=8 concave=undivided"), "ofg k=64 concave=undivided"
    hits = rows(found, label="hit", question="overlap")
    failed = {m: set(part.case[part.outcome == "miss"]) for m, part in hits.groupby("method")}
    shown = sorted(failed[more] & failed["ofg k=8 concave=undivided"] - failed.get("brute-force", set()))
    text = (
        f"k = 64: {rate(found, method=more)}; all faces: {or_reason(lambda: rate(found, method='brute-force'))}. Missed at"
        " rest by"
    )
    text += (
        f" both k, found by all faces: `ofg-bench explain {shown[0]} --run results/concavity`." if shown else " both k: no case."
    )
    return (HOLDS if 0 < missed.count < missed.total else FAILS), f"missed with k=8: {missed}", text


@claim(
    "Faces alone tell (the article is silent on a body inside another)",
    BASIC,
    f"misses of contained bodies with all faces under {MISSES:.0%}",
    "gap/tables/gap-contained.md",
    "That a body inside another collides is this project's choice; methods of surfaces are meant to say otherwise.",
)
def contained(runs: Runs):
    found = rows(runs.answers("gap"), scenario="contained")
    inside = found[found.tags.str.contains('"place": "inside"')]
    every = rate(inside, method="brute-force")
    others = {m: or_reason(lambda: rate(inside, method=m)) for m in ("ofg k=8", "ofg k=8 repairs=all", "fcl-convex", "fcl-mesh")}
    return are_small([every]), f"missed with all faces: {every}", f"Others: {listed(others)}."


@claim(
    "What it calls a hit is one",
    f"{BASIC}, step 8",
    f"false alarms of k = 8 under {MISSES:.0%} in each family",
    "{board}/tables/accuracy-overlap.md {board}/tables/accuracy-translation.md {board}/tables/accuracy-motion.md gap/tables/gap-wrong.md",
    "Touching counts as meeting, to double rounding, and pieces are not quite their mesh: both show"
    " here as false alarms. Few clear cases of a family leave its interval wide.",
)
def false_alarms(runs: Runs):
    found = runs.answers(runs.board)
    own = by_family(found, "ofg k=8", "false alarms")
    if not own:
        raise Missing(f"no certified clears in run {runs.board}")
    some = {name: r for name, r in own.items() if r.count}
    asked = {
        q: or_reason(lambda: rate(found, "false alarms", method="ofg k=8", question=q))
        for q in found.question.unique()
    }

    def closest():
        apart = rows(runs.answers("gap"), method="ofg k=8", scenario="feature_gap", label="clear")
        wrong = apart[apart.outcome == "false alarm"]
        share = f"({len(wrong)} of {len(apart)})"
        return f"up to a gap of {wrong.level.max():.0e} of the size {share}" if len(wrong) else "none"

    return (
        are_small(own.values()),
        f"false alarms of k=8: {spread(own)}",
        f"By family, {len(own) - len(some)} of {len(own)} without any: {listed(some) or 'none'}. By"
        f" question: {listed(asked)}. By feature gap: {or_reason(closest)}.",
    )


@claim(
    "Units, place and shape do not matter (not in the article)",
    "-",
    f"wrong answers of k = 8 under {MISSES:.0%} in each family",
    "robustness/tables/robustness-scale.md robustness/tables/robustness-offset.md robustness/tables/robustness-aspect.md"
    " robustness/tables/robustness-ratio.md robustness/tables/robustness-tilt.md",
    "Slivers and size ratios go through the selection as well: compare all faces.",
)
def robust(runs: Runs):
    found = runs.answers("robustness")
    wrong = {
        m: {f"`{name}`": wrong_rate(rows(part, method=m)) for name, part in found.groupby("scenario")}
        for m in ("ofg k=8", "brute-force")
    }
    return (
        are_small(wrong["ofg k=8"].values()),
        f"wrong with k=8: {spread(wrong['ofg k=8'])}",
        f"By family, k = 8: {listed(wrong['ofg k=8'])}. All faces: {listed(wrong['brute-force'])}.",
    )


@claim(
    "With all repairs nothing is missed (ours, not the article's)",
    "-",
    f"no miss, and its interval under {MISSES:.0%}, of each question (in part: of some)",
    "repairs/tables/repairs-overlap.md repairs/tables/repairs-translation.md repairs/tables/repairs-motion.md"
    " repairs/tables/repairs-ratio.md",
    "Of the bodies and families that are named, no others. The repairs were made while looking at"
    " these families, and all runs share a seed: a case of one name is the same everywhere.",
)
def repaired(runs: Runs):
    found = runs.answers("repairs")
    base, all_ = "ofg k=8", "ofg k=8 repairs=all"
    by_question = {q: rate(found, method=all_, question=q) for q in found.question.unique()}
    lost = {m: set(part.case[part.outcome == "miss"]) for m, part in found.groupby("method")}
    alone = {
        m.split("repairs=")[1]: len(lost[base] - lost[m]) for m in lost if "repairs=" in m and m != all_ and "all-but-" not in m
    }
    without = {m.split("all-but-")[1]: len(lost[m] - lost[all_]) for m in lost if "all-but-" in m}
    text = f"Asked of {asked_of(runs, found, all_)}. "
    text += (
        f"The article {rate(found, method=base)} missed. Of these each repair alone finds: {listed(alone)}. Left out of all, it"
        f" brings back: {listed(without)}."
    )
    alarms = [or_reason(lambda: rate(found, "false alarms", method=m)) for m in (base, all_)]
    text += (
        f" Price of all, net time over k = 8: {ratios_listed(lambda: runs.times('repairs'), all_, base, 'question')}. False"
        f" alarms: article {alarms[0]}, with repairs {alarms[1]}."
    )

    def everywhere():
        each = [rows(answers, method=all_) for answers in map(runs.answers, runs.finished) if (answers.method == all_).any()]
        once = pd.concat(each or [found.iloc[:0]]).drop_duplicates("case")
        return f"missed {rate(once)}, false alarms {rate(once, 'false alarms')}"

    text += f" In all runs together, each case once: {or_reason(everywhere)}."
    none = [r.count == 0 for r in by_question.values()]
    verdict = (
        OPEN
        if all(none) and not all(r.small for r in by_question.values())
        else HOLDS if all(none) else PART if any(none) else FAILS
    )
    return verdict, f"missed: {listed(by_question)}", text


def asked_of(runs: Runs, found: pd.DataFrame, method: str) -> str:
    """The bodies of the certified hits of a run that a method was asked about, by kind and family."""
    hits = rows(found, method=method, label="hit", status="ok")
    kind = hits.case.map(runs.bodies("repairs"))
    each = {
        f"{question} of {kind}": f"{len(part)} hits ({', '.join(part.scenario.unique())})"
        for (kind, question), part in hits.groupby([kind, "question"], sort=False)
    }
    return listed(each)
