"""Work in processes that may die: a crash or a hang costs the one item it happened at."""

from __future__ import annotations

import contextlib
import faulthandler
import io
import multiprocessing
import os
import pickle
import random
import resource
import signal
import tempfile
import traceback
from collections import deque
from dataclasses import dataclass
from multiprocessing.connection import wait
from pathlib import Path
from typing import Any, Callable, Sequence

# Imported once in the process that all workers are forked from; without it each worker takes a second to start. No engine is among them.
PRELOAD = ["experiments.cli", "experiments.labelling", "experiments.answering", "experiments.timing", "experiments.truth"]
# A process that the watchdog of `limit` ends leaves with this code (faulthandler calls _exit(1)).
WATCHDOG_EXIT = 1
RECYCLE_EXIT = 75  # of a worker that has grown past its memory: it loses nothing, the rest goes on in a fresh one
MEMORY = 4 << 30  # bytes a worker may hold


class WorkerError(RuntimeError):
    """Our own code failed in a worker; the message is the worker's traceback."""


@dataclass(frozen=True)
class Task:
    """One worker process: open(argument) gives a function, which is then called with each item in turn.

    done(results): called in the parent with one result per item, in order. lost(item, status, detail): makes the result of an
    item at which the process died ("error") or hung ("timeout").
    """

    open: Callable[[Any], Callable[[Any], Any]]
    argument: Any
    items: Sequence[Any]
    done: Callable[[list], None]
    lost: Callable[[Any, str, str], Any]


@contextlib.contextmanager
def limit(seconds: float):
    """End this process if the block takes longer. Works while native code holds the interpreter lock, unlike a signal handler."""
    faulthandler.dump_traceback_later(seconds, exit=True, file=_null())
    try:
        yield
    finally:
        faulthandler.cancel_dump_traceback_later()


def mixed(tasks: Sequence[Task]) -> list[Task]:
    """The tasks in an order drawn once for all: slow ones are spread over the stage, so that its beginning tells how long it will take."""
    return random.Random(0).sample(list(tasks), len(tasks))


def run(tasks: Sequence[Task], workers: int, seconds: float, log: Path, advance: Callable[[int], None] = lambda n: None,
        prepare: Callable[[], None] | None = None, memory: int = MEMORY) -> None:
    """Run all tasks, each in a fresh process, `workers` at a time. seconds: limit for one item. log: what processes print.
    prepare: called first in each process. memory: bytes after which a worker is replaced. ValueError where a worker
    met bad input, WorkerError with its traceback where our own code fails.

    A fresh process for each task makes results independent of the number of workers: what an engine leaves in its memory
    is seen by the later items of the same task alone. No pool of a library does this: loky and concurrent.futures break as a
    whole when a worker dies; pebble names the task a worker died at, but broke too when one died between tasks, in its
    engine's destructors, as some do.
    """
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(PRELOAD)
    queue, running = deque((task, []) for task in tasks), {}
    with tempfile.TemporaryDirectory() as folder:
        try:
            while queue or running:
                while queue and len(running) < workers:
                    task, before = queue.popleft()
                    journal = Path(folder, f"{id(task)}-{len(before)}")
                    process = context.Process(target=_work, args=(prepare, task.open, task.argument, task.items[len(before):], seconds, memory, journal, log))
                    process.start()
                    running[process.sentinel] = process, task, before, journal
                for sentinel in wait(running):
                    process, task, before, journal = running.pop(sentinel)
                    process.join()
                    results = before + _read(journal)
                    recycled = process.exitcode == RECYCLE_EXIT and len(results) > len(before)
                    if len(results) < len(task.items) and not recycled:
                        results.append(task.lost(task.items[len(results)], *_death(process.exitcode)))
                    advance(len(results) - len(before))
                    if len(results) < len(task.items):
                        queue.appendleft((task, results))
                    else:
                        task.done(results)
        finally:
            for process, *_ in running.values():
                process.kill()


def _work(prepare, open_, argument, items, seconds, memory, journal, log) -> None:
    """In the worker: append each result to the journal as soon as it is there, so that a death loses the current item only."""
    output = os.open(log, os.O_WRONLY | os.O_CREAT | os.O_APPEND, 0o644)
    os.dup2(output, 1), os.dup2(output, 2)
    with open(journal, "wb") as stream:
        try:
            with limit(max(60.0, seconds)):  # imports of engines, not an answer
                if prepare:
                    prepare()
                answer = open_(argument)
            for item in items:
                with limit(seconds):
                    result = answer(item)
                pickle.dump(result, stream)
                stream.flush()
                if resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024 > memory:
                    os._exit(RECYCLE_EXIT)
        except ValueError as error:  # bad input, said in words; where it came from is in the log
            traceback.print_exc()
            pickle.dump(ValueError(str(error)), stream)
        except Exception:
            pickle.dump(WorkerError(traceback.format_exc()), stream)
    os._exit(0)  # past the destructors of engines, some of which crash


def _read(journal: Path) -> list[Any]:
    stream, found = io.BytesIO(journal.read_bytes() if journal.exists() else b""), []
    while True:
        try:
            found.append(pickle.load(stream))
        except (EOFError, pickle.UnpicklingError):
            return found
        if isinstance(found[-1], (WorkerError, ValueError)):
            raise found[-1]


def _death(exitcode: int) -> tuple[str, str]:
    """(status, detail) of the item that a process died at."""
    if exitcode == WATCHDOG_EXIT:
        return "timeout", "the limit for one item ran out"
    return "error", "the process died: " + (signal.Signals(-exitcode).name if exitcode < 0 else f"exit code {exitcode}")


def _null():
    global _NULL
    _NULL = globals().get("_NULL") or open(os.devnull, "w")
    return _NULL
