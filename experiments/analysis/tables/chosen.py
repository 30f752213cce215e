"""Tables that a configuration asks for: a row per method, a column per level, scenario or tag."""

from __future__ import annotations

import json
from collections.abc import Iterator

import numpy as np
import pandas as pd

from experiments.analysis import costs, metrics, views
from experiments.cases import families
from experiments.run import piece_truth
from experiments.run.config import ConfigError, RunConfig, TableChoice, closest
from experiments.run.folder.store import Store
from experiments.run.timing import SITUATIONS, SIZES, size_of
from ofg import QUESTIONS

from .cost import IN_NOISE, microseconds, reference_of, state_of
from .table import Table, of, pivot

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
    times = costs.case_costs(store).merge(part[["case", "method", "column"]], on=["case", "method"])
    state = state_of(store)
    if value == "ratio":
        reference = reference_of(store.config)
        note = (
            f"Net time over that of {reference}: median of the ratios case by case, 95 % bootstrap "
            f"interval. Above 1: slower. {IN_NOISE} {state}"
        )
        found = costs.ratios(times, reference, ["column"]).dropna(subset=["ratio"])
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
        costs.medians(times, column, ["method", "column"]),
        lambda r: microseconds(r.median),
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
            costs.medians(sized, "size_of_error", ["method", "column"]),
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
