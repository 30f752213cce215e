# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The stepping track as an experiment: a run folder with stepping.parquet in place of cases and
observations.
"""

from __future__ import annotations

from functools import partial

import pandas as pd

from experiments.run.config import ConfigError, RunConfig, SteppingChoice, closest, load_files
from experiments.run.folder import origin
from experiments.run.folder.store import Store
from experiments.run.processes.pool import Task, mixed, run
from experiments.run.progress import forecast, stage

from . import track
from .scene import SCENES, TRAVELS

COLUMNS = [
    "scene",
    "contestant",
    "travel",
    "runs",
    "tunnelled",
    "share",
    "low",
    "high",
    "us_per_step",
    "detail",
]
SECONDS = 600.0  # for one contestant in one scene


def check(choice: SteppingChoice) -> None:
    """ConfigError for an unknown scene."""
    known = [s.name for s in SCENES]
    for name in choice.scenes:
        if name not in known:
            raise ConfigError(
                f"stepping.scenes: there is no scene '{name}'{closest(name, known)}; the scenes "
                f"are {', '.join(known)}."
            )


def measure(store: Store, config: RunConfig) -> None:
    """Write stepping.parquet, a row per scene, contestant and travel, one process after another,
    because steps are also timed.

    A contestant whose engine is absent, or dies, has one row with the reason and no counts.
    """
    choice = config.stepping
    cells = [
        (s, c) for s in SCENES if s.name in (choice.scenes or [s.name]) for c in track.CONTESTANTS
    ]
    facts = {"seed": config.seed, "choice": choice.model_dump()}
    names = [
        store.shard(
            "stepping",
            **facts,
            **origin.facts(track.method_of(c).engine),
            scene=s.name,
            contestant=c.name,
        )
        for s, c in cells
    ]
    tasks = [
        _task(store, config, cell, name) for cell, name in zip(cells, names) if not name.ready()
    ]
    with forecast({"step": 0.0}), stage("step", len(cells), len(cells) - len(tasks)) as advance:
        run(
            mixed(tasks),
            1,
            SECONDS,
            store.path("workers.log"),
            advance,
            partial(load_files, config),
        )
    store.write(
        pd.concat([store.read(name) for name in names], ignore_index=True), "stepping.parquet"
    )


def _task(store: Store, config: RunConfig, cell, name) -> Task:
    scene, contestant = (thing.name for thing in cell)

    def done(results):
        store.write(
            pd.DataFrame(results[0], columns=COLUMNS).astype(
                {"runs": "Int64", "tunnelled": "Int64"}
            ),
            name,
        )

    return Task(
        _open,
        config,
        [(scene, contestant)],
        done,
        lambda item, loss: [_nothing(*item, f"{loss.status}: {loss.detail}")],
    )


def _open(config: RunConfig):
    return lambda item: _cells(*item, config)


def _cells(scene: str, contestant: str, config: RunConfig) -> list[dict]:
    chosen = next(c for c in track.CONTESTANTS if c.name == contestant)
    if reason := track.absent(chosen):
        return [_nothing(scene, contestant, reason)]
    scenes = [s for s in SCENES if s.name == scene]
    return [
        {**row, "detail": ""}
        for row in track.measure(
            [chosen], scenes, config.stepping.travels or TRAVELS, config.stepping.runs, config.seed
        )
    ]


def _nothing(scene: str, contestant: str, reason: str) -> dict:
    return {
        "scene": scene,
        "contestant": contestant,
        "travel": float("nan"),
        "runs": None,
        "tunnelled": None,
        "detail": reason,
    }
