# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The undisturbed run, with which all others are compared."""

from __future__ import annotations

import time
from dataclasses import replace
from pathlib import Path

from . import kin
from .command import Attempt, Bench
from .outcome import misconduct, sums


class Undrillable(RuntimeError):
    """The undisturbed run itself failed; the message gives the reason."""


def undisturbed(bench: Bench, place: Path) -> tuple[Bench, Path]:
    """The bench with the measurements of an undisturbed run, and the folder of that run.

    Raises Undrillable if it does not finish.
    """
    attempt = Attempt(bench, place)
    running, seen = attempt.start(), []
    while not running.over:
        if running.below(kin.WORKER):
            seen.append(running.age)
        time.sleep(0.01)
    ending = running.finish(bench.patience)
    if ending.code != 0 or misconduct(ending):
        raise Undrillable(
            f"The undisturbed run of {bench.config.name} did not finish (exit code "
            f"{ending.code}): {misconduct(ending) or ending.reason}"
        )
    found = sums(attempt.folder)
    if "missing" in found:
        raise Undrillable(f"The undisturbed run of {bench.config.name} left no files of accuracy.")
    size = sum(p.stat().st_size for p in attempt.folder.rglob("*") if p.is_file())
    busy = (seen[0], seen[-1]) if seen else (0.0, ending.seconds)
    return replace(bench, seconds=ending.seconds, busy=busy, sums=found, size=size), attempt.folder
