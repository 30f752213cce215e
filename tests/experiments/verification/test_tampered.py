# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""200 run folders with one cell altered by chance and every hash recomputed."""

from __future__ import annotations

import numpy as np

from experiments.run.folder.store import Store
from experiments.verification import cases, rows, verify

from .test_forgery import ASKED, SILENT, forged, run  # noqa: F401 (run is a fixture)

TABLES = {"cases": rows.CASES, "bodies": rows.BODIES, "observations": rows.ANSWERS}


def here(tasks, workers, seconds, log, advance, prepare=None):
    """The pool's work in this process: 200 folders need no 200 forks."""
    for task in tasks:
        answer = task.open(task.argument)
        task.done([answer(item) for item in task.items])


def altered(rng, value):
    """Another value of the same type, by far enough to be no other build's rounding."""
    value = value.tolist() if hasattr(value, "tolist") else value
    if isinstance(value, bool):
        return not value
    if isinstance(value, int):
        return value + int(rng.integers(1, 5))
    if isinstance(value, float):
        return 0.5 if np.isnan(value) or value == 0 else value * (1 + rng.choice([1e-4, -0.3, 5.0]))
    if isinstance(value, list):
        i = int(rng.integers(len(value)))
        return np.array([*value[:i], altered(rng, value[i]), *value[i + 1 :]])
    at = int(rng.integers(len(value))) if value else 0
    return value[:at] + rng.choice(["\u0000", "7", "{", "z"]) + value[at + 1 :]


def test_a_cell_altered_by_chance_is_found_or_proves_the_same(run, tmp_path, monkeypatch):  # noqa: F811
    monkeypatch.setattr(cases, "run", here)
    rng, missed = np.random.default_rng(12), []
    for i in range(200):
        table = str(rng.choice(list(TABLES)))
        loose = (*SILENT.get(table, ()), *(ASKED if table == "observations" else ()))
        column = str(rng.choice([c for c in TABLES[table] if c not in loose]))
        told = []

        def change(frame):
            at = int(rng.integers(len(frame)))
            old = frame[column].iloc[at]
            new = altered(rng, old)
            frame[column] = [new if k == at else v for k, v in enumerate(frame[column])]
            told.append((table, column, at, str(old)[:60], str(new)[:60], cases.same(old, new)))

        store = forged(run, tmp_path / str(i), change, table)
        if verify(store, workers=1).ok and not told[0][-1] and column != "certificate":
            missed.append(told[0])
    assert not missed
    assert verify(Store(run), workers=1).ok
