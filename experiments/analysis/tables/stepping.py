# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Tables of a stepping run: how often a body tunnelled through its obstacle."""

from __future__ import annotations

from collections.abc import Iterator

from experiments.run.folder.store import Store

from .table import Table, of


def stepping_tables(store: Store) -> Iterator[Table]:
    """A table per scene: tunnelled runs by thicknesses travelled per step."""
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
            f"Tunnelled: {scene}.",
            "Tunnelled runs, of all runs, by thicknesses travelled per step; each run has its own"
            " start phase. 95 % Wilson intervals in the CSV. us/step: median time of a step.",
            part.drop(columns=["travelled", "detail"]),
            text.reset_index(),
            True,
        )
    lost = rows[rows.tunnelled.isna()][["scene", "contestant", "detail"]]
    if len(lost):
        yield Table(
            "unanswered",
            "Simulations that did not run, with the reason.",
            "None of them is counted as tunnelled.",
            lost,
            lost.astype(str),
        )
