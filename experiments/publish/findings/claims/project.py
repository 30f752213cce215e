"""What the project asks beside the article: speed against engines, robustness, the repairs."""

from __future__ import annotations

import pandas as pd

from experiments import bench_ofg

from ..runs import (
    FAILS,
    HOLDS,
    MISSES,
    OPEN,
    PART,
    Missing,
    Runs,
    are_small,
    listed,
    or_reason,
    rate,
    ratios_listed,
    rows,
    spread,
    wrong_rate,
)
from .claim import claim


@claim(
    "Faster than the engines (the project's question, not the article's)",
    "-",
    "k = 8 takes less than the fastest engine in every cell of size and situation (in part: in"
    " some)",
    "native/native.md faces/tables/faces-ratio.md",
    "Native lane: the libraries in C++, medians over pairs of random hulls, no interval. Speed"
    " alone: what k = 8 misses of such bodies stands above.",
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
    number = (
        f"faster in {sum(wins)} of {len(wins)} cells; {min(shares):.2f} to {max(shares):.2f} of the"
        " fastest engine's time"
    )
    return (
        (HOLDS if all(wins) else PART if any(wins) else FAILS),
        number,
        (
            f"k = 8 over the fastest engine, by situation and faces: {listed(cells)}. At most a"
            f" third of its time in {third} of {len(wins)} cells. All repairs over k = 8, net, from"
            f" Python, by faces: {repaired}."
        ),
    )


#: faces -> what share of the fastest engine's time k = 8 may take at small gaps: the project's aim
GOAL = {12: 1 / 3, 320: 1 / 5, 1280: 1 / 5}
#: how the methods of the engines begin that a run has to ask before the aim can be said to hold
RIVALS = ("FCL", "Bullet", "MuJoCo", "parry", "Coal")


@claim(
    "At small gaps, screened by a plane and in batches, a third of the fastest engine's time at 12"
    " faces, a fifth at 320 and 1,280 (the project's aim, not the article's)",
    "-",
    "k = 8 in double, screened in batch, within these shares for every shape (in part: for some, or"
    f" of a run without one of {', '.join(RIVALS)})",
    "bench-ofg/tables.md",
    "A screen is no step of the article: it settles what a plane between the whole bodies keeps"
    " apart, with the answers of the eight steps. Engines are asked pair by pair. Medians over"
    " rounds of paired quotients.",
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
        (
            f"Engines asked: {', '.join(asked)}. The eight steps alone, one pair at a time:"
            f" {alone}. Screened in batch, all sizes and depths: {listed(held)}."
        ),
    )


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
