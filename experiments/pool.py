"""Work in processes that may die: a crash or a hang costs the one item it happened at."""

from __future__ import annotations

import contextlib
import faulthandler
import io
import multiprocessing
import os
import pickle
import signal
import tempfile
from concurrent.futures import FIRST_COMPLETED, wait
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Callable, Iterator, Sequence

from pebble import ProcessExpired, ProcessPool

# A process that the watchdog of `limit` ends leaves with this code (faulthandler calls _exit(1)).
WATCHDOG_EXIT = 1


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


def run(tasks: Sequence[Task], workers: int, seconds: float, log: Path, advance: Callable[[int], None] = lambda n: None,
        prepare: Callable[[], None] | None = None) -> None:
    """Run all tasks, each in a fresh process, `workers` at a time. seconds: limit for one item. log: what processes print.
    prepare: called first in each process.

    A fresh process for each task makes results independent of the number of workers: what an engine leaves in its memory
    is seen by the later items of the same task alone. pebble tells which task a dead process was at.
    """
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(["numpy", "ofg", "experiments.pool"])
    with tempfile.TemporaryDirectory() as folder, ProcessPool(workers, max_tasks=1, context=context) as pool:
        waiting = {}

        def submit(task: Task, before: list) -> None:
            journal = Path(folder, f"{id(task)}-{len(before)}")
            future = pool.schedule(_work, (prepare, task.open, task.argument, list(task.items[len(before):]), seconds, journal, log))
            waiting[future] = (task, before, journal)

        try:
            for task in tasks:
                submit(task, [])
            while waiting:
                for future in wait(waiting, return_when=FIRST_COMPLETED).done:
                    task, before, journal = waiting.pop(future)
                    results = before + list(_read(journal))
                    advance(len(results) - len(before))
                    failure = _failure(future)
                    if failure and len(results) < len(task.items):
                        results.append(task.lost(task.items[len(results)], *failure))
                        advance(1)
                    if len(results) < len(task.items):
                        submit(task, results)
                    else:
                        task.done(results)
        except BaseException:
            pool.stop()
            raise


def _work(prepare, open_, argument, items, seconds, journal, log) -> None:
    """In the worker: append each result to the journal as soon as it is there, so that a death loses the current item only."""
    output = os.open(log, os.O_WRONLY | os.O_CREAT | os.O_APPEND)
    os.dup2(output, 1), os.dup2(output, 2)
    with open(journal, "wb") as stream:
        with limit(max(60.0, seconds)):  # imports of engines, not an answer
            if prepare:
                prepare()
            answer = open_(argument)
        for item in items:
            with limit(seconds):
                result = answer(item)
            pickle.dump(result, stream)
            stream.flush()


def _read(journal: Path) -> Iterator[Any]:
    stream = io.BytesIO(journal.read_bytes() if journal.exists() else b"")
    while True:
        try:
            yield pickle.load(stream)
        except (EOFError, pickle.UnpicklingError):
            return


def _failure(future) -> tuple[str, str] | None:
    """(status, detail) of a process that died, None for one that finished. Errors of ours are raised."""
    try:
        future.result()
    except ProcessExpired as death:
        if death.exitcode == WATCHDOG_EXIT:
            return "timeout", "the limit for one item ran out"
        name = signal.Signals(-death.exitcode).name if death.exitcode < 0 else f"exit code {death.exitcode}"
        return "error", f"the process died: {name}"
    return None


def _null():
    global _NULL
    _NULL = globals().get("_NULL") or open(os.devnull, "w")
    return _NULL
