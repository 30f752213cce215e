# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Choose the unit of length of every best-effort method: python -m experiments.studies.tuning

Engines have absolute tolerances, so the unit is one of their settings, which the best effort
chooses. The rule was written before the counts: over all families, on a seed that no run uses, the
unit with the fewest wrong answers, then the fewest unanswered, then the nearest to 1
(`baselines.units.best`). Every method that is `Normalised` is run in each of UNITS; its substeps
use its unit. Excluded are uncertain cases; touching ones, where neither answer is wrong; and bodies
of more than FACES faces, for which size and not the unit matters.
The counts are written beside `baselines/units.py`, which reads the unit from them.
"""

from __future__ import annotations

import itertools
import os
import sys
import tempfile
from pathlib import Path

import pandas as pd

from baselines import registry, units
from baselines.sampling import Substeps
from experiments.cases import families
from experiments.cases.case import Case
from experiments.run import answering, config
from experiments.run.processes.pool import Task, mixed, run
from experiments.run.progress import stage
from experiments.truth import label_many

SEED = 71  #: of no preset and no experiment
UNITS = (1.0, 4.0, 32.0, 256.0, 1024.0, 2.0**15, 2.0**18)
CASES = {"overlap": 20, "translation": 4, "motion": 4}  #: per level
FACES = 1000


def tuned() -> list[str]:
    """The methods whose unit is chosen: not the substeps, or pieces, of another one."""
    own = {
        name: cls
        for name, cls in registry.methods().items()
        if issubclass(cls, units.Normalised) and not issubclass(cls, Substeps)
    }
    return [
        name
        for name, cls in own.items()
        if not any(base in own.values() for base in cls.__mro__[1:])
    ]


def cases() -> list[tuple[Case, str]]:
    """(case, label "hit" or "clear") of every family and level."""
    drawn = [
        (family, family.case(SEED, level, index))
        for family in families.scenarios().values()
        for level in family.levels
        for index in range(CASES[family.question])
    ]
    small = [
        (family, case)
        for family, case in drawn
        if max(len(case.query.a.faces), len(case.query.b.faces)) <= FACES
    ]
    truths = label_many([case.query for _, case in small])
    return [
        (case, truth.label)
        for (family, case), truth in zip(small, truths)
        if truth.label != "uncertain" and not truth.touching and not family.useless(truth)
    ]


def counts(names: list[str], workers: int) -> pd.DataFrame:
    """A row per method and unit: asked, wrong, unanswered."""
    limits, labelled = config.load("standard"), cases()
    truth, found, tasks = {case.id: label for case, label in labelled}, {}, []
    for name, unit in itertools.product(names, UNITS):
        questions = registry.methods()[name].questions
        asked = [case for case, _ in labelled if case.query.question in questions]
        rows = found[name, unit] = []
        chunks = [asked[i : i + answering.CHUNK] for i in range(0, len(asked), answering.CHUNK)]
        tasks += [Task(_open, (name, unit, limits), chunk, rows.extend, _lost) for chunk in chunks]
    seconds, total = limits.build_seconds + limits.query_seconds, sum(len(t.items) for t in tasks)
    with tempfile.TemporaryDirectory() as folder, stage("query in each unit", total) as advance:
        run(mixed(tasks), workers, seconds, Path(folder, "log"), advance)
    return pd.DataFrame([_count(*key, rows, truth) for key, rows in found.items()])


def _open(argument):
    name, unit, limits = argument
    cls = registry.methods()[name]
    method = type(cls.__name__, (cls,), {"length": unit})()
    return lambda case: answering.answer(method, case, limits)


def _lost(case: Case, loss) -> dict:
    return {"case": case.id, "status": loss.status}


def _count(name: str, unit: float, rows: list[dict], truth: dict[str, str]) -> dict:
    said = [(truth[row["case"]] == "hit", row["hit"]) for row in rows if row["status"] == "ok"]
    return {
        "method": name,
        "unit": unit,
        "asked": len(rows),
        "wrong": sum(hit != bool(answer) for hit, answer in said),
        "unanswered": len(rows) - len(said),
    }


def main() -> None:
    names = [name for name in tuned() if not registry.available(registry.methods()[name])]
    if absent := sorted(set(tuned()) - set(names)):
        sys.exit(f"No engine is installed for {', '.join(absent)}; install them with: make engines")
    found = counts(names, min(2, os.cpu_count() or 1))
    found.to_csv(units.TABLE, index=False, float_format="%g", lineterminator="\n")
    units.tuned.cache_clear()
    chosen = found.assign(chosen=[units.tuned()[m] == u for m, u in zip(found.method, found.unit)])
    print(chosen.to_string(index=False))


if __name__ == "__main__":
    from .tuning import main  # noqa: F811  (workers unpickle by this module's name)

    main()
