"""Claims of the basic algorithm: its cost, k, and which bodies it suits."""

from __future__ import annotations

import numpy as np

from experiments.publish.findings.runs import (
    FAILS,
    HOLDS,
    MISSES,
    OPEN,
    PART,
    Missing,
    Runs,
    are_small,
    by_family,
    interval,
    listed,
    or_reason,
    rate,
    ratio,
    ratios_listed,
    rows,
    share_of,
    size_rates,
    spread,
    times_more,
)
from experiments.studies import sizes
from experiments.studies.native.classes import V3
from experiments.studies.native.summary import steps

from .claim import BASIC, PROBLEMS, claim

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
    "sizes/tables/operations.md native/native.md",
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
    own = rows(
        steps(runs.file("native/rows.parquet"), V3),
        bodies="hull",
        situation="gap",
        k="8",
        precision="double",
    )
    if len(own) < 2:
        raise Missing("fewer than two sizes of hulls in run native")
    spent = (own["2-3 select A"] + own["4-6 select B"]).to_numpy()
    faces = own.faces.astype(int).to_numpy()
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
        (
            f"full tests with k=8: mean {tested:.2g} k^2, at most {eight.full_tests_max.max():.2g}"
            f" k^2; n={eight.queries.sum()} queries"
        ),
        (
            f"Pairs settled with k = 8: {mean:.2g} k^2 on average over all sizes, since the first"
            f" pair that meets ends it; with any k at most {most:.2f} k^2. A full test is of a pair"
            " that no cheap rejection settles."
        ),
    )


@claim(
    "k^2 + 3k operations replace n m",
    f"{BASIC}, step 8",
    "at most k^2 + 3k pairs of faces in every overlap query",
    "sizes/tables/operations.md",
    f"{HULLS} The article says it of overlap only; by construction no query has more than k^2"
    " pairs. Of sweeps it says nothing: they stand beside it without a verdict. There a pair of"
    " faces and a virtual edge against a face each count as one: up to 3k virtual edges against k"
    " faces, and two times k^2 pairs.",
)
def after_selection(runs: Runs):
    found = sizes.operations(runs.file("sizes/sizes.parquet"))
    still = rows(found, question="overlap")
    most = still.after_selection_max.max()
    large = rows(still, k=8, faces=MANY).iloc[0]
    share = large.after_selection_mean * (large.k**2 + 3 * large.k) / MANY**2
    flown = {
        q: or_reason(lambda q: f"{rows(found, question=q).after_selection_max.max():.3g}", q)
        for q in ("translation", "motion")
    }
    return (
        HOLDS if most <= 1 else FAILS,
        f"overlap: at most {most:.3g} (k^2 + 3k); n={still.queries.sum()} queries",
        (
            f"At {MANY} faces and k = 8 an overlap query takes {share:.1e} of n m, on average."
            f" Sweeps, at most, in k^2 + 3k: {listed(flown)}."
        ),
    )


@claim(
    "A higher k is more accurate",
    BASIC,
    "misses never rise from one k to the next, in any family (in part: not in all families"
    " together)",
    "k/tables/k-misses.md",
    "With k at or above the number of faces (inf) all are selected, which leaves what the tests"
    " themselves miss.",
)
def higher_k(runs: Runs):
    found = runs.answers("k")
    # "inf": all faces
    ks = sorted(
        {
            float(m.split("=")[1])
            for m in found.method.unique()
            if m.startswith("ofg k=") and m.count(" ") == 1
        }
    )
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
    text = (
        f"Misses by k: {listed(pooled)}. {lost} of {len(missed)} cases are found by some k and"
        " missed by the next larger one"
    )
    text += (
        f"; misses rise somewhere in {', '.join(rising)}."
        if rising
        else "; misses rise in no family."
    )
    text += (
        " Net time of k = 64 over that of k = 8:"
        f" {ratios_listed(lambda: runs.times('k'), 'ofg k=64', 'ofg k=8', 'question')}."
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
        enough[faces] = (
            f"k={ok.min()}" if len(ok) else f"none up to {part.k[part.k.isin(sizes.KS)].max()}"
        )
    verdict = HOLDS if large.low > small.high else FAILS if large.high < small.low else OPEN
    return (
        verdict,
        f"missed with k=8: {min(eight)} faces {small}, {max(eight)} faces {large}",
        f"The smallest k with misses under {MISSES:.0%}, by faces: {listed(enough)}.",
    )


@claim(
    "Best for convex bodies of few faces",
    BASIC,
    f"k = 8 misses less up to {FEW} faces than from {MANY} on, shallow and deep together, intervals"
    " apart",
    "sizes/tables/misses.md concavity/tables/concavity-wrong.md",
    f"{HULLS} Concave bodies are measured below.",
)
def low_poly(runs: Runs):
    found = rows(runs.file("sizes/sizes.parquet"), question="overlap", k=8)
    few, many = (
        share_of(~part.hit) for part in (found[found.faces <= FEW], found[found.faces >= MANY])
    )
    return (
        (HOLDS if few.high < many.low else FAILS if few.low > many.high else OPEN),
        f"missed with k=8: up to {FEW} faces {few}, from {MANY} {many}",
        "",
    )


@claim(
    "Once bodies are in each other, the closest faces are the wrong ones",
    f"{PROBLEMS}, second",
    "k = 8 misses more deep than shallow overlaps at every size, intervals apart (in part: at"
    " some)",
    "sizes/tables/misses.md gap/tables/gap-deep.md",
    f"{HULLS} Deep: {depth_range('deep')}. The article names this problem for moving bodies; it is"
    " there at rest too.",
)
def deep(runs: Runs):
    inside, shallow = (size_rates(runs, depth, 8) for depth in ("deep", "shallow"))
    worse = {faces: r.low > shallow[faces].high for faces, r in inside.items()}
    text = f"By faces, k = 8: {listed(inside)}. k = 64: {listed(size_rates(runs, 'deep', 64))}."
    same_centre = {
        f"k = {k}": or_reason(
            lambda k: rate(runs.answers("gap"), method=f"ofg k={k}", scenario="deep"), k
        )
        for k in (8, 64)
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
    "all pairs take longer than k = 8 in every cell of size and situation, interval above 1 (in"
    " part: in some)",
    "faces/tables/faces-ratio.md k/tables/k-net.md",
    "Net times from Python, paired case by case; both are our own code. No verdict on cells in"
    " which the net time of k = 8 is, in half of the cases or more, no more than the interquartile"
    f" range of its floor's rounds, or of fewer than {FEWEST} other cases. All pairs are tested"
    " without a tree: an engine's mesh test (fcl-mesh) is the fairer rival, below.",
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
        (
            f"slower in {sum(slower)} of {len(slower)} cells, {low} to {high} times as long; left"
            f" out: {left} of {len(every)} cells"
        ),
        (
            f"All pairs over k = 8: {listed(named)}. Over k = 64, by faces: {faces}. Over k = 8,"
            f" other cases and sweeps: {others}."
        ),
    )


def in_cell(key: tuple[float, str]) -> str:
    return f"{key[0]:g} faces {key[1]}"


@claim(
    "Faces alone tell (the article is silent on a body inside another)",
    BASIC,
    f"misses of contained bodies with all faces under {MISSES:.0%}",
    "gap/tables/gap-contained.md",
    "That a body inside another collides is this project's choice; methods of surfaces are meant to"
    " say otherwise.",
)
def contained(runs: Runs):
    found = rows(runs.answers("gap"), scenario="contained")
    inside = found[found.tags.str.contains('"place": "inside"')]
    every = rate(inside, method="brute-force")
    others = {
        m: or_reason(rate, inside, method=m)
        for m in ("ofg k=8", "ofg k=8 repairs=all", "fcl-convex", "fcl-mesh")
    }
    return are_small([every]), f"missed with all faces: {every}", f"Others: {listed(others)}."


@claim(
    "What it calls a hit is one",
    f"{BASIC}, step 8",
    f"false alarms of k = 8 under {MISSES:.0%} in each family",
    "{board}/tables/accuracy-overlap.md {board}/tables/accuracy-translation.md"
    " {board}/tables/accuracy-motion.md gap/tables/gap-wrong.md",
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
        q: or_reason(rate, found, "false alarms", method="ofg k=8", question=q)
        for q in found.question.unique()
    }

    def closest():
        apart = rows(runs.answers("gap"), method="ofg k=8", scenario="feature_gap", label="clear")
        wrong = apart[apart.outcome == "false alarm"]
        share = f"({len(wrong)} of {len(apart)})"
        return (
            f"up to a gap of {wrong.level.max():.0e} of the size {share}" if len(wrong) else "none"
        )

    return (
        are_small(own.values()),
        f"false alarms of k=8: {spread(own)}",
        (
            f"By family, {len(own) - len(some)} of {len(own)} without any:"
            f" {listed(some) or 'none'}. By question: {listed(asked)}. By feature gap:"
            f" {or_reason(closest)}."
        ),
    )
