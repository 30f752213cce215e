# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Work in processes that may die: a crash or a hang costs only the item that caused it, and a
fault of the machine none.
"""

from __future__ import annotations

import random
import signal
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from .crew import RESUME, Crew, Worker
from .limits import limit, mark
from .machine import MachineError
from .worker import NO_CHANNEL, NO_MEMORY

__all__ = [
    "Instead",
    "Loss",
    "MachineError",
    "Task",
    "WorkerError",
    "limit",
    "mark",
    "mixed",
    "run",
]

MEMORY = 2 << 30  # bytes after which a worker is replaced; it can have at most twice as many
TRIES = 6  # of one item that ends its process in a new way each time
CODES = {NO_CHANNEL: "its results could not be sent", NO_MEMORY: "out of memory"}


class WorkerError(RuntimeError):
    """The project's own code failed in a worker; the message is the worker's traceback."""


@dataclass(frozen=True)
class Loss:
    """How an item was lost. status: "timeout" or "error". detail: a description. mark: the last
    limits.mark.
    """

    status: str
    detail: str
    mark: str = ""


@dataclass(frozen=True)
class Instead:
    """Returned by `Task.lost` to have this item processed, alone, in place of the lost one."""

    item: Any


@dataclass(frozen=True)
class Task:
    """One worker process: open(argument) gives a function, which is then called with each item in
    turn.

    done(results): called in the parent with one result per item, in order. lost(item, loss): makes
    the result of an item that ended its process, or an Instead.
    """

    open: Callable[[Any], Callable[[Any], Any]]
    argument: Any
    items: Sequence[Any]
    done: Callable[[list[Any]], None]
    lost: Callable[[Any, Loss], Any]


@dataclass
class _Job:
    """A task in progress. stage: "run" (all remaining items), "control", or "alone" (the next
    item). fates: how the processes of the next item ended.
    """

    task: Task
    items: list[Any]
    results: list[Any] = field(default_factory=list)
    stage: str = "run"
    fates: list[Loss] = field(default_factory=list)

    @property
    def undisturbed(self) -> bool:
        """None of our other processes shall run beside it: lack of memory or of the processor
        may have ended the last one.
        """
        return self.stage != "run" and self.fates[-1].detail in _OUTSIDE

    def settle(self, result: Any) -> None:
        """Record that the next item has its result."""
        if isinstance(result, Instead):
            self.items[len(self.results)], self.stage = result.item, "alone"
        else:
            self.results.append(result)
            self.stage = "run"
        self.fates = []


def mixed(tasks: Sequence[Task]) -> list[Task]:
    """The tasks in one fixed random order: slow ones are spread over the stage, so that its
    beginning predicts its duration.
    """
    return random.Random(0).sample(list(tasks), len(tasks))


def run(
    tasks: Sequence[Task],
    workers: int,
    seconds: float,
    log: Path,
    advance: Callable[[int], None] = lambda n: None,
    prepare: Callable[[], None] | None = None,
    memory: int = MEMORY,
) -> None:
    """Run all tasks, each in a fresh process, `workers` at a time. seconds: of processor time for
    one item (see limits). log: the output of processes. prepare: called first in each process.
    memory: bytes after which a worker is replaced; it can have at most twice as many. ValueError if
    a worker met bad input, WorkerError with its traceback if our own code fails, MachineError if
    the machine does.

    An item whose process dies, or passes the deadline, is tried again alone in a fresh process,
    after a trivial one that must succeed. Only the same death twice makes it lost. Exceeding a
    limit of processor time needs no second try. A fresh process for each task makes results
    independent of the number of workers: state that an engine leaves in its memory affects only
    later items of the same task. No library's pool does this: loky and concurrent.futures break as
    a whole when a worker dies; pebble names the task at which a worker died, but also broke when
    one died between tasks, in its engine's destructors, as some do.
    """
    queue = deque(_Job(task, list(task.items)) for task in tasks)
    with Crew(log) as crew:
        while queue or crew.busy:
            while queue and _may_start(queue[0], [w.job for w in crew.workers.values()], workers):
                job = queue.popleft()
                crew.start(job, _payload(job, prepare, seconds, memory))
            for worker, code in crew.wait():
                job, before = worker.job, len(worker.job.results)
                _conclude(job, worker, code)
                advance(len(job.results) - before)
                if len(job.results) < len(job.items):
                    queue.appendleft(job)
                else:
                    job.task.done(job.results)


def _may_start(job: _Job, running: list[_Job], workers: int) -> bool:
    if job.undisturbed:
        return not running
    return len(running) < workers and not any(other.undisturbed for other in running)


def _payload(
    job: _Job, prepare: Callable[[], None] | None, seconds: float, memory: int
) -> tuple[Any, ...]:
    if job.stage == "control":
        return None, _control, None, [2], seconds, memory
    left = job.items[len(job.results) :]
    return (
        prepare,
        job.task.open,
        job.task.argument,
        left if job.stage == "run" else left[:1],
        seconds,
        memory,
    )


def _control(_: None) -> Callable[[int], int]:
    return lambda item: 2 * item


def _conclude(job: _Job, worker: Worker, code: int | None) -> None:
    """Handle the end of a job's worker."""
    said = _said(worker)
    complete = bool(worker.frames) and worker.frames[-1][0] in ("end", "recycle")
    if job.stage == "control":
        if code is not None:
            _judge_control(job, complete and said == [4], worker, code)
        return
    if said:
        job.fates = []
    job.results += said
    if complete or code is None or len(job.results) == len(job.items):
        job.stage = "run" if said or not job.fates else job.stage
    elif job.stage == "alone" and said:
        job.stage = "run"
    else:
        _died(job, _fate(worker, code))


def _said(worker: Worker) -> list[Any]:
    """The results that it sent. Raises the error that it sent instead of one."""
    for kind, value in worker.frames:
        if kind == "refused":
            raise ValueError(value)
        if kind == "bug":
            raise WorkerError(value)
    return [value for kind, value in worker.frames if kind == "result"]


def _judge_control(job: _Job, succeeded: bool, worker: Worker, code: int) -> None:
    if not succeeded:
        raise MachineError(
            f"A process died ({job.fates[-1].detail}), and so did the next one, which had a "
            f"trivial task ({_fate(worker, code).detail}): the machine is at fault. {RESUME}"
        )
    job.stage = "alone"


_DEADLINE = "no answer by the deadline"
_OUTSIDE = (_DEADLINE, "SIGKILL", "SIGTERM", "SIGINT", "SIGHUP", "SIGBUS", CODES[NO_MEMORY])


def _fate(worker: Worker, code: int) -> Loss:
    """How a process ended, for its current item."""
    told = worker.page_mark
    if (
        worker.ended_for == "timeout"
        and worker.ended_at == worker.page_number
        or code == -signal.SIGPROF
    ):
        return Loss("timeout", "the limit for one item ran out", told)
    if worker.ended_for:
        return Loss("timeout", _DEADLINE, told)
    if code < 0:
        return Loss("error", _name(-code), told)
    return Loss("error", CODES.get(code, f"exit code {code}"), told)


def _name(number: int) -> str:
    try:
        return signal.Signals(number).name
    except ValueError:  # only two of the real-time signals have names
        return f"signal {number}"


def _died(job: _Job, fate: Loss) -> None:
    """Handle the death, in this way, of the process of the job's next item."""
    item = job.items[len(job.results)]
    if fate.status == "timeout" and fate.detail != _DEADLINE:
        job.settle(job.task.lost(item, fate))
    elif job.fates and job.fates[-1].detail == fate.detail:
        job.settle(job.task.lost(item, Loss(fate.status, _twice(fate.detail), fate.mark)))
    elif len(job.fates) + 1 == TRIES:
        ends = ", ".join(f.detail for f in (*job.fates, fate))
        raise MachineError(
            f"One item ended its process in a different way each time it was tried ({ends}). "
            f"{RESUME}"
        )
    else:
        job.fates.append(fate)
        job.stage = "control"


def _twice(detail: str) -> str:
    """'killed twice, alone: SIGSEGV'; a process that ended by an exit code was not killed."""
    killed = detail == _DEADLINE or detail.startswith(("SIG", "signal"))
    return f"{'killed' if killed else 'ended itself'} twice, alone: {detail}"
