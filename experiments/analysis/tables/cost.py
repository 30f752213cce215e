# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Tables of the query time from Python."""

from __future__ import annotations

from collections.abc import Iterator

import pandas as pd

from baselines import registry
from experiments.analysis import costs
from experiments.run.bins import SIZES
from experiments.run.config import RunConfig
from experiments.run.folder.store import Store

from .table import Table

IN_NOISE = (
    "Cases whose reference net time lies within the noise of its floor (the interquartile range of "
    "the floor's rounds) are left out; if they are half of the cases or more, there is no ratio "
    "(-)."
)


def cost_tables(store: Store) -> Iterator[Table]:
    state = state_of(store)
    note = (
        "Microseconds per query from Python, net (gross), by faces of the larger body: median over"
        " cases of the median over rounds, with a new pose for each call. Net is gross less the"
        f" method's floor, its time for two tetrahedra far apart. {state}"
    )
    for (question, situation), part in costs.costs(store).groupby(
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
    reference = reference_of(store.config)
    for (question, situation), part in costs.paired_ratios(store, reference).groupby(
        ["question", "situation"], sort=False
    ):
        yield Table(
            f"ratio-{question}-{situation}",
            f"Ratio of net time to that of {reference}, {question}, {situation}.",
            "Median of the case-by-case ratios on the cases that both answered, with its 95 %"
            f" bootstrap interval. Above 1: slower. {IN_NOISE} {state}",
            part,
            _by_faces(part, lambda r: f"{r.ratio:.2g} [{r.low:.2g}, {r.high:.2g}]"),
        )


def reference_of(config: RunConfig) -> str:
    if config.timing.reference:
        return config.timing.reference
    try:
        return registry.make(config.asked[0])[0].label
    except (ValueError, ImportError):  # a method whose file is not loaded
        return config.asked[0]


def state_of(store: Store) -> str:
    """A sentence on the noise of the machine during timing, and the lost timings if any."""
    noise = costs.noise(store)
    state = f"Noise probe: 90th percentile {100 * noise:.0f} % above its median" + (
        ": THIS RUN WAS DISTURBED." if noise > 0.25 else "."
    )
    lost = costs.lost(store)
    return (
        f"{state} Not timed, because the process died or hung: {'; '.join(lost)}."
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
    return f"{microseconds(net)} ({microseconds(gross)})"


def microseconds(ns: float) -> str:
    return f"{ns / 1e3:.2f}" if ns < 1e4 else f"{ns / 1e3:.1f}" if ns < 1e5 else f"{ns / 1e3:.0f}"
