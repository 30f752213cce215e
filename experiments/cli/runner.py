# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Run a configuration in one folder: scenarios -> certified cases -> observations -> times ->
tables and figures.
"""

from __future__ import annotations

import json
import math
import os
import shutil
import statistics
from pathlib import Path

import pandas as pd

from baselines import registry
from experiments.analysis import outcome, tables
from experiments.analysis.plots import curves, figures
from experiments.cases import families
from experiments.publish.report import report as html_report
from experiments.run import (
    answering,
    declared,
    decomposing,
    labelling,
    ownfile,
    progress,
    timing,
)
from experiments.run.bins import situation_of, size_of
from experiments.run.config import ConfigError, RunConfig
from experiments.run.folder import manifest, origin
from experiments.run.folder.store import Store, StoreError
from experiments.run.progress import say
from experiments.studies.stepping import experiment as stepping
from ofg import decomposition, piecefile

from . import entries

# Seconds per label, per process that imports an engine, per case and method, and per timed call.
# They serve only as the first estimate of the time left.
LABEL_SECONDS, PROCESS_SECONDS, ASK_SECONDS, CALL_SECONDS = 0.06, 0.5, 0.003, 0.0003


def run(
    config: RunConfig, folder: Path, workers: int | None = None, skip_missing: bool = False
) -> list[tables.Table]:
    """Run `config` in `folder`, or resume an unfinished run there; returns its tables. Raises
    ConfigError or StoreError.
    """
    entries.check(config)
    absent = missing(config.methods)
    if absent and not skip_missing:
        raise ConfigError(
            "An engine that this run needs is not installed. "
            + " ".join(absent)
            + " To leave its rows empty, use --skip-missing."
        )
    store = Store(folder)
    sound = _config_as_recorded(store)
    with store.held(config):
        if "finished" in facts(store):
            if sound:  # titles may have been reworded; a configuration changed by hand stays found
                hashes = facts(store)["sha256"]
                new = manifest.digest(store.folder / "config.json")
                note(store, sha256={**hashes, "config.json": new})
            made = report(store)
            shutil.rmtree(store.folder / "parts", ignore_errors=True)
            say(f"The run in {folder} is already finished; only its tables were rebuilt.")
            return made
        begin(store, config)
        return finish(store, config, workers or os.cpu_count() or 1)


def _config_as_recorded(store: Store) -> bool:
    """Whether config.json is the file that the manifest of a finished run recorded."""
    try:
        recorded = facts(store).get("sha256", {}).get("config.json")
        return recorded == manifest.digest(store.folder / "config.json")
    except (
        OSError,
        ValueError,
        StoreError,
    ):  # no run yet, or one whose damage `held` repairs or names
        return False


def begin(store: Store, config: RunConfig) -> None:
    """Record code, versions and machine in manifest.json. Parts that an unfinished run made with
    different code have a different key and are not used.
    """
    before, code = facts(store), origin.code()
    if before and before.get("code") != code:
        say(
            f"The run in {store.folder} was started with a different version of the code; its"
            " finished parts are computed again."
        )
    own = dict(
        zip(ownfile.copies(config), ownfile.digests(config.method_files + config.scenario_files))
    )
    note(
        store,
        started=before.get("started", manifest.now()),
        commit=manifest.commit(),
        code=code,
        versions=manifest.versions(config),
        build=manifest.build(),
        before=manifest.machine(),
        **({"own_files": own} if own else {}),
        **declared.of(config),
    )
    if lost := piecefile.fault(decomposition.cache_folder()):
        say(lost)


def finish(store: Store, config: RunConfig, workers: int) -> list[tables.Table]:
    """Run the stages that are not finished yet, then build the tables."""
    if config.stepping:
        stepping.measure(store, config)
        more = {}
    else:
        with progress.forecast(plan(config, workers)) as forecast:
            labelling.make_cases(store, config, workers)
            decomposing.make(store, config, workers)
            answering.ask(store, config, workers, Paces(store, config, workers, forecast).told)
            timing.measure(store, config)
        more = {"workers": workers, "halfway": halfway(forecast)}
    if changed := ownfile.changed(config, store.folder):
        raise StoreError(changed)
    note(
        store,
        finished=manifest.now(),
        after=manifest.machine(),
        sha256=manifest.hashes(store.folder),
        **more,
    )
    made = report(store)
    shutil.rmtree(store.folder / "parts", ignore_errors=True)
    return made


def report(store: Store) -> list[tables.Table]:
    """Write tables/, figures/ and report.html from the rows of the run. A stepping run has no
    figures and no report.
    """
    made = list(tables.build(store))
    tables.save(store, made)
    curves.save(store, made)
    if store.has("timings.parquet"):
        figures.accuracy_speed(store)
    if store.has("observations.parquet"):
        outcome.save(store)
        html_report(store, made)
    return made


def plan(config: RunConfig, workers: int) -> dict[str, float]:
    """First estimate of the seconds that each stage will take, from the times of the experiments on
    one machine.
    """
    cases, methods = (
        len(labelling.slots(config)),
        sum(len(registry.make(spec)) for spec in config.asked),
    )
    processes = methods * math.ceil(cases / answering.CHUNK)
    bins = (
        3 * len({families.get(c.name).question for c in config.scenarios})
        if config.timing.cases
        else 0
    )
    calls = (
        min(cases, bins * config.timing.cases)
        * methods
        * (config.timing.rounds + config.timing.warmup)
    )
    return {
        "certify cases": LABEL_SECONDS * cases / workers,
        "ask methods": (PROCESS_SECONDS * processes + ASK_SECONDS * cases * methods) / workers,
        "time methods": 3 * timing.START * bins + CALL_SECONDS * calls,
    }


class Paces:
    """Update the forecast of the time left for answers and timing after each chunk of answers."""

    def __init__(self, store: Store, config: RunConfig, workers: int, forecast: progress.Forecast):
        self.config, self.workers, self.forecast, self.begun = config, workers, forecast, None
        cases = store.read("cases.parquet").assign(
            situation=situation_of, faces=lambda c: size_of(c.faces)
        )
        self.question = dict(zip(cases.case, cases.question))
        bins = (
            cases[cases.label != "uncertain"]
            .groupby(["question", "faces", "situation"], observed=True)
            .size()
            .clip(upper=config.timing.cases)
        )
        self.bins = (
            {question: list(sizes) for question, sizes in bins.groupby(level="question")}
            if config.timing.cases
            else {}
        )
        self.left = {m.label: len(cases) for spec in config.asked for m in registry.make(spec)}
        self.paces: dict[str, pd.DataFrame] = {}

    def told(self, label: str, rows: list[dict]) -> None:
        limit = self.config.query_seconds
        pace = pd.DataFrame(
            [
                {
                    "question": self.question[r["case"]],
                    **{c: r.get(c, math.nan) for c in answering.PACE},
                    "seconds": limit if r["status"] == "timeout" else 0.0,
                }
                for r in rows
            ]
        )
        pace["seconds"] += (
            pace.build_s.fillna(0.0) + pace.query_s.fillna(0.0) + PROCESS_SECONDS / answering.CHUNK
        )
        self.paces[label] = pd.concat([self.paces[label], pace]) if label in self.paces else pace
        self.left[label] -= len(rows)
        known = {name: own.seconds.mean() for name, own in self.paces.items()}
        # the median, as one slow method is no guide to those that have not answered yet
        other = statistics.median(known.values())
        asking = sum(n * known.get(name, other) for name, n in self.left.items()) / self.workers
        self.forecast.foresee("ask methods", asking)
        calls = sum(map(sum, self.bins.values())) * (
            self.config.timing.rounds + self.config.timing.warmup
        )
        unknown = (len(self.left) - len(known)) * CALL_SECONDS * calls
        self.forecast.foresee(
            "time methods", timing.foresee(self.bins, self.paces, self.config.timing) + unknown
        )


def halfway(forecast: progress.Forecast) -> dict | None:
    """For the manifest: the forecast and the actual seconds left halfway through the run."""
    found = forecast.at_half()
    return found and {"said_left": round(found[0], 1), "was_left": round(found[1], 1)}


def missing(specs: tuple[str, ...]) -> list[str]:
    """One sentence per engine that is needed but not installed. Raises for an unknown method."""
    classes = {type(m) for spec in specs for m in registry.make(spec)}
    return sorted({reason for cls in classes if (reason := registry.available(cls))})


def facts(store: Store) -> dict:
    """The contents of manifest.json."""
    return store.facts


def note(store: Store, **more) -> None:
    """Add facts to manifest.json."""
    store.write_text(json.dumps({**facts(store), **more}, indent=1) + "\n", "manifest.json")
