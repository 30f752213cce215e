# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""A crash or a hang in a worker costs the one item it happened at."""

import os
import signal
import weakref
from functools import partial

import pytest

from experiments.run.processes.pool import Task, WorkerError, run


def _open(kill_at):
    def answer(item):
        if item == kill_at.get("abort"):
            os.kill(os.getpid(), signal.SIGABRT)
        if item == kill_at.get("hang"):
            while True:
                pass
        if item == kill_at.get("raise"):
            raise ZeroDivisionError("ours")
        if item == kill_at.get("refuse"):
            raise ValueError(f"{item} is no number of ours")
        if item == kill_at.get("crash at exit"):
            weakref.finalize(os, os.abort)
        return item * item

    return answer


def _results(tmp_path, items, kill_at, workers=2):
    found = {}
    tasks = [
        Task(
            _open,
            kill_at,
            chunk,
            partial(found.__setitem__, i),
            lambda item, loss: (item, loss.status, loss.detail),
        )
        for i, chunk in enumerate(items)
    ]
    run(tasks, workers, 2.0, tmp_path / "log")
    return [found[i] for i in range(len(items))]


def test_results_come_in_order(tmp_path):
    assert _results(tmp_path, [[1, 2, 3], [4, 5]], {}) == [[1, 4, 9], [16, 25]]


def test_an_abort_costs_one_item_and_is_named(tmp_path):
    (rows,) = _results(tmp_path, [[1, 2, 3, 4]], {"abort": 2})
    assert rows == [1, (2, "error", "killed twice, alone: SIGABRT"), 9, 16]


def test_a_hang_costs_one_item(tmp_path):
    (rows,) = _results(tmp_path, [[1, 2, 3]], {"hang": 3})
    assert rows == [1, 4, (3, "timeout", "the limit for one item ran out")]


def test_every_item_may_die(tmp_path):
    (rows,) = _results(tmp_path, [[7, 7]], {"abort": 7})
    assert [row[1] for row in rows] == ["error", "error"]


def test_what_workers_print_goes_to_the_log(tmp_path, capfd):
    _results(tmp_path, [[1]], {"abort": 1})
    assert (tmp_path / "log").exists() and not capfd.readouterr().out


def test_a_crash_after_the_last_answer_costs_nothing(tmp_path):
    """Some engines crash in their destructors; a pool of a library broke as a whole on that."""
    assert _results(tmp_path, [[1, 2], [3]], {"crash at exit": 2}) == [[1, 4], [9]]


def _open_leaky(_):
    held = []

    def answer(item):
        held.append(b"x" * (64 << 20))
        return item, len(held)

    return answer


def test_a_worker_that_leaks_is_replaced_and_loses_nothing(tmp_path):
    found = []
    run(
        [Task(_open_leaky, None, list(range(12)), found.extend, lambda item, loss: loss)],
        1,
        10.0,
        tmp_path / "log",
        memory=512 << 20,
    )
    assert [item for item, _ in found] == list(range(12))
    assert 1 < max(held for _, held in found) < 12, (
        "no worker went through all items, and none was replaced at once"
    )


def test_an_error_of_ours_is_raised_with_its_traceback(tmp_path):
    with pytest.raises(WorkerError, match="ZeroDivisionError: ours"):
        _results(tmp_path, [[1, 2, 3]], {"raise": 2})


def test_bad_input_is_said_in_its_own_words(tmp_path):
    """What a reader did wrong is one paragraph of the command, not a traceback through the pool;
    that is in the log.
    """
    with pytest.raises(ValueError, match="^3 is no number of ours$"):
        _results(tmp_path, [[1, 2, 3]], {"refuse": 3})
    assert "Traceback" in (tmp_path / "log").read_text()
