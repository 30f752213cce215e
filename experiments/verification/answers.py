# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Answers repeated by the methods, in separate processes as in a run, and compared with the
recorded ones.
"""

from __future__ import annotations

import math
import secrets
import tempfile
from collections import Counter
from functools import partial
from pathlib import Path

import numpy as np
import pandas as pd

from baselines import registry
from baselines.label import name_of
from experiments.analysis.compare import SAME_TIME
from experiments.run import answering
from experiments.run.config import load_files
from experiments.run.folder.rows import cases_of
from experiments.run.processes.pool import Task, run
from experiments.run.progress import stage

from .findings import Findings


def check(config, frames, names, count: int, seed, workers, own, found: Findings) -> None:
    """Findings are by case and method. count: of cases, -1 for all. seed: of the random
    selection; None: unpredictable, so that nobody can know the cases beforehand.
    """
    seed = secrets.randbits(32) if seed is None else seed
    n = len(names) if count < 0 else min(count, len(names))
    drawn = {names[i] for i in np.random.default_rng(seed).choice(len(names), n, replace=False)}
    table = frames["cases"][frames["cases"].case.isin(drawn)]
    cases = [case for case, _ in cases_of(table, frames["bodies"].drop_duplicates("body"))]
    rows = _asked(config, cases, workers, own, found)
    _compared(rows, frames["observations"], found)
    if n < len(names):
        tenth = max(1, len(names) // 100)
        found.note(
            f"Repeated the answers for {n} of {len(names)} cases, selected with --ask-seed "
            f"{seed}. If {tenth} cases had altered answers, this would find one with the "
            f"probability {chance(len(names), tenth, n):.2f}."
        )


def chance(cases: int, altered: int, asked: int) -> float:
    """Probability that at least one of the altered cases is among those selected."""
    return 1 - math.comb(cases - altered, asked) / math.comb(cases, asked)


def _asked(config, cases, workers, own, found: Findings) -> list[dict]:
    rows, tasks = [], []
    for spec in config.asked:
        try:
            methods = registry.make(spec)
        except ValueError:
            found.note(
                f"The answers of {spec} were not repeated: it is not a method of this "
                "package (--trust)."
            )
            continue
        for m in methods:

            def lost(case, loss, label=m.label):
                return {
                    "case": case.id,
                    "method": label,
                    "status": loss.status,
                    "hit": None,
                    "time": math.nan,
                    "detail": loss.detail,
                }

            chunks = [cases[i : i + answering.CHUNK] for i in range(0, len(cases), answering.CHUNK)]
            tasks += [
                Task(answering.asker, (m.label, config), c, rows.extend, lost) for c in chunks
            ]
    total = sum(len(task.items) for task in tasks)
    seconds = config.build_seconds + config.query_seconds
    with tempfile.TemporaryDirectory() as folder, stage("repeat answers", total) as advance:
        run(tasks, workers, seconds, Path(folder, "log"), advance, own and partial(load_files, own))
    return rows


def _compared(rows, recorded: pd.DataFrame, found: Findings) -> None:
    before = {(r.case, r.method): r for r in recorded.itertuples()}
    loose = Counter()
    for row in rows:
        then = before.get((row["case"], row["method"]))
        if then is None:
            continue
        if row["status"] == "unsupported" != then.status and "install" in row["detail"]:
            found.note(f"The answers of {row['method']} were not repeated: {row['detail']}")
            continue
        found.asked += 1
        if _said(then.status, then.hit, then.time) == _said(row["status"], row["hit"], row["time"]):
            continue
        name = name_of(row["method"])
        if not registry.methods()[name].repeatable:
            loose[name] += 1
        else:
            found.refuse(
                f"{row['case']} and {row['method']}",
                f"recorded {_word(then.status, then.hit, then.time)}, but repeated "
                f"{_word(row['status'], row['hit'], row['time'])}",
            )
    for name, n in loose.items():
        found.note(
            f"{n} answers of {name} differ; its engine is not repeatable, so this proves nothing."
        )
    found.notes[:] = dict.fromkeys(found.notes)


def _said(status, hit, time):
    hit = None if pd.isna(hit) else bool(hit)
    return status, hit, None if pd.isna(time) else round(float(time) / SAME_TIME)


def _word(status, hit, time) -> str:
    if status != "ok":
        return str(status)
    return ("hit" if hit else "clear") + ("" if pd.isna(time) else f" at {time:.9g}")
