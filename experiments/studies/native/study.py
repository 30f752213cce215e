# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Every cell of a native study, measured, compared, printed and written."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd

from baselines import native as engines
from experiments.run.config import TimingChoice
from experiments.run.folder import manifest
from experiments.run.folder.store import Store
from experiments.run.progress import stage

from . import certified, further, lanes, saving, synthetic, twins
from .cell import Cell
from .measuring import measure
from .page import markdown, page
from .ratios import growths, ratios
from .summary import summary


def study(
    run: Path | None,
    cases: int,
    poses: int,
    rounds: int,
    seed: int,
    core: int | None,
    python: bool,
    out: Path | None,
) -> None:
    """Build what is found, measure, print the page, and write it into `out`, if that is given.

    NativeError where the lane cannot be built or run; StoreError where `run` is no finished run.
    """
    built = head()
    if run is None:
        poses = poses // 32 * 32
        cells = [*synthetic.cells(cases, poses, seed), *further.cells(poses, seed)]
        asked = f"Hulls, cubes and icospheres by size, labels certified, seed {seed}."
    else:
        cells, left = list(certified.cells(Store(run), cases)), certified.left_out(Store(run))
        asked = (
            f"Certified cases of the run {run.name}, up to {cases} per cell. {left} cases of"
            " unions, or of two rotating bodies, are left out."
        )
    made = saving.facts(asked=asked, rounds=rounds)
    times, answers, both, noise = _measured(cells, rounds, core, python)
    rows = saving.small(summary(times, answers))
    found = {"ratios": saving.few_digits(ratios(times, answers)), "growths": growths(times)}
    facts = [asked, f"{rounds} rounds.", *built, _noise(noise)]
    facts += _against(Store(run), rows, answers) if run else []
    facts = [line for fact in facts for line in (fact, "")]
    print(page(rows, facts, **found, parts=False) + _both(both))
    if out:
        made |= {"noise": round(float(np.nanmax(noise)), 4), "finished": manifest.now()}
        saving.save(out, rows, page(rows, facts, **found) + _both(both), made, **found)


def _measured(cells: list[Cell], rounds: int, core: int | None, python: bool) -> tuple:
    times, answers, both, noise = [], [], [], []
    with stage("time in C++", len(cells)) as advance:
        for cell in cells:
            took, said, disturbed = measure(cell, rounds, 2, core)
            if python and cell.modes == ("cold",):
                both.append(lanes.compare(cell, took, said, TimingChoice(rounds=rounds)))
            times.append(took), answers.append(said), noise.append(disturbed)
            advance(1)
    return pd.concat(times, ignore_index=True), pd.concat(answers, ignore_index=True), both, noise


def head() -> list[str]:
    """Build what is found. The machine and the plugins that stand; a line for each that does not.

    NativeError as baselines.native.build.
    """
    stand, missing = engines.build()
    machine = manifest.machine()
    lines = [f"{machine['cores']} cores, {machine['processor']}. Plugins: {', '.join(stand)}."]
    return lines + [f"Left out: {line}." for line in missing]


def _noise(noise: list[float]) -> str:
    return (
        "Noise probe (a fixed computation): the 90th percentile of its rounds lies"
        f" {100 * np.nanmedian(noise):.0f} % above their median in the median cell,"
        f" {100 * np.nanmax(noise):.0f} % in the worst."
    )


def _against(store: Store, rows: pd.DataFrame, answers: pd.DataFrame) -> list[str]:
    """What the run's methods said of the same cases; and the table for its report."""
    observed = store.read("observations.parquet")
    labels = twins.pairs(rows.engine.unique(), observed.method.unique())
    store.write_text(saving.for_report(rows, labels).to_csv(index=False), "tables", "native.csv")
    told = twins.disagreements(answers, observed)
    differ = [f"{r.engine} ({r.isa}) {r.differ}/{r.cases}" for r in told.itertuples() if r.differ]
    engines_alone, methods_alone = twins.alone(rows.engine.unique(), observed.method.unique())
    return [
        (
            f"{len(labels)} native configurations correspond to methods of the run. Of"
            f" {told.cases.sum()} answers to the same cases, {told.differ.sum()} differ:"
            f" {', '.join(differ) or 'none'}."
        ),
        (
            "Native configurations without a corresponding method in the run:"
            f" {', '.join(engines_alone) or 'none'}."
        ),
        f"Methods without a native counterpart: {', '.join(methods_alone) or 'none'}.",
    ]


def _both(parts: list[pd.DataFrame]) -> str:
    if not parts:
        return ""
    table = pd.concat(parts, ignore_index=True)
    shown = table.assign(ratio=table.ratio.map("{:.2f}".format))
    lines = [
        "",
        "## From Python and in C++, ns",
        "",
        (
            "gross: from Python. net: gross minus the method's floor. ratio: net over native. same:"
            " cases with the same answer in both."
        ),
        "",
        markdown(shown),
        "",
    ]
    return "\n".join([*lines, *lanes.explained(table)]) + "\n"
