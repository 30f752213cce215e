"""What the project asks beside the article: speed against engines, robustness, the repairs."""

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
    "Faster than the engines (the project's question, not the article's)",
    "-",
    "k = 8 takes less than the fastest engine in every cell of size, situation and class of build,"
    " interval under 1 (in part: in some)",
    "native/native.md faces/tables/faces-ratio.md",
    "The libraries in C++, each pair with bodies of its own: the quotient pair by pair, with the"
    " engine that takes least in the cell, whatever it answers. OFG with SSE2 stands beside generic"
    f" builds, with AVX2 beside builds for {V3}, where there is one. What k = 8 misses of such"
    " bodies stands above.",
)
def engines_speed(runs: Runs):
    found = rows(runs.file("native/rows.parquet"), engine=OURS, mode="cold", bodies="hull")
    parts = {name: rows(found, **{"class": key}) for key, name in COMPARED.items()}
    every = pd.concat(parts.values())
    wins, least = (every.high < 1).tolist(), every.loc[every.ratio.idxmin()]
    most = every.loc[every.ratio.idxmax()]
    number = (
        f"faster in {sum(wins)} of {len(wins)} cells; {interval(least)} ({named(least)}) to"
        f" {interval(most)} ({named(most)}) of the fastest engine's time"
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
            f"k = 8 over the fastest engine, by situation and faces. {listing} At most a third of"
            f" its time in {third} of {len(wins)} cells. All repairs over k = 8, net, from Python,"
            f" by faces: {repaired}."
        ),
    )


def named(row: pd.Series) -> str:
    """A cell, and what is compared with in it."""
    return f"{row.situation} {row.faces}, {row.over}"


#: faces -> what share of the fastest engine's time k = 8 may take at small gaps: the project's aim
GOAL = {12: 1 / 3, 320: 1 / 5, 1280: 1 / 5}


@claim(
    "At small gaps, screened by a plane and in batches, a third of the fastest engine's time at 12"
    " faces, a fifth at 320 and 1,280 (the project's aim, not the article's)",
    "-",
    "k = 8 in double, screened in batch, within these shares for every shape and class of build (in"
    f" part: for some, or of a run without one of {', '.join(LIBRARIES.values())})",
    "native/native.md",
    "A screen is no step of the article: it settles what a plane between the whole bodies keeps"
    " apart, with the answers of the eight steps. Engines are asked pair by pair, as none answers"
    " many poses in one call. The quotient block of poses by block.",
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
    lacking = f", {' and '.join(absent)} not asked" if absent else ""
    return (
        PART if absent and verdict == HOLDS else verdict,
        f"of the time of the fastest engine asked{lacking}: {number}",
        (
            f"Over all shapes and sizes, screened in batch: {ranges(batch)}. The eight steps alone,"
            f" one pair at a time: {ranges(alone)}."
        ),
    )


def ranges(part: pd.DataFrame) -> str:
    """The least and the largest quotient of each situation and class, with what they are of."""
    found = {}
    for (situation, key), group in part.groupby(["situation", "class"], observed=True, sort=False):
        ends = [group.loc[group.ratio.idxmin()], group.loc[group.ratio.idxmax()]]
        low, high = (f"{interval(r)} ({r.bodies} {r.faces}, {r.over})" for r in ends)
        found[f"{situation}, {COMPARED[key]}"] = f"{low} to {high}"
    return listed(found)


@claim(
    "Units, place and shape do not matter (not in the article)",
    "-",
    f"wrong answers of k = 8 under {MISSES:.0%} in each family",
    "robustness/tables/robustness-scale.md robustness/tables/robustness-offset.md"
    " robustness/tables/robustness-aspect.md robustness/tables/robustness-ratio.md"
    " robustness/tables/robustness-tilt.md",
    "Slivers and size ratios go through the selection as well: compare all faces.",
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
    "With all repairs nothing is missed (ours, not the article's)",
    "-",
    f"no miss, and its interval under {MISSES:.0%}, of each question (in part: of some)",
    "repairs/tables/repairs-overlap.md repairs/tables/repairs-translation.md"
    " repairs/tables/repairs-motion.md repairs/tables/repairs-ratio.md",
    "Of the bodies and families that are named, no others. The repairs were made while looking at"
    " these families, and all runs share a seed: a case of one name is the same everywhere.",
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
    text = f"Asked of {asked_of(runs, found, all_)}. "
    text += (
        f"The article {rate(found, method=base)} missed. Of these each repair alone finds:"
        f" {listed(alone)}. Left out of all, it brings back: {listed(without)}."
    )
    alarms = [or_reason(rate, found, "false alarms", method=m) for m in (base, all_)]
    text += (
        " Price of all, net time over k = 8:"
        f" {ratios_listed(lambda: runs.times('repairs'), all_, base, 'question')}. False alarms:"
        f" article {alarms[0]}, with repairs {alarms[1]}."
    )

    def everywhere():
        each = [
            rows(answers, method=all_)
            for answers in map(runs.answers, runs.finished)
            if (answers.method == all_).any()
        ]
        once = pd.concat(each or [found.iloc[:0]]).drop_duplicates("case")
        return f"missed {rate(once)}, false alarms {rate(once, 'false alarms')}"

    text += f" In all runs together, each case once: {or_reason(everywhere)}."
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
    """The bodies of the certified hits that a method was asked about, by kind and family."""
    hits = rows(found, method=method, label="hit", status="ok")
    kind = hits.case.map(runs.bodies("repairs"))
    each = {
        f"{question} of {kind}": f"{len(part)} hits ({', '.join(part.scenario.unique())})"
        for (kind, question), part in hits.groupby([kind, "question"], sort=False)
    }
    return listed(each)
