# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Claims on the basic algorithm: its cost, the choice of k, and suitable bodies."""

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

HULLS = "Pairs of random convex hulls with equal numbers of faces."
FEWEST = 3  # least number of cases in a cell of times
FEW, MANY = sizes.FACES[1], sizes.FACES[3]  # the measured sizes called "few faces" and "many faces"


def depth_range(name: str) -> str:
    low, high = sizes.DEPTHS[name]
    return f"{low:g} to {high:g} radii deep along a contact normal"


@claim(
    "Selecting faces costs O(n + m)",
    f"{BASIC}, steps 2 and 4",
    "in every query, at most n + m distances by the article's count, and at most 2 (n + m)"
    " distances actually computed, to faces and to blocks of faces",
    "sizes/tables/operations.md native/native.md",
    f"{HULLS} The article's count holds by construction, as the counter adds n + m. The number of"
    " computed distances does not: one bound per block of faces can skip the block.",
)
def selection(runs: Runs):
    found = rows(sizes.operations(runs.file("sizes/sizes.parquet")), question="overlap")
    counted, computed = found.distances_max.max(), found.evaluated_max.max()
    eight = rows(found, k=8).set_index("faces")
    mean = listed(eight.evaluated_mean, lambda v: f"{100 * v:.1f} %")
    number = f"computed: at most {computed:.2f} (n + m); n={found.queries.sum()} queries"
    text = (
        f"Counted: at most {counted:.2f} (n + m), by construction. Computed with k = 8, mean by"
        f" faces: {mean}. Native time of the selection only: {or_reason(lambda: growth(runs))}."
    )
    return (HOLDS if counted <= 1 and computed <= 2 else FAILS), number, text


def growth(runs: Runs) -> str:
    """Native time of the selection steps for the most faces, relative to the fewest."""
    own = rows(
        steps(runs.file("native/rows.parquet"), V3),
        bodies="hull",
        situation="gap",
        k="8",
        precision="double",
    )
    if len(own) < 2:
        raise Missing("run native has fewer than two sizes of hulls")
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
    f"{HULLS} Overlapping pairs, {depth_range('shallow')} and {depth_range('deep')}. The bound"
    " holds by construction, as two selections of k faces have k^2 pairs; the finding is the"
    " number of pairs that are tested.",
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
            f"Pairs decided with k = 8: {mean:.2g} k^2, mean over all sizes, since the first"
            f" intersecting pair ends the query; with any k at most {most:.2f} k^2. A full test is"
            " the test of a pair that no cheap rejection decides."
        ),
    )


@claim(
    "k^2 + 3k operations replace n m",
    f"{BASIC}, step 8",
    "at most k^2 + 3k pairs of faces in every overlap query",
    "sizes/tables/operations.md",
    f"{HULLS} The article claims this for overlap queries only; by construction no query has more"
    " than k^2 pairs. It makes no claim on sweeps, which are listed without a verdict. There each"
    " pair of faces and each pair of a virtual edge and a face counts as one operation: up to 3k"
    " virtual edges against k faces, and twice k^2 pairs.",
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
            f"At {MANY} faces and k = 8 an overlap query needs {share:.1e} of the n m operations on"
            f" average. Maximum for sweeps, in units of k^2 + 3k: {listed(flown)}."
        ),
    )


@claim(
    "A higher k is more accurate",
    BASIC,
    "misses do not rise from any k to the next in any family (in part: they do not rise over all"
    " families together)",
    "k/tables/k-misses.md",
    "If k is at least the number of faces (inf), all faces are selected; the remaining misses are"
    " those of the tests.",
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
        raise Missing("run k has fewer than two values of k")
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
        f"Misses by k: {listed(pooled)}. {lost} of {len(missed)} cases are found with some k and"
        " missed with the next larger one"
    )
    text += (
        f"; misses rise from some k to the next in {', '.join(rising)}."
        if rising
        else "; misses do not rise in any family."
    )
    text += (
        " Ratio of the net time of k = 64 to that of k = 8:"
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
    f"the rate of misses of shallow overlaps with k = 8 is under {MISSES:.0%} at every size",
    "sizes/tables/misses.md k/tables/k-misses.md",
    f"{HULLS} Overlaps {depth_range('shallow')}.",
)
def typical_k(runs: Runs):
    eight, four = (size_rates(runs, "shallow", k) for k in (8, 4))
    return (
        are_small(eight.values()),
        f"missed with k=8: {spread(eight)}",
        f"Misses by faces with k = 8: {listed(eight)}. With k = 4: {listed(four)}.",
    )


@claim(
    "Small faces need a higher k",
    BASIC,
    "the rate of misses with k = 8 is higher for the largest bodies than for the smallest, with"
    " disjoint intervals",
    "sizes/tables/misses.md",
    f"{HULLS} Shallow overlaps. Values of k: {', '.join(map(str, sizes.KS))}.",
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
    f"the rate of misses with k = 8, shallow and deep together, is lower for up to {FEW} faces than"
    f" for {MANY} faces or more, with disjoint intervals",
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
        f"missed with k=8: up to {FEW} faces {few}, {MANY} faces or more {many}",
        "",
    )


@claim(
    "Once bodies interpenetrate, the closest faces are the wrong ones",
    f"{PROBLEMS}, second",
    "the rate of misses with k = 8 is higher for deep than for shallow overlaps at every size, with"
    " disjoint intervals (in part: at some sizes)",
    "sizes/tables/misses.md gap/tables/gap-deep.md",
    f"{HULLS} Deep: {depth_range('deep')}. The article describes this problem for moving bodies; it"
    " also affects bodies at rest.",
)
def deep(runs: Runs):
    inside, shallow = (size_rates(runs, depth, 8) for depth in ("deep", "shallow"))
    worse = {faces: r.low > shallow[faces].high for faces, r in inside.items()}
    text = (
        f"Misses by faces with k = 8: {listed(inside)}. With k = 64:"
        f" {listed(size_rates(runs, 'deep', 64))}."
    )
    same_centre = {
        f"k = {k}": or_reason(
            lambda k: rate(runs.answers("gap"), method=f"ofg k={k}", scenario="deep"), k
        )
        for k in (8, 64)
    }
    text += f" Bodies with nearly equal centres (`deep`): {listed(same_centre)}."
    return (
        (HOLDS if all(worse.values()) else PART if any(worse.values()) else FAILS),
        f"deep overlaps missed with k=8: {spread(inside)}",
        text,
    )


@claim(
    "Cheaper than all pairs of faces",
    f"{BASIC}, k^2 + 3k against n m",
    "all pairs take longer than k = 8 in every cell of size and situation, with the interval of the"
    " ratio above 1 (in part: in some cells)",
    "faces/tables/faces-ratio.md k/tables/k-net.md",
    "Ratios of net times from Python, paired case by case; both methods are our own code. A cell is"
    " left out if the net time of k = 8 lies within the interquartile range of its floor's rounds"
    f" in half of its cases or more, or if it has fewer than {FEWEST} other cases. All pairs are"
    " tested without a bounding volume hierarchy; an engine's mesh test (fcl-mesh, below) is the"
    " fairer comparison.",
)
def all_pairs(runs: Runs):
    every = ratio(runs.times("faces"), "brute-force", "ofg k=8", ["level", "situation"])
    found = every[every.ratio.notna() & (every.pairs >= FEWEST)]
    left = len(every) - len(found)
    if found.empty:
        raise Missing("every cell of run faces lies within the noise of the floor")
    slower, ordered = (found.low > 1).tolist(), found.sort_values("ratio")
    low, high = (f"{interval(r)} ({in_cell(r.Index)})" for r in ordered.iloc[[0, -1]].itertuples())
    named = {in_cell(key): times_more(r) for key, r in found.iterrows()}
    faces = ratios_listed(lambda: runs.times("faces"), "brute-force", "ofg k=64", "level")
    others = ratios_listed(lambda: runs.times("k"), "brute-force", "ofg k=8", "question")
    return (
        HOLDS if all(slower) else PART if any(slower) else FAILS,
        (
            f"all pairs slower in {sum(slower)} of {len(slower)} cells; ratio {low} to {high}; left"
            f" out: {left} of {len(every)} cells"
        ),
        (
            f"Ratio to k = 8: {listed(named)}. Ratio to k = 64, by faces: {faces}. Ratio to k = 8"
            f" in run k, by question: {others}."
        ),
    )


def in_cell(key: tuple[float, str]) -> str:
    return f"{key[0]:g} faces {key[1]}"


@claim(
    "Faces alone suffice (the article does not mention a body inside another)",
    BASIC,
    f"the rate of misses of contained bodies with all faces is under {MISSES:.0%}",
    "gap/tables/gap-contained.md",
    "This project counts a body inside another as a collision; tests of surfaces are not designed"
    " to report it.",
)
def contained(runs: Runs):
    found = rows(runs.answers("gap"), scenario="contained")
    inside = found[found.tags.str.contains('"place": "inside"')]
    every = rate(inside, method="brute-force")
    others = {
        m: or_reason(rate, inside, method=m)
        for m in ("ofg k=8", "ofg k=8 repairs=all", "fcl-convex", "fcl-mesh")
    }
    return are_small([every]), f"missed with all faces: {every}", f"Missed by: {listed(others)}."


@claim(
    "No false positives",
    f"{BASIC}, step 8",
    f"the rate of false alarms with k = 8 is under {MISSES:.0%} in each family",
    "{board}/tables/accuracy-overlap.md {board}/tables/accuracy-translation.md"
    " {board}/tables/accuracy-motion.md gap/tables/gap-wrong.md",
    "OFG reports touching faces as a hit, up to rounding in double precision, and pieces differ"
    " slightly from their mesh; both appear here as false alarms. A family with few clear cases has"
    " a wide interval.",
)
def false_alarms(runs: Runs):
    found = runs.answers(runs.board)
    own = by_family(found, "ofg k=8", "false alarms")
    if not own:
        raise Missing(f"run {runs.board} has no certified clear cases")
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
            f"{len(own) - len(some)} of {len(own)} families have no false alarm; the others:"
            f" {listed(some) or 'none'}. By question: {listed(asked)}. In `feature_gap`:"
            f" {or_reason(closest)}."
        ),
    )
