"""From certified cases to observations: every method is asked every case, in processes that may die."""

from __future__ import annotations

import math
from functools import partial
from time import perf_counter
from typing import Callable

import pandas as pd

from baselines import registry
from baselines.contract import MissingEngine, Unsupported, Verdict

from . import origin, ownfile
from .case import Case
from .config import RunConfig, load_files
from .pool import Task, limit, mixed, run
from .progress import stage
from .rows import cases_of
from .store import Store

CHUNK = 256  # cases asked in one process: bounds what a leaking engine can hold
COLUMNS = ["case", "method", "status", "hit", "time", "detail"]
PACE = ["build_s", "query_s"]  # seconds, on a busy machine: good to plan the rest of the run by, and for nothing else
PACES = ("parts", "pace.parquet")


def ask(store: Store, config: RunConfig, workers: int, told: Callable[[str, list[dict]], None] = lambda label, rows: None) -> None:
    """Write observations.parquet, a row per case and method; shards that are there already are not made again.

    told(label, rows): called with the rows of each chunk of a method, with their PACE, when it is done.
    """
    cases = [case for case, _ in cases_of(store.read("cases.parquet"), store.read("bodies.parquet"))]
    methods = [m for spec in config.asked for m in registry.make(spec)]
    chunks = [cases[i:i + CHUNK] for i in range(0, len(cases), CHUNK)]
    facts = {"cases": store.digest("cases.parquet"), "limits": [config.build_seconds, config.query_seconds],
             "own": ownfile.digests(config.method_files)}
    tasks, names = [], []
    for method in methods:
        for chunk in chunks:
            names.append(store.shard("observations", **facts, **origin.facts(method.engine), method=method.label, chunk=[case.id for case in chunk]))
            if not names[-1].ready():
                tasks.append(_task(store, config, method, chunk, names[-1], told))
            else:
                told(method.label, store.read(names[-1]).to_dict("records"))
    total = len(cases) * len(methods)
    with stage("ask methods", total, total - sum(len(t.items) for t in tasks)) as advance:
        run(mixed(tasks), workers, config.build_seconds + config.query_seconds, store.path("workers.log"), advance, partial(load_files, config))
    rows = pd.concat([store.read(name) for name in names], ignore_index=True)
    store.write(rows[["case", "method", *PACE]], *PACES)
    store.write(rows[COLUMNS], "observations.parquet")


def _task(store: Store, config: RunConfig, method, chunk: list[Case], name, told) -> Task:
    def done(rows):
        told(method.label, rows)
        frame = pd.DataFrame(rows, columns=COLUMNS + PACE).astype({"hit": "boolean"})
        store.write(frame, name)

    def lost(case, status, detail):
        return _row(case, method.label, status, detail=detail)

    return Task(_open, (method.label, config), chunk, done, lost)


def _open(argument: tuple[str, RunConfig]):
    spec, config = argument
    try:
        (method,) = registry.make(spec)
        reason = registry.available(type(method))
    except MissingEngine as error:
        reason = str(error)
    if reason:
        return lambda case: _row(case, spec, "unsupported", detail=reason)
    return lambda case: answer(method, case, config)


def answer(method, case: Case, config: RunConfig) -> dict:
    """The observation row of one method at one case. An exception of the engine is its answer: status `error`."""
    try:
        start = perf_counter()
        with limit(config.build_seconds):
            ask_it = method.ready(case.query)
        built = perf_counter()
        with limit(config.query_seconds):
            verdict = ask_it()
        pace = {"build_s": built - start, "query_s": perf_counter() - built}
    except Unsupported as refusal:
        return _row(case, method.label, "unsupported", detail=str(refusal))
    except MissingEngine as missing:
        return _row(case, method.label, "unsupported", detail=str(missing))
    except Exception as error:
        return _row(case, method.label, "error", detail=f"{type(error).__name__}: {str(error).splitlines()[0] if str(error) else ''}"[:200])
    if not isinstance(verdict, Verdict):
        return _row(case, method.label, "error", detail=f"returned {type(verdict).__name__}, not a Verdict (of baselines.contract)")
    time = float(verdict.time)
    if not math.isnan(time) and not 0 <= time <= 1:
        return _row(case, method.label, "error", detail=f"time of impact {time!r} is outside the step [0, 1]")
    return {**_row(case, method.label, "ok", bool(verdict.hit), time if verdict.hit else math.nan), **pace}


def _row(case: Case, method: str, status: str, hit=None, time=math.nan, detail="") -> dict:
    return {"case": case.id, "method": method, "status": status, "hit": hit, "time": time, "detail": detail}
