# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Objections that the author of an engine may raise, each with figures before and after, computed
from the rows of the runs.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import pandas as pd

from baselines import units
from experiments.analysis import metrics, outcome
from experiments.analysis.outcome import judge
from experiments.analysis.plots import figures
from experiments.run.folder.store import Store

from .runs import Missing, Runs


@dataclass(frozen=True)
class Objection:
    """said: the objection. answer: the change made. rows(runs): (what, before, after), or raises
    Missing. command: prints the figures.
    """

    title: str
    said: str
    answer: str
    rows: Callable[[Runs], list[tuple[str, str, str]]]
    command: str


def page(runs: Runs) -> str:
    """The page in Markdown."""
    parts = [
        "# Objections and answers",
        (
            "Objections that the author of an engine may raise against these tables, the change"
            " made in response, and its effect. Before: under the rule objected to. After: under"
            " the rule of the tables. Both are computed from the same rows unless a line states"
            " otherwise. `ofg-bench findings results --objections results/OBJECTIONS.md` wrote this"
            " page. The [glossary](../experiments/GLOSSARY.md) defines the terms."
        ),
    ]
    for number, objection in enumerate(OBJECTIONS, 1):
        parts += [
            f"## {number}. {objection.title}",
            f"*Objection.* {objection.said}",
            f"*Answer.* {objection.answer}",
            _table(objection, runs),
            f"Command: `{objection.command.format(board=runs.board)}`",
        ]
    return "\n\n".join(parts) + "\n"


def _table(objection: Objection, runs: Runs) -> str:
    try:
        rows = objection.rows(runs)
    except Missing as reason:
        return f"not measured ({reason})"
    return pd.DataFrame(rows, columns=["what", "before", "after"]).to_markdown(
        index=False, disable_numparse=True
    )


def _counts(found: pd.DataFrame) -> pd.DataFrame:
    return metrics.rates(found, ["method"]).set_index("method")


def _of(count, total) -> str:
    return f"{count:.0f}/{total:.0f}"


def tolerances(runs: Runs):
    """Before: all wrong answers, with a tolerance for Bullet only. After: wrong answers outside
    each method's own tolerance.
    """
    counts, rows = _counts(runs.answers(runs.board)), []
    for method in (
        "bullet",
        "fcl-convex",
        "fcl-convex-indep",
        "coal-convex",
        "mujoco",
        "mujoco-libccd",
        "mujoco-speculative",
        "ofg k=8 repairs=all",
    ):
        if method in counts.index:
            c = counts.loc[method]
            rows.append(
                (
                    f"{method}, wrong",
                    _of(c.beyond if method == "bullet" else c.wrong, c.judged),
                    _of(c.beyond, c.judged),
                )
            )
    return rows


def surfaces(runs: Runs):
    counts = _counts(runs.answers(runs.board))
    return [
        (
            f"{m}, wrong",
            _of(c.wrong + c.contained, c.judged + c.contained),
            f"{_of(c.wrong, c.judged)}, contained {c.contained:.0f}",
        )
        for m in ("fcl-mesh", "parry-mesh", "ipctk", "brute-force", "ofg k=8")
        if m in counts.index
        for c in [counts.loc[m]]
    ]


def pieces(runs: Runs):
    store = Store(runs.folder / runs.board)
    if not store.has("pieces.parquet"):
        raise Missing(f"the run {runs.board} contains no pieces; repeat it")
    with_them = outcome.with_pieces(store, runs.answers(runs.board))
    meshes = set(store.read("pieces.parquet").case)
    after = _counts(with_them[with_them.case.isin(meshes)])
    without = judge(store.read("observations.parquet"), store.read("cases.parquet"))
    before = _counts(without[without.case.isin(meshes)])
    rows = [
        (
            f"{m} on meshes, wrong",
            _of(before.wrong[m], before.judged[m]),
            _of(after.wrong[m], after.judged[m]),
        )
        for m in ("bullet-coacd", "mujoco-coacd", "ofg k=8", "ofg k=8 repairs=all")
        if m in before.index and m in after.index
    ]
    own = after.loc["CoACD pieces"]
    return [
        *rows,
        (
            "CoACD pieces judged by the meshes, wrong",
            "attributed to the engines",
            _of(own.wrong, own.judged),
        ),
    ]


def unit(runs: Runs):
    """Counts on the tuning set, seed 71, which is not part of any run."""
    table, rows = pd.read_csv(units.TABLE), []
    for method, part in table.groupby("method", sort=False):
        at, best = part.set_index("unit"), units.tuned()[method]
        rows.append(
            (
                f"{method}, wrong with units of 1 and of {best:g}",
                _of(at.wrong[1.0], at.asked[1.0]),
                _of(at.wrong[best], at.asked[best]),
            )
        )
    return rows


def turns(runs: Runs):
    counts = _counts(runs.answers("rotation"))
    rows = [
        (
            "ipctk-ccd, one linear piece, misses of rotations",
            "283 misses in results/standard of commit 280403c",
            "does not answer rotations",
        )
    ]
    rows += [
        (
            f"{m}, misses of rotations",
            "not run" if "exact" in m else "",
            _of(counts.misses[m], counts.hits[m]),
        )
        for m in counts.index
        if m.startswith("ipctk-ccd-exact")
    ]
    return rows + [
        (
            "fcl-ccd-convex and fcl-ccd-mesh (CCDM_TRANS), motions",
            "run with the rotation ignored",
            "do not answer rotations",
        )
    ]


def fronts(runs: Runs):
    """Before: only methods that answer all cases could be on the front. After: methods are compared
    on the common cases.
    """
    found = runs.answers(runs.board)
    points, rows = figures.joined(Store(runs.folder / runs.board)), []
    overlap = found[found.question == "overlap"]
    for method in ("fcl-convex-exact", "fcl-mesh", "ofg k=8 repairs=all"):
        part = points[(points.method == method) & (points.question == "overlap")]
        if len(part):
            whole = (overlap[overlap.method == method].status == "ok").all()
            rows.append(
                (
                    f"{method}, overlap: panels in which it is on the Pareto front",
                    "eligible" if whole else "never, as it does not answer all cases",
                    _of(part.front.sum(), len(part)),
                )
            )
    return rows


def tilts(runs: Runs):
    found = runs.answers("robustness")
    counts = _counts(found[found.scenario == "near_parallel"])
    if counts.empty:
        raise Missing("the run robustness has no family near_parallel; repeat it")
    return [
        (
            f"{m}, near_parallel",
            '"no error found"' if m == "fcl-convex-exact" else "no such family",
            f"missed {_of(c.misses, c.hits)}, false alarms {_of(c.false_alarms, c.clears)}",
        )
        for m, c in counts.iterrows()
    ]


def casts(runs: Runs):
    found = runs.answers("tunnelling")
    counts = _counts(found)
    rows = [
        (
            m,
            "not run",
            f"missed {_of(c.misses, c.hits)}, false alarms {_of(c.false_alarms, c.clears)}",
        )
        for m, c in counts.iterrows()
        if "-cast" in m and m.startswith("bullet")
    ]
    rows += [
        (m, "", f"missed {_of(c.misses, c.hits)}, false alarms {_of(c.false_alarms, c.clears)}")
        for m, c in counts.iterrows()
        if m.startswith(("fcl-advancement-convex", "fcl-ccd-convex", "bullet-no-margin-substeps"))
    ]
    if not any(m.startswith("bullet") and "-cast" in m for m in counts.index):
        raise Missing(
            "the run tunnelling contains no casts of Bullet; run ofg-bench native --build, then"
            " ofg-bench run tunnelling"
        )
    return rows


def situations(runs: Runs):
    folder = runs.folder / "faces" / "tables"
    if not folder.is_dir():
        raise Missing("run faces is not finished")
    names = sorted(p.stem for p in folder.glob("faces-*.csv"))
    split = [n for n in names if n.rsplit("-", 1)[-1] in ("deep", "near", "apart", "hit", "clear")]
    return [
        (
            "tables of query times of the experiment faces",
            "one, for all situations together",
            f"{len(split)}: {', '.join(split)}",
        )
    ]


def heaps(runs: Runs):
    counts = _counts(runs.answers("rotation"))
    rows = [
        (
            m,
            "one of the two, depending on earlier queries",
            f"missed {_of(c.misses, c.hits)}, false alarms {_of(c.false_alarms, c.clears)}",
        )
        for m, c in counts.iterrows()
        if m.startswith("fcl-advancement-convex")
    ]
    if len(rows) < 2:
        raise Missing("the run rotation has only one state of the heap; repeat it")
    return rows


OBJECTIONS = (
    Objection(
        "Tolerances",
        "Bullet's documented margin was taken into account, but no other method's tolerance.",
        "Every method declares its documented tolerance for misses and for false alarms. For every"
        " method, the tables count all wrong answers and those outside its own tolerance. OFG"
        " declares no tolerance.",
        tolerances,
        "ofg-bench tables results/{board} --only leaderboard",
    ),
    Objection(
        "Surface tests",
        "A test of surfaces cannot detect a body inside another, and is not designed to.",
        "For methods that test surfaces, hits of a body inside another whose surfaces do not meet"
        " are counted in a separate column and enter no rate.",
        surfaces,
        "ofg-bench tables results/{board} --only accuracy-overlap",
    ),
    Objection(
        "CoACD's error",
        "Methods whose query contains the pieces of a mesh were judged by the mesh.",
        "They are judged by the certified truth of the pieces. A separate row gives the error of"
        " the pieces relative to the mesh.",
        pieces,
        "ofg-bench tables results/{board} --only accuracy-overlap",
    ),
    Objection(
        "Units",
        "The unit of length was tuned for FCL and Drake only, and on the cases that are counted.",
        "One rule selects the unit of every best effort configuration, on cases of another seed.",
        unit,
        "python -m experiments.studies.tuning",
    ),
    Objection(
        "Rotations in linear modes",
        "Modes for linear paths were run on rotations.",
        "A default configuration answers the queries that its documentation states; the best effort"
        " configuration divides a rotation into linear pieces; all other queries are unsupported.",
        turns,
        "ofg-bench run rotation --out results/rotation",
    ),
    Objection(
        "Ranks and fronts",
        "The leaderboard compared methods that answer different cases, and the Pareto front"
        " contained only methods that answer all cases.",
        "The tables common-* and ranks-* and the Pareto fronts compare methods on common cases. The"
        " ranks are also given by band of the gap and with equal weight for every scenario.",
        fronts,
        "ofg-bench tables results/{board} --only ranks",
    ),
    Objection(
        "No error found",
        "A method without errors in some families was described as free of errors.",
        "The description was removed, and a family of nearly parallel faces was added.",
        tilts,
        "ofg-bench run robustness --out results/robustness",
    ),
    Objection(
        "Bullet's casts",
        "Bullet's continuous casts exist in C++ and were not run.",
        "All three are run in default and best effort configurations. FCL's best effort"
        " configuration uses the solver and the path model with the fewest misses.",
        casts,
        "ofg-bench native --build && ofg-bench run tunnelling --out results/tunnelling",
    ),
    Objection(
        "Comparable times",
        "Times of clear cases with many faces were compared with times of hits with few faces.",
        "Every table and figure of query times is split by situation.",
        situations,
        "ofg-bench tables results/faces --only faces",
    ),
    Objection(
        "FCL's uninitialised memory",
        "FCL's conservative advancement reads uninitialised memory, so its answers depend on"
        " earlier queries.",
        "It is run with this memory zeroed and with it filled, and the tables show both.",
        heaps,
        "ofg-bench run rotation --out results/rotation",
    ),
)
