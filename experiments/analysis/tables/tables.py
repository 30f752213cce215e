"""The tables of a run: accuracy first, then time. Each is a frame of plain numbers (CSV) and of
text (terminal, Markdown).
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pandas as pd

from baselines import registry
from experiments.analysis import metrics, views
from experiments.cases import families
from experiments.run import piece_truth
from experiments.run.config import ConfigError, RunConfig, TableChoice, closest
from experiments.run.folder.inside import inside
from experiments.run.folder.rows import filled
from experiments.run.folder.store import Store
from experiments.run.timing import SITUATIONS, SIZES, size_of
from ofg import QUESTIONS

from . import accuracy
from .methods import method_table
from .table import Table, latex, markdown, of, pivot, texts

__all__ = ["Table", "build", "check", "latex", "markdown", "save", "texts"]


def build(store: Store) -> Iterator[Table]:
    """Every table of the run that has rows, in reading order: first those that its configuration
    asks for.
    """
    if store.config.stepping:
        yield from stepping_tables(store)
        return
    found = metrics.outcomes(store)
    both = metrics.with_pieces(store, found)
    particular = [
        table
        for choice in store.config.tables
        for table in chosen_tables(store, both if choice.value in WITH_PIECES else found, choice)
    ]
    yield from (table for table in particular if len(table.text))
    yield from (
        replace(table, headline=table.headline and not particular)
        for table in general(store, found, both)
    )


def general(store: Store, found: pd.DataFrame, both: pd.DataFrame) -> Iterator[Table]:
    """The tables that every run has. both: found, and the pieces' own error."""
    makers = [truth_table(store), method_table(store, found), *accuracy.leaderboards(found)]
    for question in found.question.unique():
        part = found[(found.question == question) & (found.detail != f"does not answer {question}")]
        also = both[(both.question == question) & (both.detail != f"does not answer {question}")]
        makers += [
            accuracy.accuracy_table(also, question),
            accuracy.common_table(part, question),
            touching_table(part, question),
        ]
        makers += [accuracy.scenario_table(also, question), accuracy.rank_table(part, question)]
        if question == "overlap":
            makers.append(accuracy.gap_table(part))
        else:
            makers += [speed_table(part, question), time_table(part, question)]
    makers.append(trouble_table(found))
    if store.has("timings.parquet"):
        makers += list(cost_tables(store))
    yield from (table for table in makers if len(table.text))


def save(store: Store, tables: list[Table]) -> None:
    """Write each table as CSV, Markdown and LaTeX; files of tables that are not made any more go.
    Outside: see `inside`.
    """
    for table in tables:
        inside(store.folder, "tables", f"{table.name}.csv")
    for path in inside(store.folder, "tables").glob("*"):
        if path.suffix in (".csv", ".md", ".tex") and path.stem not in {
            table.name for table in tables
        }:
            path.unlink()
    for table in tables:
        for suffix, text in texts(table).items():
            store.write_text(text, "tables", f"{table.name}.{suffix}")


COLUMNS = ("level", "scenario", "question", "situation", "faces", "band")
COUNTS = {  # value of a table -> columns of metrics.rates, name of its interval, and what it says
    "misses": ("misses", "hits", "miss", "Certified hits answered clear, of those answered."),
    "false alarms": (
        "false_alarms",
        "clears",
        "alarm",
        "Certified clears answered hit, of those answered.",
    ),
    "wrong": (
        "wrong",
        "judged",
        "wrong",
        "Misses and false alarms, of the certified cases answered.",
    ),
    "beyond": (
        "beyond",
        "judged",
        "beyond",
        (
            "Wrong by more than the method's own documented tolerance, of the certified cases"
            " answered."
        ),
    ),
    "tunnelled": (
        "tunnelled",
        "can_tunnel",
        "tunnel",
        "Misses, of the certified hits answered whose start and end are both clear.",
    ),
    "answered": ("answered", "asked", "answered", "Cases answered, of those asked."),
}
WITH_PIECES = COUNTS.keys() - {"answered"}  # values that the pieces' own error has
IN_NOISE = (
    "No ratio (-) where the reference's net time lies within the noise of its floor, the "
    "interquartile range of the floor's rounds, in half of the cases or more; such cases "
    "are left out elsewhere."
)
CLOCKED = ("net time", "gross time", "build time", "ratio")


def check(config: RunConfig) -> None:
    """ConfigError for a table that names what the run does not have."""
    known = {c.name: families.get(c.name) for c in config.scenarios}
    for choice in config.tables:
        where = f"The table '{choice.name}'"
        for name in choice.scenarios:
            if name not in known:
                raise ConfigError(
                    f"{where}: its scenario '{name}' is not one of the run{closest(name, known)};"
                    f" the run has {', '.join(known)}."
                )
        if choice.question not in ("", *QUESTIONS):
            raise ConfigError(
                f"{where}: there is no question '{choice.question}'; the questions are"
                f" {', '.join(QUESTIONS)}."
            )
        if choice.value in CLOCKED and not config.timing.cases:
            raise ConfigError(
                f"{where}: '{choice.value}' needs times; set timing.cases to more than 0."
            )
        tags = {
            t
            for n in choice.scenarios or known
            for t in known[n].case(config.seed, known[n].levels[0], 0).tags
        }
        if choice.columns not in (*COLUMNS, *tags):
            raise ConfigError(
                f"{where}: columns = '{choice.columns}' is neither one of {', '.join(COLUMNS)} nor"
                f" a tag of its scenarios ({', '.join(sorted(tags)) or 'which have none'})."
            )


def chosen_tables(store: Store, found: pd.DataFrame, choice: TableChoice) -> Iterator[Table]:
    """A table that the configuration asks for; of times one for each situation, since what a query
    costs hangs on it.
    """
    if choice.value not in CLOCKED or choice.situation or choice.columns == "situation":
        yield chosen_table(store, found, choice)
        return
    there = set(_chosen_rows(found, choice).situation)
    for situation in (s for s in SITUATIONS if s in there):
        yield chosen_table(
            store,
            found,
            choice.model_copy(
                update={
                    "name": f"{choice.name}-{situation}",
                    "title": f"{choice.title.rstrip('.')}: {situation}.",
                    "situation": situation,
                }
            ),
        )


def _chosen_rows(found: pd.DataFrame, choice: TableChoice) -> pd.DataFrame:
    part = found[
        found.scenario.isin(choice.scenarios or set(found.scenario))
        & found.question.isin([choice.question] if choice.question else QUESTIONS)
    ]
    return part[part.situation == choice.situation] if choice.situation else part


def chosen_table(store: Store, found: pd.DataFrame, choice: TableChoice) -> Table:
    """A row per method, a column per value of choice.columns."""
    part = _chosen_rows(found, choice)
    column, order = _column(part, choice.columns)
    part = part.assign(column=column).dropna(subset=["column"])
    part = part[~part.detail.str.startswith("does not answer", na=False)]
    if choice.value in COUNTS:
        numbers, cell, note = _counted(part, choice.value)
    elif choice.value in CLOCKED:
        numbers, cell, note = _clocked(store, part, choice.value)
    else:
        numbers, cell, note = _off(part, choice.value)
    numbers = numbers.rename(columns={"column": choice.columns})
    text = pivot(numbers, choice.columns, cell, order)
    return Table(
        choice.name,
        choice.title,
        " ".join(filter(None, [choice.note, note])),
        numbers,
        text,
        choice.headline,
        choice=choice,
    )


def _column(part: pd.DataFrame, name: str) -> tuple[pd.Series, list[str]]:
    """The column of each row, and the columns in their order."""
    if name == "band":
        return views.gap_bands(part.relative_gap)
    if name == "faces":
        return size_of(part.faces), [title for _, title in SIZES]
    if name == "situation":
        return part.situation, list(SITUATIONS)
    values = (
        part[name]
        if name in COLUMNS
        else part.tags.map({text: json.loads(text).get(name) for text in part.tags.unique()})
    )
    found = values.dropna().unique()
    if all(isinstance(v, (int, float, np.number)) for v in found):
        return values.map(lambda v: f"{v:g}", na_action="ignore"), [f"{v:g}" for v in sorted(found)]
    return values, list(found) if name in ("scenario", "question") else sorted(found)


def _counted(part: pd.DataFrame, value: str):
    count, total, interval, note = COUNTS[value]
    counts = metrics.rates(part, ["method", "column"])
    if f"{interval}_low" not in counts:
        bounds = [metrics.wilson(c, t) for c, t in zip(counts[count], counts[total])]
        counts[f"{interval}_low"], counts[f"{interval}_high"] = zip(*bounds) if bounds else ((), ())
    numbers = counts[
        [
            "method",
            "column",
            *dict.fromkeys(
                [
                    count,
                    total,
                    f"{interval}_low",
                    f"{interval}_high",
                    "asked",
                    "answered",
                    "uncertain",
                    "within",
                ]
            ),
        ]
    ]
    return (
        numbers,
        lambda r: of(getattr(r, count), getattr(r, total)),
        f"{note} 95 % Wilson intervals in the CSV.{piece_truth.note(part)}",
    )


def _clocked(store: Store, part: pd.DataFrame, value: str):
    times = metrics.case_costs(store).merge(
        part[["case", "method", "column"]], on=["case", "method"]
    )
    state = _state(store)
    if value == "ratio":
        reference = _reference(store.config)
        note = (
            f"Net time over that of {reference}: median of the ratios case by case, 95 % bootstrap "
            f"interval. Above 1: slower. {IN_NOISE} {state}"
        )
        found = metrics.ratios(times, reference, ["column"]).dropna(subset=["ratio"])
        return found, lambda r: f"{r.ratio:.2g} [{r.low:.2g}, {r.high:.2g}]", note
    column, what = {
        "net time": (
            "net",
            "Microseconds per query from Python, less the method's floor; medians over cases",
        ),
        "gross time": (
            "ns",
            "Microseconds per query from Python, floor included; medians over cases",
        ),
        "build time": (
            "build_ns",
            (
                "Microseconds to build for a query (a body that was built before is mostly kept);"
                " medians over cases"
            ),
        ),
    }[value]
    return (
        metrics.medians(times, column, ["method", "column"]),
        lambda r: _microseconds(r.median),
        f"{what}; 95 % bootstrap intervals in the CSV. {state}",
    )


def _off(part: pd.DataFrame, value: str):
    if value == "time error":
        sized = part[part.error.notna()].assign(size_of_error=lambda t: t.error.abs())
        note = (
            "Beyond the certified bracket, as a share of the step, where both say hit; 95 %"
            " bootstrap intervals in the CSV."
        )
        return (
            metrics.medians(sized, "size_of_error", ["method", "column"]),
            lambda r: f"{r.median:.1e}" if r.median else "0",
            note,
        )
    errors = metrics.times_of_impact(part, ["method", "column"])
    worst = "worst_late" if value == "latest" else "worst_early"
    return (
        errors,
        lambda r: f"{getattr(r, worst):.1e}" if getattr(r, worst) else "0",
        "Worst error beyond the certified bracket, as a share of the step, where both say hit.",
    )


def stepping_tables(store: Store) -> Iterator[Table]:
    """A table per scene: what got past, by thicknesses per step."""
    rows = store.read("stepping.parquet")
    told = rows[rows.tunnelled.notna()]
    for scene, part in told.groupby("scene", sort=False):
        part = part.assign(travelled=[f"{t:g}" for t in part.travel])
        text = part.assign(cell=[of(r.tunnelled, r.runs) for r in part.itertuples()]).pivot(
            index="contestant", columns="travelled", values="cell"
        )
        text = text.reindex(
            index=part.contestant.unique(), columns=part.travelled.unique()
        ).rename_axis(columns=None)
        text["us/step"] = part.groupby("contestant").us_per_step.median().map(lambda v: f"{v:.1f}")
        yield Table(
            f"stepping-{scene.replace(' ', '-')}",
            f"Got past: {scene}.",
            "Tunnelled of the runs, by thicknesses travelled per step; each run has its own start"
            " phase. 95 % Wilson intervals in the CSV. us/step: median time of a step.",
            part.drop(columns=["travelled", "detail"]),
            text.reset_index(),
            True,
        )
    lost = rows[rows.tunnelled.isna()][["scene", "contestant", "detail"]]
    if len(lost):
        yield Table(
            "unanswered",
            "What did not run, and why.",
            "None of these is counted as tunnelled.",
            lost,
            lost.astype(str),
        )


def _reference(config: RunConfig) -> str:
    if config.timing.reference:
        return config.timing.reference
    try:
        return registry.make(config.asked[0])[0].label
    except (ValueError, ImportError):  # a method whose file is not loaded
        return config.asked[0]


def truth_table(store: Store) -> Table:
    cases = filled(store.read("cases.parquet"))
    rows = []
    for name, group in cases.groupby("scenario", sort=False):
        count = group.label.value_counts()
        rows.append(
            {
                "scenario": name,
                "question": group.question.iloc[0],
                "cases": len(group),
                "hit": count.get("hit", 0),
                "clear": count.get("clear", 0),
                "touching": int(group.touching.sum()),
                "uncertain": count.get("uncertain", 0),
                "drawn again": int(group.attempt.sum()),
                "precision": " ".join(sorted(group.precision.unique())),
                "exposes": _exposes(name),
            }
        )
    frame = pd.DataFrame(rows)
    text, touching = frame.astype(str), ""
    if frame.touching.any():
        touching = (
            "Touching ones, which share a boundary point without overlapping, count as clear here,"
            " and are in no rate. "
        )
    else:
        text = text.drop(columns="touching")
    caption = (
        f"Uncertain cases are in no rate. {touching}'Drawn again': draws thrown away because the"
        " step began in overlap. Precision: float32 where all numbers of a case are rounded to it."
    )
    return Table(
        "truth",
        "Cases and their certified labels.",
        caption,
        frame,
        text,
        True,
        ("exposes", "precision", "drawn again"),
    )


def touching_table(part: pd.DataFrame, question: str) -> Table:
    """What each method said where the bodies share a point and no more; without such cases no
    rows.
    """
    counts = metrics.rates(part[part.touching], ["method"])
    clears = counts.touching - counts.touching_hits
    shown = {
        "cases": counts.asked,
        "answered": counts.touching,
        "said hit": counts.touching_hits,
        "said clear": clears,
    }
    text = pd.DataFrame({"method": counts.method, **{k: v.astype(str) for k, v in shown.items()}})
    numbers = counts[["method", "asked", "answered", "touching_hits"]].assign(
        touching_clears=clears
    )
    caption = (
        "The bodies are certified to touch without overlapping: neither answer is wrong, and "
        "these cases are in no rate."
    )
    return Table(f"touching-{question}", f"Touching, {question}.", caption, numbers, text, True)


def speed_table(part: pd.DataFrame, question: str) -> Table:
    """Tunnelling along the axis of the first scenario whose axis is a speed over a thickness."""
    walls = [n for n in part.scenario.unique() if "thickness" in _axis(n)]
    part = part[part.scenario.isin(walls)]
    counts = (
        metrics.rates(part, ["method", "level"])
        if len(part)
        else pd.DataFrame(columns=["method", "level"])
    )
    levels = [f"{v:g}" for v in sorted(part.level.unique())]
    counts["speed"] = [f"{v:g}" for v in counts.level]
    return Table(
        f"tunnelling-{question}",
        f"Misses against speed over thickness, {question}.",
        f"Scenario {', '.join(walls)}; columns are thicknesses travelled in the step.",
        counts,
        pivot(counts, "speed", lambda r: of(r.misses, r.hits), levels) if len(counts) else counts,
    )


def time_table(part: pd.DataFrame, question: str) -> Table:
    errors = metrics.times_of_impact(part, ["method"])
    text = pd.DataFrame({"method": errors.method, "times": errors.times.astype(str)})
    for column, title in (
        ("median", "median |error|"),
        ("p95", "95 %"),
        ("worst_late", "latest"),
        ("worst_early", "earliest"),
    ):
        text[title] = [f"{v:.1e}" if v else "0" for v in errors[column]]
    text["late"], text["early"] = errors.late.astype(str), errors.early.astype(str)
    return Table(
        f"time-of-impact-{question}",
        f"Time of impact, {question}.",
        "Error beyond the certified bracket, as a share of the step, where both say hit; late is"
        " positive.",
        errors,
        text,
    )


def trouble_table(found: pd.DataFrame) -> Table:
    lost = found[(found.status != "ok") & ~found.detail.str.startswith("does not answer")].assign(
        detail=lambda t: t.detail.str.slice(0, 60)
    )
    counts = (
        lost.groupby(["method", "status", "detail"], sort=False)
        .size()
        .rename("cases")
        .reset_index()
    )
    return Table(
        "unanswered",
        "What was not answered, and why.",
        "None of these is counted as a miss.",
        counts,
        counts.astype(str),
    )


def cost_tables(store: Store) -> Iterator[Table]:
    state = _state(store)
    note = (
        "Microseconds per query from Python: net (gross). Net is gross less the method's floor,"
        " its own call on two tetrahedra far apart. Columns: faces of the larger body. Medians"
        f" over cases of medians over rounds; poses differ from call to call. {state}"
    )
    for (question, situation), part in metrics.costs(store).groupby(
        ["question", "situation"], sort=False
    ):
        yield Table(
            f"cost-{question}-{situation}",
            f"Time, {question}, {situation}.",
            note,
            part,
            _by_faces(part, lambda r: _cost(r.net, r.gross)),
            headline=True,
        )
    reference = _reference(store.config)
    for (question, situation), part in metrics.paired_ratios(store, reference).groupby(
        ["question", "situation"], sort=False
    ):
        yield Table(
            f"ratio-{question}-{situation}",
            f"Net time over that of {reference}, {question}, {situation}.",
            "Median of the ratios case by case on the cases both "
            f"answered, 95 % bootstrap interval. Above 1: slower. {IN_NOISE} {state}",
            part,
            _by_faces(part, lambda r: f"{r.ratio:.2g} [{r.low:.2g}, {r.high:.2g}]"),
        )


def _state(store: Store) -> str:
    """What to know of the state that the times were taken in."""
    noise = metrics.noise(store)
    state = f"Noise probe: 90th percentile {100 * noise:.0f} % above its median" + (
        ": THIS RUN WAS DISTURBED." if noise > 0.25 else "."
    )
    lost = metrics.lost(store)
    return (
        f"{state} Without times, because the process died or hung: {'; '.join(lost)}."
        if lost
        else state
    )


def _by_faces(part: pd.DataFrame, cell) -> pd.DataFrame:
    wide = part.assign(cell=[cell(r) for r in part.itertuples()]).pivot(
        index="method", columns="faces", values="cell"
    )
    order = [name for _, name in SIZES if name in wide.columns]
    return (
        wide.reindex(index=part.method.unique(), columns=order)
        .fillna("-")
        .rename_axis(columns=None)
        .reset_index()
    )


def _cost(net: float, gross: float) -> str:
    return f"{_microseconds(net)} ({_microseconds(gross)})"


def _microseconds(ns: float) -> str:
    return f"{ns / 1e3:.2f}" if ns < 1e4 else f"{ns / 1e3:.1f}" if ns < 1e5 else f"{ns / 1e3:.0f}"


def _axis(name: str) -> str:
    known = families.scenarios()
    return known[name].axis if name in known else ""


def _exposes(name: str) -> str:
    known = families.scenarios()
    return known[name].exposes if name in known else ""
