"""A crash or a hang in a worker costs the one item it happened at."""

import os
import signal
import time
from functools import partial

from experiments.pool import Task, run


def _open(kill_at):
    def answer(item):
        if item == kill_at.get("abort"):
            os.kill(os.getpid(), signal.SIGABRT)
        if item == kill_at.get("hang"):
            time.sleep(60)
        return item * item

    return answer


def _results(tmp_path, items, kill_at, workers=2):
    found = {}
    tasks = [Task(_open, kill_at, chunk, partial(found.__setitem__, i), lambda item, status, detail: (item, status, detail))
             for i, chunk in enumerate(items)]
    run(tasks, workers, 2.0, tmp_path / "log")
    return [found[i] for i in range(len(items))]


def test_results_come_in_order(tmp_path):
    assert _results(tmp_path, [[1, 2, 3], [4, 5]], {}) == [[1, 4, 9], [16, 25]]


def test_an_abort_costs_one_item_and_is_named(tmp_path):
    (rows,) = _results(tmp_path, [[1, 2, 3, 4]], {"abort": 2})
    assert rows == [1, (2, "error", "the process died: SIGABRT"), 9, 16]


def test_a_hang_costs_one_item(tmp_path):
    (rows,) = _results(tmp_path, [[1, 2, 3]], {"hang": 3})
    assert rows == [1, 4, (3, "timeout", "the limit for one item ran out")]


def test_every_item_may_die(tmp_path):
    (rows,) = _results(tmp_path, [[7, 7]], {"abort": 7})
    assert [row[1] for row in rows] == ["error", "error"]


def test_what_workers_print_goes_to_the_log(tmp_path, capfd):
    _results(tmp_path, [[1]], {"abort": 1})
    assert (tmp_path / "log").exists() and not capfd.readouterr().out
