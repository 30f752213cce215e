# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""From certified cases to observations: every method answers every case, in worker processes
that may crash.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from time import perf_counter

import pandas as pd

from baselines import registry
from baselines.contract import Method, MissingEngine, Unsupported, Verdict, checked
from experiments.cases.case import Case

from . import ownfile, words
from .config import RunConfig, load_files
from .folder import origin
from .folder.rows import Row, cases_of
from .folder.shard import Shard
from .folder.store import Store
from .processes.pool import Loss, Task, limit, mixed, run
from .progress import stage

CHUNK = 256  # cases answered in one process: bounds the memory that a leaking engine can take
COLUMNS = ["case", "method", "status", "hit", "time", "detail"]
# seconds, on a busy machine: used only to estimate the remaining time of the run
PACE = [
    "build_s",
    "query_s",
]
PACES = ("parts", "pace.parquet")
Told = Callable[[str, list[Row]], None]  #: see ask


def ask(
    store: Store,
    config: RunConfig,
    workers: int,
    told: Told = lambda label, rows: None,
) -> None:
    """Write observations.parquet, a row per case and method; existing shards are not made again.

    told(label, rows): called with the rows of each finished chunk of a method, with their PACE.
    """
    cases = [
        case for case, _ in cases_of(store.read("cases.parquet"), store.read("bodies.parquet"))
    ]
    methods = [m for spec in config.asked for m in registry.make(spec)]
    chunks = [cases[i : i + CHUNK] for i in range(0, len(cases), CHUNK)]
    facts = {
        "cases": store.digest("cases.parquet"),
        "limits": [config.build_seconds, config.query_seconds],
        "own": ownfile.digests(config.method_files),
    }
    tasks, names = [], []
    for method in methods:
        for chunk in chunks:
            names.append(
                store.shard(
                    "observations",
                    **facts,
                    **origin.facts(method.engine),
                    method=method.label,
                    chunk=[case.id for case in chunk],
                )
            )
            if not names[-1].ready():
                tasks.append(_task(store, config, method, chunk, names[-1], told))
            else:
                told(method.label, store.read(names[-1]).to_dict("records"))
    total = len(cases) * len(methods)
    with stage("ask methods", total, total - sum(len(t.items) for t in tasks)) as advance:
        run(
            mixed(tasks),
            workers,
            config.build_seconds + config.query_seconds,
            store.path("workers.log"),
            advance,
            partial(load_files, config),
        )
    rows = pd.concat([store.read(name) for name in names], ignore_index=True)
    store.write(rows[["case", "method", *PACE]], *PACES)
    store.write(rows[COLUMNS], "observations.parquet")


def _task(
    store: Store, config: RunConfig, method: Method, chunk: list[Case], name: Shard, told: Told
) -> Task:
    def done(rows: list[Row]) -> None:
        told(method.label, rows)
        frame = pd.DataFrame(rows, columns=COLUMNS + PACE).astype({"hit": "boolean"})
        store.write(frame, name)

    def lost(case: Case, loss: Loss) -> Row:
        return row(case, method.label, loss.status, detail=loss.detail)

    return Task(asker, (method.label, config), chunk, done, lost)


def asker(argument: tuple[str, RunConfig]) -> Callable[[Case], Row]:
    spec, config = argument
    try:
        (method,) = registry.make(spec)
        reason = registry.available(type(method))
    except MissingEngine as error:
        reason = words.text_of(error)
    except BaseException as error:  # its constructor is part of the method too
        reason = words.of_error(error)
        return lambda case: row(case, spec, "error", detail=reason)
    if reason:
        return lambda case: row(case, spec, "unsupported", detail=reason)
    return lambda case: answer(method, case, config, spec)


def answer(method: Method, case: Case, config: RunConfig, label: str | None = None) -> Row:
    """The observation row of one method for one case. Whatever it raises becomes its answer: status
    `error`.

    label: the method's, if known; a method may change its own while it runs.
    """
    label = label or method.label
    try:
        start = perf_counter()
        with limit(config.build_seconds):
            ask_it = method.ready(case.query)
        built = perf_counter()
        with limit(config.query_seconds):
            said = ask_it()
        pace = {"build_s": built - start, "query_s": perf_counter() - built}
        verdict = _checked(said)
    except (Unsupported, MissingEngine) as refusal:
        return row(case, label, "unsupported", detail=words.text_of(refusal))
    except _Unclear as unclear:
        return row(case, label, "error", detail=str(unclear))
    except BaseException as error:  # SystemExit and pyo3's panics do not derive from Exception
        return row(case, label, "error", detail=words.of_error(error))
    return {**row(case, label, "ok", verdict.hit, verdict.time), **pace}


class _Unclear(Exception):
    """A method returned an invalid answer; the message gives the reason."""


def _checked(said: object) -> Verdict:
    try:
        return checked(said)
    except (TypeError, ValueError) as error:
        raise _Unclear(words.text_of(error)) from error


def row(
    case: Case,
    method: str,
    status: str,
    hit: bool | None = None,
    time: float = math.nan,
    detail: str = "",
) -> Row:
    return {
        "case": case.id,
        "method": method,
        "status": status,
        "hit": hit,
        "time": time,
        "detail": detail,
    }
