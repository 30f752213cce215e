"""Objections that the author of a losing engine would raise, each with its number before and after,
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
    """said: the objection. answer: what was changed. rows(runs): (what, before, after), or Missing.
    command: gives the numbers.
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
            "What the author of an engine could object to in these tables, what was done about it,"
            " and what that changes. Before: by the rule that the objection is about. After: by the"
            " rule of the tables. Both are counted from the same rows unless a line says otherwise."
            " Written by `ofg-bench findings results --objections results/OBJECTIONS.md`."
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
    """Before: all wrong answers, Bullet's margin alone credited. After: those beyond each method's
    own tolerance.
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
        raise Missing(f"the run {runs.board} holds no pieces; run it anew")
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
            "CoACD pieces against the meshes, wrong",
            "booked to the engines",
            _of(own.wrong, own.judged),
        ),
    ]


def unit(runs: Runs):
    """Counts of the tuning set, seed 71, which no run counts."""
    table, rows = pd.read_csv(units.TABLE), []
    for method, part in table.groupby("method", sort=False):
        at, best = part.set_index("unit"), units.tuned()[method]
        rows.append(
            (
                f"{method}, wrong in units of 1 and of {best:g}",
                _of(at.wrong[1.0], at.asked[1.0]),
                _of(at.wrong[best], at.asked[best]),
            )
        )
    return rows


def turns(runs: Runs):
    counts = _counts(runs.answers("rotation"))
    rows = [
        (
            "ipctk-ccd, one straight piece, misses of turns",
            "283 misses in results/standard of commit 280403c",
            "not asked about turns",
        )
    ]
    rows += [
        (
            f"{m}, misses of turns",
            "not asked" if "exact" in m else "",
            _of(counts.misses[m], counts.hits[m]),
        )
        for m in counts.index
        if m.startswith("ipctk-ccd-exact")
    ]
    return rows + [
        (
            "fcl-ccd-convex and fcl-ccd-mesh (CCDM_TRANS), motions",
            "asked, turn ignored",
            "not asked about turns",
        )
    ]


def fronts(runs: Runs):
    """Before: only who answers all cases may be on the front. After: all compete on the common
    cases.
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
                    f"{method}, overlap: panels where it is on the front",
                    "may be on it" if whole else "never: it does not answer all",
                    _of(part.front.sum(), len(part)),
                )
            )
    return rows


def tilts(runs: Runs):
    found = runs.answers("robustness")
    counts = _counts(found[found.scenario == "near_parallel"])
    if counts.empty:
        raise Missing("the run robustness has no near_parallel; run it anew")
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
            "not asked",
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
            "the run tunnelling has none of Bullet's casts; run make native, then ofg-bench run"
            " tunnelling"
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
            "tables of time of the experiment faces",
            "one, all situations together",
            f"{len(split)}: {', '.join(split)}",
        )
    ]


def heaps(runs: Runs):
    counts = _counts(runs.answers("rotation"))
    rows = [
        (
            m,
            "one of the two, by what ran before",
            f"missed {_of(c.misses, c.hits)}, false alarms {_of(c.false_alarms, c.clears)}",
        )
        for m, c in counts.iterrows()
        if m.startswith("fcl-advancement-convex")
    ]
    if len(rows) < 2:
        raise Missing("the run rotation asks one heap alone; run it anew")
    return rows


OBJECTIONS = (
    Objection(
        "Tolerances",
        "Bullet's documented margin was credited, and nobody else's tolerance was.",
        "Every method declares the tolerance of its documentation, for misses and for false alarms."
        " The tables count wrong answers, and wrong answers beyond the own tolerance, for all"
        " alike. OFG declares none.",
        tolerances,
        "ofg-bench tables results/{board} --only leaderboard",
    ),
    Objection(
        "Surface tests",
        "A test of surfaces cannot see a body inside another, and is not meant to.",
        "Hits of a body inside another whose surfaces do not meet are counted in a column of their"
        " own, in no rate of a method that tests surfaces.",
        surfaces,
        "ofg-bench tables results/{board} --only accuracy-overlap",
    ),
    Objection(
        "CoACD's error",
        "Methods that are asked about the pieces of a mesh were judged by the mesh.",
        "They are judged by the certified truth of the pieces. The error of the pieces against the"
        " mesh is a row of its own.",
        pieces,
        "ofg-bench tables results/{board} --only accuracy-overlap",
    ),
    Objection(
        "Units",
        "The unit of length was tuned for FCL and Drake alone, and on the cases that are counted.",
        "One rule chooses the unit of every best effort, on cases of another seed.",
        unit,
        "python -m experiments.studies.tuning",
    ),
    Objection(
        "Turns asked of linear modes",
        "Modes for straight paths were asked about turns.",
        "A default is asked what its documentation says that it answers; the best effort asks a"
        " turn in pieces; anything else is unsupported.",
        turns,
        "ofg-bench run rotation --out results/rotation",
    ),
    Objection(
        "Ranks and fronts",
        "The leaderboard compared methods that answer different cases; the Pareto front admitted"
        " only who answers all.",
        "Tables common-* and ranks-* and the fronts compare methods over the cases that all of them"
        " answer, by band of the gap and with every scenario of the same weight too.",
        fronts,
        "ofg-bench tables results/{board} --only ranks",
    ),
    Objection(
        "No error found",
        "A method of which no error was found in some families was said to make none.",
        "No sentence says so any more, and a family of nearly parallel faces has been added.",
        tilts,
        "ofg-bench run robustness --out results/robustness",
    ),
    Objection(
        "Bullet's casts",
        "Bullet's continuous casts exist in C++ and were not asked.",
        "All three are asked, as they come and at their best. FCL's best effort takes the solver"
        " and the path that hit.",
        casts,
        "make native && ofg-bench run tunnelling --out results/tunnelling",
    ),
    Objection(
        "Like with like",
        "Times of clear cases at many faces were compared with times of hits at few.",
        "Every table and figure of time is split by situation.",
        situations,
        "ofg-bench tables results/faces --only faces",
    ),
    Objection(
        "FCL's memory",
        "FCL's advancement reads memory that it never wrote, so its answers hang on what ran"
        " before.",
        "It is asked with that memory zeroed and with it filled, and both are shown.",
        heaps,
        "ofg-bench run rotation --out results/rotation",
    ),
)
