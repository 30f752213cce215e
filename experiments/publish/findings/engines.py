# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""A section per engine: misses and false alarms of its methods over all families, and a line per
experiment.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable

import pandas as pd

from baselines import registry
from baselines.label import name_of
from experiments.analysis import metrics, outcome
from experiments.studies.native.classes import V3

from .runs import (
    Missing,
    Rate,
    Runs,
    grid,
    interval,
    listed,
    or_reason,
    rate,
    ratio,
    rows,
    wrong_rate,
)

ENGINES = {  # heading -> distributions; sampling methods have their own heading
    "FCL": ("python-fcl",),
    "Bullet": ("pybullet", "libbullet"),
    "MuJoCo": ("mujoco",),
    "Coal": ("coal",),
    "Rapier": ("rapier3d",),
    "Parry": ("py-parry3d",),
    "IPC Toolkit": ("ipctk",),
    "Drake": ("drake",),
    "All pairs of faces, and OFG": ("ofg",),
}
SAMPLING = "Sampling: a discrete test at n poses"
SIMULATORS = {"bullet": "Bullet", "mujoco": "MuJoCo", "rapier": "Rapier"}
OURS = "ofg k=8"
QUESTIONS = ("overlap", "translation", "motion")


def engine_of(label: str) -> str:
    """The heading of a method, or of a contestant of the stepping track, which has the name of its
    engine or method.
    """
    name = name_of(label)
    known = registry.methods().get(name)
    if known is None or " " in label and name in SIMULATORS:
        return SIMULATORS.get(name, "")
    if "-substeps" in name or "-naive" in name:
        return SAMPLING
    return next((heading for heading, names in ENGINES.items() if known.engine in names), "")


def board(found: pd.DataFrame, heading: str) -> list[dict]:
    """A row per method of an engine: misses, false alarms, the family with the largest share of
    wrong answers, and failures.
    """
    found = found[
        found.method.map({m: engine_of(m) == heading for m in found.method.unique()}).astype(bool)
    ]
    if found.empty:
        return []
    counts, made = (
        metrics.rates(found, ["method", "question"]).set_index(["method", "question"]),
        [],
    )
    judged = found[found.outcome.isin(outcome.JUDGED)]
    wrong = judged.wrong.groupby([judged.method, judged.scenario], sort=False).agg(
        ["sum", "size", "mean"]
    )
    for method in found.method.unique():
        row = {"method": method, "configuration": configuration_of(method)}
        for question in (q for q in QUESTIONS if (method, q) in counts.index):
            c = counts.loc[(method, question)]
            row[f"{question}, missed"] = (
                str(Rate(int(c.misses), int(c.hits), c.miss_low, c.miss_high)) if c.hits else "-"
            )
            row[f"{question}, false"] = (
                str(Rate(int(c.false_alarms), int(c.clears), c.alarm_low, c.alarm_high))
                if c.clears
                else "-"
            )
        if method not in wrong.index.get_level_values(0):
            continue
        worst = (
            wrong.loc[method].sort_values(["mean", "size"], ascending=False, kind="stable").iloc[0]
        )
        row["worst family"] = (
            f"{worst.name} {worst['sum']:.0f}/{worst['size']:.0f}" if worst["sum"] else "none"
        )
        mine = counts.loc[method].query("answered > 0 or failed > 0")
        row["beyond its tolerance"] = f"{mine.beyond.sum()}/{mine.judged.sum()}"
        row["answered"] = f"{mine.answered.sum()}/{mine.asked.sum()}"
        row["failed"] = str(mine.failed.sum())
        made.append(row)
    return made


def configuration_of(label: str) -> str:
    try:
        return registry.make(label)[0].configuration
    except (ImportError, ValueError):  # an engine that is not installed here
        return registry.methods()[name_of(label)].configuration


def gap(runs: Runs, of: Callable) -> dict:
    found, said = rows(runs.answers("gap"), scenario="feature_gap"), {}
    for method in of(found):
        part = rows(found, method=method)
        bad = part[part.wrong]
        said[method] = f"{wrong_rate(part)}" + (
            f", up to |gap|/size = {bad.level.abs().max():.0e}" if len(bad) else ""
        )
    return said


def walls(runs: Runs, of: Callable) -> dict:
    found = runs.answers("tunnelling")
    return {method: rate(found, "tunnelled", method=method) for method in of(found)}


def turns(runs: Runs, of: Callable) -> dict:
    found = runs.answers("rotation")
    return {method: rate(found, method=method) for method in of(found)}


def impact(runs: Runs, of: Callable) -> dict:
    found = runs.answers("impact")
    errors = metrics.times_of_impact(found[found.method.isin(of(found))], ["method"])
    form = (
        "median {e.median:.1e}, 95th percentile {e.p95:.1e}, latest {e.worst_late:.1e}, earliest"
        " {e.worst_early:.1e}, n={e.times}"
    )
    return {e.method: form.format(e=e) for e in errors.itertuples()}


def native(runs: Runs, of: Callable) -> dict:
    found = runs.file("native/rows.parquet")
    found = rows(found[found["class"].isin(["generic", V3])], situation="gap", mode="cold")
    wide = found.pivot_table(
        index="engine", columns=["class", "faces"], values="ns", observed=True, sort=False
    )
    over = wide / wide.loc[OURS]
    told = of(found.assign(method=found.engine.astype(str)))
    told = [m for m in told if m != OURS and "screen=" not in m and "precision=" not in m]
    form = "{} {} faces {:.2f}".format
    return {m: ", ".join(form(*at, v) for at, v in over.loc[m].items()) for m in told}


def python(runs: Runs, of: Callable) -> dict:
    times = runs.times("faces")
    each = {m: ratio(times, m, OURS, "level") for m in of(times) if m != OURS}
    return {
        m: ", ".join(f"{level:g} faces {interval(r)}" for level, r in found.iterrows())
        for m, found in each.items()
    }


def simulator(runs: Runs, of: Callable) -> dict:
    """Simulators of the stepping track; kinematic loops around a method belong to the engine of the
    method.
    """
    found = runs.file("stepping/stepping.parquet").dropna(subset=["tunnelled"])
    counts = found.groupby("contestant", sort=False)[["tunnelled", "runs"]].sum()
    each = {
        r.Index: Rate(int(r.tunnelled), int(r.runs), *metrics.wilson(r.tunnelled, r.runs))
        for r in counts.itertuples()
    }
    return {name: each[name] for name in of(found.rename(columns={"contestant": "method"}))}


def failures(runs: Runs, of: Callable) -> dict:
    counts: Counter = Counter()
    for run in runs.finished:
        found = rows(runs.answers(run))
        lost = found[found.status.isin(["error", "timeout"]) & found.method.isin(of(found))]
        counts.update(f"{r.method} ({r.detail[:60]})" for r in lost.itertuples())
    return counts


LINES = (  # subject of a line; its table; the function that gives the text for an engine's methods
    ("Wrong answers by signed gap", "gap/tables/gap-wrong.md", gap),
    ("Tunnelled through walls", "tunnelling/tables/tunnelling-straight.md", walls),
    ("Misses of rotating bodies", "rotation/tables/rotation-side.md", turns),
    (
        "Error of the time of impact as a share of the step, including hits found at its end",
        "impact/tables/impact-latest.md",
        impact,
    ),
    (
        f"Ratio of time to that of {OURS} in C++, small gaps, by class of build",
        "native/native.md",
        native,
    ),
    (
        (
            f"Ratio of net time to that of {OURS} from Python (0 if the method's time does not"
            " exceed its floor)"
        ),
        "faces/tables/faces-ratio.md",
        python,
    ),
    ("Tunnelled as a simulator, all scenes and speeds", "stepping/tables", simulator),
    ("Crashes and timeouts in all runs", "", failures),
)


def lines(runs: Runs, heading: str) -> list[str]:
    """A line per experiment on an engine's methods. A missing run is reported; an experiment
    without methods of the engine has no line.
    """

    def of(frame: pd.DataFrame) -> list[str]:
        return [m for m in frame.method.unique() if engine_of(m) == heading]

    said = [
        (title, path, or_reason(lambda say: listed(say(runs, of)), say))
        for title, path, say in LINES
    ]
    return [
        f"- {title}{f' ({runs.link(path)})' if path else ''}: {text}."
        for title, path, text in said
        if text
    ]


def sections(runs: Runs) -> list[str]:
    """The part of the page on the engines, in paragraphs."""
    try:
        found = runs.answers(runs.board)
    except Missing as reason:
        return [f"not measured ({reason})"]
    parts = [
        f"Misses and false alarms in the run {runs.link(runs.board)}, pooled over its families with"
        " the numbers of cases of the run. The families are designed to be difficult, so these are"
        " not rates of everyday use. Worst family: the family with the largest share of wrong"
        " answers. Beyond its tolerance: wrong answers outside the method's documented tolerance."
        " Answered: of the cases of the questions that the method answers; the others have bodies"
        " that it does not accept, or failed. Failed: crashes and timeouts."
    ]
    for heading in (*ENGINES, SAMPLING):
        made = board(found, heading)
        text = grid(made) if made else f"not measured (run {runs.board} has no answers from it)."
        parts += [f"### {heading}\n{text}", "\n".join(lines(runs, heading))]
    return [part for part in parts if part]
