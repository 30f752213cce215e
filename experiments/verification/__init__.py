# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Verify that a run matches its configuration: files, rows, cases, labels and, on request,
answers.
"""

from __future__ import annotations

import os

from experiments.run.config import load_files
from experiments.run.folder.store import Store

from . import answers, cases, files, pieces, rows
from .findings import Findings


def verify(
    store: Store,
    ask: int | None = None,
    trust: bool = False,
    workers: int | None = None,
    seed: int | None = None,
) -> Findings:
    """Check a finished run. ask: repeat the methods' answers for this many random cases (-1:
    all). trust: run the Python files named by its configuration. Writes nothing into the folder.
    """
    found, config = Findings(), store.config
    files.check(store, found)
    rows.name_preset(config, found)
    if config.stepping:
        found.note("The stepping track has no certified labels: only its files are checked.")
        return found
    if trust:
        load_files(config)
    workers = workers or os.cpu_count() or 1
    frames = rows.read(store, found)
    if frames is None:
        return found
    slots = rows.expected(config, frames["cases"], found)
    sound = rows.check(config, frames, slots, found)
    own = config if trust else None
    cases.check(store, config, slots, sound, workers, own, found)
    pieces.check(config, frames, sound, workers, found)
    if ask is not None:
        answers.check(config, frames, sound, ask, seed, workers, own, found)
    return found
