# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Tables defined by a configuration: a row per method, a column per level, scenario or tag."""

from __future__ import annotations

import json
from collections.abc import Iterator

import numpy as np
import pandas as pd

from experiments.analysis import costs, metrics, views
from experiments.cases import families
from experiments.run import piece_truth
from experiments.run.bins import SITUATIONS, SIZES, size_of
from experiments.run.config import ConfigError, RunConfig, TableChoice, closest
from experiments.run.folder.store import Store
from ofg import QUESTIONS

from .cost import IN_NOISE, microseconds, reference_of, state_of
from .table import Table, of, pivot

COLUMNS = ("level", "scenario", "question", "situation", "faces", "band")
COUNTS = {  # value of a table -> two columns of metrics.rates, name of the interval, caption
    "misses": (
        "misses",
        "hits",
        "miss",
        "Misses (certified hits answered clear), of the certified hits answered.",
    ),
    "false alarms": (
        "false_alarms",
        "clears",
        "alarm",
        "False alarms (certified clear cases answered hit), of the certified clear cases answered.",
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
            "Wrong answers outside the method's own documented tolerance, of the certified cases"
            " answered."
        ),
    ),
    "tunnelled": (
        "tunnelled",
        "can_tunnel",
        "tunnel",
        "Misses of hit sweeps that start and end clear, of all such sweeps answered.",
    ),
    "answered": ("answered", "asked", "answered", "Cases answered, of all cases."),
}
WITH_PIECES = COUNTS.keys() - {"answered"}  # values that exist for the CoACD pieces
CLOCKED = ("net time", "gross time", "build time", "ratio")


def check(config: RunConfig) -> None:
    """Raise ConfigError for a table that names something the run does not have."""
    known = {c.name: families.get(c.name) for c in config.scenarios}
    for choice in config.tables:
        where = f"The table '{choice.name}'"
        for name in choice.scenarios:
            if name not in known:
                raise ConfigError(
                    f"{where}: the scenario '{name}' is not in the run{closest(name, known)};"
                    f" its scenarios are {', '.join(known)}."
                )
        if choice.question not in ("", *QUESTIONS):
            raise ConfigError(
                f"{where}: there is no question '{choice.question}'; the questions are"
                f" {', '.join(QUESTIONS)}."
            )
        if choice.value in CLOCKED and not config.timing.cases:
            raise ConfigError(
                f"{where}: '{choice.value}' needs times; set timing.cases to a number above 0."
            )
        tags = {
            t
            for n in choice.scenarios or known
            for t in known[n].case(config.seed, known[n].levels[0], 0).tags
        }
        if choice.columns not in (*COLUMNS, *tags):
            raise ConfigError(
                f"{where}: columns = '{choice.columns}' is not valid. Use {', '.join(COLUMNS)} or a"
                f" tag of its scenarios ({', '.join(sorted(tags)) or 'they have none'})."
            )


def chosen_tables(store: Store, found: pd.DataFrame, choice: TableChoice) -> Iterator[Table]:
    """A table that the configuration defines. A table of times is split by situation, on which the
    query time depends.
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
            f"Ratio of net time to that of {reference}: median of the case-by-case ratios, with its"
            f" 95 % bootstrap interval. Above 1: slower. {IN_NOISE} {state}"
        )
        found = costs.ratios(times, reference, ["column"]).dropna(subset=["ratio"])
        return found, lambda r: f"{r.ratio:.2g} [{r.low:.2g}, {r.high:.2g}]", note
    column, what = {
        "net time": (
            "net",
            "Microseconds per query from Python, less the method's floor (median over cases)",
        ),
        "gross time": (
            "ns",
            "Microseconds per query from Python, including the floor (median over cases)",
        ),
        "build time": (
            "build_ns",
            (
                "Microseconds to prepare a query (median over cases; most methods keep a body that"
                " was built before)"
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
            "Median error of the time of impact outside the certified bracket, as a share of the"
            " step, for correctly reported hits; 95 % bootstrap intervals in the CSV."
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
        f"Largest {'late' if value == 'latest' else 'early'} error of the time of impact outside"
        " the certified bracket, as a share of the step, for correctly reported hits.",
    )
