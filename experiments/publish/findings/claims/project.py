# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Claims of the project that are not in the article: speed, robustness and repairs."""

from __future__ import annotations

import pandas as pd

from experiments.publish.findings.runs import (
    FAILS,
    HOLDS,
    MISSES,
    OPEN,
    PART,
    Runs,
    are_small,
    interval,
    listed,
    or_reason,
    rate,
    ratios_listed,
    rows,
    spread,
    wrong_rate,
)
from experiments.studies.native.classes import LIBRARIES, V3, library
from experiments.studies.native.page import SCREENED
from experiments.studies.native.summary import OURS

from .claim import claim

#: classes of builds that are compared, with the instruction set of OFG in each
COMPARED = {"generic": "SSE2 and generic builds", V3: f"AVX2 and {V3} builds"}


@claim(
    "Faster than the engines (a question of this project, not a claim of the article)",
    "-",
    "k = 8 takes less time than the fastest engine in every cell of size, situation and class of"
    " build, with the interval of the ratio under 1 (in part: in some cells)",
    "native/native.md faces/tables/faces-ratio.md",
    "The libraries run in C++, and each pair has its own bodies. The ratio is taken pair by pair to"
    " the engine with the least time in the cell, whatever it answers. OFG with SSE2 is compared"
    f" with generic builds, and OFG with AVX2 with builds for {V3}, where they exist. The claims"
    " above give the misses of k = 8 on such bodies.",
)
def engines_speed(runs: Runs):
    found = rows(runs.file("native/rows.parquet"), engine=OURS, mode="cold", bodies="hull")
    parts = {name: rows(found, **{"class": key}) for key, name in COMPARED.items()}
    every = pd.concat(parts.values())
    wins, least = (every.high < 1).tolist(), every.loc[every.ratio.idxmin()]
    most = every.loc[every.ratio.idxmax()]
    number = (
        f"faster in {sum(wins)} of {len(wins)} cells; ratio to the fastest engine"
        f" {interval(least)} ({named(least)}) to {interval(most)} ({named(most)})"
    )
    listing = " ".join(
        f"{name}: {listed({named(r): interval(r) for _, r in part.iterrows()})}."
        for name, part in parts.items()
    )
    third = int((every.high <= 1 / 3).sum())
    repaired = ratios_listed(lambda: runs.times("faces"), "ofg k=8 repairs=all", "ofg k=8", "level")
    return (
        (HOLDS if all(wins) else PART if any(wins) else FAILS),
        number,
        (
            f"Ratio of k = 8 to the fastest engine, by situation and faces. {listing} In {third} of"
            f" {len(wins)} cells k = 8 takes at most a third of its time. Ratio of all repairs to"
            f" k = 8, net times from Python, by faces: {repaired}."
        ),
    )


def named(row: pd.Series) -> str:
    """A cell and the engine with which OFG is compared in it."""
    return f"{row.situation} {row.faces}, {row.over}"


#: faces -> the project's aim at small gaps: the largest ratio of k = 8 to the fastest engine
GOAL = {12: 1 / 3, 320: 1 / 5, 1280: 1 / 5}


@claim(
    "At small gaps, with a separating plane screen and in batches: a third of the fastest engine's"
    " time at 12 faces, and a fifth at 320 and 1,280 (an aim of this project, not of the article)",
    "-",
    "k = 8 in double precision, screened and in batches, stays within these shares for every shape"
    " and class of build (in part: for some, or if the run lacks one of"
    f" {', '.join(LIBRARIES.values())})",
    "native/native.md",
    "The screen is not a step of the article: it decides queries in which a plane separates the"
    " whole bodies, and gives the answers of the eight steps. The engines run pair by pair, as none"
    " accepts many poses in one call. The ratio is taken per block of poses.",
)
def batch_speed(runs: Runs):
    every = runs.file("native/rows.parquet")
    every = every[every["class"].isin(COMPARED)]
    engines = every.engine.astype(str).unique()
    asked = {library(e) for e in engines}
    absent = [name for name in LIBRARIES.values() if name not in asked]
    batch = rows(every, engine=SCREENED, mode="batch")
    gaps = rows(batch, situation="gap", faces=[str(faces) for faces in GOAL])
    goal = gaps.faces.astype(int).map(GOAL)
    reached = (gaps.ratio <= goal).tolist()
    parts = {name: rows(gaps, **{"class": key}) for key, name in COMPARED.items()}
    number = "; ".join(
        f"{name}: " + ", ".join(f"{r.bodies} {r.faces} {r.ratio:.2f}" for r in part.itertuples())
        for name, part in parts.items()
    )
    alone = rows(every, engine=OURS, mode="warm", situation="gap")
    verdict = HOLDS if all(reached) else PART if any(reached) else FAILS
    lacking = f" (without {' and '.join(absent)})" if absent else ""
    return (
        PART if absent and verdict == HOLDS else verdict,
        f"ratio to the fastest engine measured{lacking}: {number}",
        (
            f"Over all shapes and sizes, screened and in batches: {ranges(batch)}. Without the"
            f" screen, one pair at a time: {ranges(alone)}."
        ),
    )


def ranges(part: pd.DataFrame) -> str:
    """The least and the largest ratio of each situation and class, with their cells."""
    found = {}
    for (situation, key), group in part.groupby(["situation", "class"], observed=True, sort=False):
        ends = [group.loc[group.ratio.idxmin()], group.loc[group.ratio.idxmax()]]
        low, high = (f"{interval(r)} ({r.bodies} {r.faces}, {r.over})" for r in ends)
        found[f"{situation}, {COMPARED[key]}"] = f"{low} to {high}"
    return listed(found)


@claim(
    "Units, position and shape do not affect accuracy (not in the article)",
    "-",
    f"the rate of wrong answers with k = 8 is under {MISSES:.0%} in each family",
    "robustness/tables/robustness-scale.md robustness/tables/robustness-offset.md"
    " robustness/tables/robustness-aspect.md robustness/tables/robustness-ratio.md"
    " robustness/tables/robustness-tilt.md",
    "Slivers and size ratios also affect the selection; the figures for all faces show the tests"
    " alone.",
)
def robust(runs: Runs):
    found = runs.answers("robustness")
    wrong = {
        m: {
            f"`{name}`": wrong_rate(rows(part, method=m))
            for name, part in found.groupby("scenario")
        }
        for m in ("ofg k=8", "brute-force")
    }
    return (
        are_small(wrong["ofg k=8"].values()),
        f"wrong with k=8: {spread(wrong['ofg k=8'])}",
        f"By family, k = 8: {listed(wrong['ofg k=8'])}. All faces: {listed(wrong['brute-force'])}.",
    )


@claim(
    "With all repairs there are no misses (of this project, not of the article)",
    "-",
    f"no miss, with an interval under {MISSES:.0%}, for each question (in part: for some)",
    "repairs/tables/repairs-overlap.md repairs/tables/repairs-translation.md"
    " repairs/tables/repairs-motion.md repairs/tables/repairs-ratio.md",
    "This covers only the bodies and families named. The repairs were developed on these families,"
    " and all runs share a seed, so that cases of the same name are identical.",
)
def repaired(runs: Runs):
    found = runs.answers("repairs")
    base, all_ = "ofg k=8", "ofg k=8 repairs=all"
    by_question = {q: rate(found, method=all_, question=q) for q in found.question.unique()}
    lost = {m: set(part.case[part.outcome == "miss"]) for m, part in found.groupby("method")}
    alone = {
        m.split("repairs=")[1]: len(lost[base] - lost[m])
        for m in lost
        if "repairs=" in m and m != all_ and "all-but-" not in m
    }
    without = {m.split("all-but-")[1]: len(lost[m] - lost[all_]) for m in lost if "all-but-" in m}
    text = f"Certified hits: {asked_of(runs, found, all_)}. "
    text += (
        f"Without repairs {rate(found, method=base)} are missed. Of these misses, each repair alone"
        f" removes: {listed(alone)}. Misses that reappear without one repair: {listed(without)}."
    )
    alarms = [or_reason(rate, found, "false alarms", method=m) for m in (base, all_)]
    text += (
        " Ratio of net time of all repairs to that of k = 8:"
        f" {ratios_listed(lambda: runs.times('repairs'), all_, base, 'question')}. False alarms:"
        f" without repairs {alarms[0]}, with all repairs {alarms[1]}."
    )

    def everywhere():
        each = [
            rows(answers, method=all_)
            for answers in map(runs.answers, runs.finished)
            if (answers.method == all_).any()
        ]
        once = pd.concat(each or [found.iloc[:0]]).drop_duplicates("case")
        return f"missed {rate(once)}, false alarms {rate(once, 'false alarms')}"

    text += f" Over all runs, with each case counted once: {or_reason(everywhere)}."
    none = [r.count == 0 for r in by_question.values()]
    verdict = (
        OPEN
        if all(none) and not all(r.small for r in by_question.values())
        else HOLDS
        if all(none)
        else PART
        if any(none)
        else FAILS
    )
    return verdict, f"missed: {listed(by_question)}", text


def asked_of(runs: Runs, found: pd.DataFrame, method: str) -> str:
    """The numbers of certified hits that a method answered, by kind of bodies and by family."""
    hits = rows(found, method=method, label="hit", status="ok")
    kind = hits.case.map(runs.bodies("repairs"))
    each = {
        f"{question} of {kind}": f"{len(part)} hits ({', '.join(part.scenario.unique())})"
        for (kind, question), part in hits.groupby([kind, "question"], sort=False)
    }
    return listed(each)
