# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The faults of a machine, each a function that runs one command and injects the fault at a
random time.
"""

from __future__ import annotations

import math
import os
import signal
import time
from collections.abc import Callable
from dataclasses import dataclass
from random import Random

import psutil

from . import kin, volume
from .command import Attempt, Ending, Running
from .outcome import FAILED, Outcome, misconduct, settle

PAUSE = 6.0  # seconds of a SIGSTOP: more than any limit of drill.toml
ROOM = 1 << 28  # bytes of a disk with free space again
Strike = Callable[[Attempt, Random], Outcome]
LEAST = 4096  # bytes of the smallest disk: one page


class Missed(Exception):
    """The run ended before the fault struck: another time has to be drawn."""


@dataclass(frozen=True)
class Fault:
    """strike: injects the fault into one attempt. rare: tried a fifth as often. seconds: added
    duration of a run, for the forecast.
    """

    name: str
    strike: Strike
    rare: bool = True
    seconds: float = 0.0
    note: Callable[[], str] = lambda: ""


def undisturbed(attempt: Attempt, random: Random) -> Outcome:
    """No fault, and one worker: a difference here does not come from a fault of the machine."""
    attempt.workers = 1
    return settle(attempt, attempt.say())


def signalled(number: int, halts: set[int]) -> Strike:
    """The runner gets a signal: alone, or with its process group, as a terminal sends it."""

    def strike(attempt: Attempt, random: Random) -> Outcome:
        running = attempt.start()
        struck = running.reach(random.uniform(0.02, attempt.bench.seconds))
        while number == signal.SIGINT and struck and not attempt.folder.exists():
            # Python itself prints a traceback during its start; nothing is begun before the folder
            time.sleep(0.01)
            struck = not running.over
        if struck:
            (os.killpg if number == signal.SIGINT else os.kill)(running.process.pid, number)
        ending = running.finish(attempt.bench.patience)
        if not struck:
            raise Missed
        return settle(attempt, ending, frozenset(halts))

    return strike


def killed(role: str) -> Strike:
    """kill -9 of one process of a role."""

    def strike(attempt: Attempt, random: Random) -> Outcome:
        running = attempt.start()
        struck = _at_one(running, role, attempt, random, "kill")
        ending = running.finish(attempt.bench.patience)
        if not struck:
            raise Missed
        return settle(attempt, ending)

    return strike


def stopped(role: str | None) -> Strike:
    """SIGSTOP for longer than a limit, then SIGCONT. role: of one process, "" of the runner,
    None of all at once.
    """

    def strike(attempt: Attempt, random: Random) -> Outcome:
        running = attempt.start()
        if role:
            struck = _at_one(running, role, attempt, random, "suspend")
        else:
            running.reach(random.uniform(0.02, attempt.bench.seconds))
            chosen = running.everything() if role is None else running.runner()
            struck = [p for p in chosen if kin.send(p, "suspend")]
        if struck:
            running.reach(running.age + PAUSE)
            for process in struck:
                kin.send(process, "resume")
        ending = running.finish(attempt.bench.patience)
        if not struck:
            raise Missed
        return settle(attempt, ending)

    return strike


def _at_one(
    running: Running, role: str, attempt: Attempt, random: Random, what: str
) -> list[psutil.Process]:
    """Apply `what` to the first process of the role that exists after a random time; [] if none
    appears.
    """
    running.reach(random.uniform(*attempt.bench.busy))
    while not running.over:
        found = running.below(role)
        if found and kin.send(chosen := random.choice(found), what):
            return [chosen]
    return []


def full_disk(attempt: Attempt, random: Random) -> Outcome:
    """The disk of the run folder has too little room; then it gets room, and the command is
    repeated.
    """
    size = _drawn(random, 4 * LEAST, attempt.bench.size)
    if not volume.mountable():
        return _short_files(attempt, max(size, 1 << 15))
    with volume.small(attempt.disk, size):
        ending = attempt.say()
        volume.resize(attempt.disk, ROOM)
        return settle(attempt, ending)


def full_temporary(attempt: Attempt, random: Random) -> Outcome:
    """TMPDIR has too little room, from a single page upwards."""
    size = _drawn(random, LEAST, 1 << 18)
    if not volume.mountable():
        return _short_files(attempt, max(size, 1 << 15))
    with volume.small(attempt.temporary, size):
        ending = attempt.say()
        volume.resize(attempt.temporary, ROOM)
        return settle(attempt, ending)


def _short_files(attempt: Attempt, size: int) -> Outcome:
    running = attempt.start()
    running.limit(psutil.RLIMIT_FSIZE, size)
    return settle(attempt, running.finish(attempt.bench.patience))


def _drawn(random: Random, least: int, most: int) -> int:
    """A log-uniform number of bytes, in whole pages."""
    size = math.exp(random.uniform(math.log(least), math.log(max(most, 2 * least))))
    return int(size) // LEAST * LEAST


def read_only(attempt: Attempt, random: Random) -> Outcome:
    """The run is killed, its disk is read-only when the command is repeated, and then writable."""
    running = attempt.start()
    if running.reach(random.uniform(0.02, attempt.bench.seconds)):
        running.process.kill()
    if bad := misconduct(running.finish(attempt.bench.patience)):
        return Outcome(FAILED, bad)
    with volume.read_only(attempt.disk):
        ending = attempt.say()
    # a folder that is not writable may be the user's mistake, whose exit code is 2
    honest = (
        Ending(1, ending.text, ending.orphans) if ending.code == 2 and ending.reason else ending
    )
    return settle(attempt, honest)


def two_runners(attempt: Attempt, random: Random) -> Outcome:
    """The same command is started a second time during the run: the second is refused, or has
    nothing to do.
    """
    first = attempt.start()
    if not first.reach(random.uniform(0.0, attempt.bench.seconds)):
        first.finish(attempt.bench.patience)
        raise Missed
    second = attempt.start()
    endings = first.finish(attempt.bench.patience), second.finish(attempt.bench.patience)
    for name, ending in zip(("first", "second"), endings):
        if bad := misconduct(ending):
            return Outcome(FAILED, f"the {name} runner: {bad}")
        if ending.code not in (0, 1, 2) or not ending.reason:
            return Outcome(FAILED, f"the {name} runner: exit code {ending.code}: {ending.reason}")
    if all(ending.code for ending in endings):
        return Outcome(FAILED, f"both runners were refused: {endings[0].reason}")
    return settle(attempt, next(e for e in endings if not e.code))


def _how() -> str:
    return "a tmpfs" if volume.mountable() else "RLIMIT_FSIZE, because nothing can be mounted here"


FAULTS = (
    Fault("undisturbed", undisturbed),
    Fault("kill -9 of the runner", signalled(signal.SIGKILL, {-signal.SIGKILL}), rare=False),
    Fault("kill -9 of a worker", killed(kin.WORKER), rare=False),
    Fault("kill -9 of the fork server", killed(kin.SERVER), rare=False),
    Fault(
        "SIGTERM of the runner", signalled(signal.SIGTERM, {-signal.SIGTERM, 128 + signal.SIGTERM})
    ),
    Fault("SIGINT of the runner", signalled(signal.SIGINT, {-signal.SIGINT, 128 + signal.SIGINT})),
    Fault("SIGSTOP of a worker", stopped(kin.WORKER), seconds=PAUSE),
    Fault("SIGSTOP of the runner", stopped(""), seconds=PAUSE),
    Fault("SIGSTOP of all", stopped(None), seconds=PAUSE),
    Fault("full run disk", full_disk, note=_how),
    Fault("full TMPDIR", full_temporary, note=_how),
    Fault(
        "read-only run folder",
        read_only,
        note=lambda: (
            "a read-only mount"
            if volume.mountable()
            else "modes, because nothing can be mounted here"
        ),
    ),
    Fault("two runners", two_runners),
)
