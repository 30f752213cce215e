# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Faults of the machine, with real processes: none of them becomes a result, and nothing is left
behind.
"""

import ctypes
import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import psutil
import pytest

from experiments.run.processes import crew, limits
from experiments.run.processes.pool import Loss, MachineError, Task, run


def _open(doings):
    """doings: item -> what it does, a name of `_do`."""

    def answer(item):
        _do(doings.get(item, ""), item)
        return item * item

    return answer


def _do(what, item):
    name, _, argument = what.partition(" ")
    if name == "wait":  # says that it is there; a second process finds the file and goes on
        if not os.path.exists(argument):
            Path(argument).write_text(str(os.getpid()))
            signal.sigtimedwait([signal.SIGUSR1], 120)
    elif name == "signal":
        os.kill(os.getpid(), int(argument))
    elif name == "exit":
        ctypes.CDLL(None).exit(int(argument))
    elif name == "leave":
        os._exit(int(argument))
    elif name == "sleep":
        time.sleep(600)
    elif name == "disarm":
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, signal.SIG_IGN)
        while True:
            pass
    elif name == "children":
        _leave_children(argument)
    elif name == "fork":
        os.fork()  # both go on and answer
    elif name == "print":
        os.write(1, b"x" * int(argument))
    elif name == "allocate":
        bytearray(8 << 30)
    elif name == "close":
        os.closerange(3, 256)


def _leave_children(path):
    """One in the group of the worker, one that left it."""
    pids = []
    for away in (False, True):
        pid = os.fork()
        if pid == 0:
            if away:
                os.setsid()
            time.sleep(600)
            os._exit(0)
        pids.append(pid)
    Path(path).write_text(" ".join(map(str, pids)))


def _ask(tmp_path, doings, items=(1, 2, 3), seconds=5.0, workers=2, **more):
    found = []
    task = Task(_open, doings, list(items), found.extend, lambda item, loss: loss)
    run([task], workers, seconds, tmp_path / "log", **more)
    return found


def _when_there(path, do):
    """Do it in a thread, as soon as a worker has written its process id into the file."""

    def wait():
        while not path.exists() or not path.read_text():
            time.sleep(0.02)
        do(int(path.read_text()))

    thread = threading.Thread(target=wait, daemon=True)
    thread.start()
    return thread


def _gone(pids, seconds=5.0):
    """Whether none of them is alive, after at most so long."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if not any(_alive(pid) for pid in pids):
            return True
        time.sleep(0.02)
    return False


def _alive(pid):
    try:
        return psutil.Process(pid).status() != psutil.STATUS_ZOMBIE
    except psutil.NoSuchProcess:
        return False


@pytest.mark.parametrize("which", [signal.SIGKILL, signal.SIGSEGV, signal.SIGTERM])
def test_a_worker_killed_from_outside_loses_nothing(tmp_path, which):
    there = tmp_path / "there"
    _when_there(there, lambda pid: os.kill(pid, which))
    assert _ask(tmp_path, {2: f"wait {there}"}) == [1, 4, 9]


def test_the_fork_server_killed_loses_nothing(tmp_path):
    """With the server of multiprocessing, 3 of 7 such kills ended with exit 0 and a hit turned
    uncertain.
    """
    there = tmp_path / "there"
    _when_there(there, lambda pid: os.kill(crew._current.process.pid, signal.SIGKILL))
    assert _ask(tmp_path, {2: f"wait {there}"}) == [1, 4, 9]
    assert _gone([int(there.read_text())])


def test_a_worker_stopped_for_longer_than_its_limit_loses_nothing(tmp_path):
    """The limit was one of the wall: a label was lost."""
    there = tmp_path / "there"

    def pause(pid):
        os.kill(pid, signal.SIGSTOP)
        time.sleep(3.0)
        os.kill(pid, signal.SIGUSR1)
        os.kill(pid, signal.SIGCONT)

    _when_there(there, pause)
    # SIGUSR1 is waited for and not blocked, so it may end the process, which is a death from
    # outside too
    assert _ask(tmp_path, {2: f"wait {there}"}, seconds=1.0) == [1, 4, 9]


@pytest.mark.parametrize(
    "doing, status, words",
    [
        (f"signal {signal.SIGSEGV}", "error", "killed twice, alone: SIGSEGV"),
        (f"signal {signal.SIGKILL}", "error", "killed twice, alone: SIGKILL"),
        (
            f"signal {signal.SIGRTMIN + 3}",
            "error",
            f"killed twice, alone: signal {signal.SIGRTMIN + 3}",
        ),
        ("exit 1", "error", "ended itself twice, alone: exit code 1"),
        ("leave 0", "error", "ended itself twice, alone: exit code 0"),
        ("leave 75", "error", "ended itself twice, alone: exit code 75"),
        ("close", "error", "ended itself twice, alone: its results could not be sent"),
        ("allocate", "error", "ended itself twice, alone: out of memory"),
    ],
)
def test_what_ends_its_process_each_time_is_a_row_with_its_words(tmp_path, doing, status, words):
    first, lost, last = _ask(tmp_path, {2: doing}, memory=1 << 30)
    assert (first, lost, last) == (1, Loss(status, words, ""), 9)


@pytest.mark.parametrize("doing", ["sleep", f"signal {signal.SIGSTOP}"])
def test_what_takes_no_processor_time_ends_at_the_deadline(tmp_path, monkeypatch, doing):
    monkeypatch.setattr(limits, "GRACE", 1.0)
    assert _ask(tmp_path, {2: doing}, seconds=0.1) == [
        1,
        Loss("timeout", "killed twice, alone: no answer by the deadline"),
        9,
    ]


def test_a_watchdog_that_was_cancelled_is_replaced_by_the_runner(tmp_path):
    assert _ask(tmp_path, {2: "disarm"}, seconds=0.5) == [
        1,
        Loss("timeout", "the limit for one item ran out"),
        9,
    ]


def test_what_a_worker_leaves_behind_is_ended(tmp_path):
    assert _ask(tmp_path, {2: f"children {tmp_path / 'left'}"}) == [1, 4, 9]
    assert _gone(map(int, (tmp_path / "left").read_text().split()))


def test_a_fork_that_returns_answers_once(tmp_path):
    assert _ask(tmp_path, {1: "fork", 2: "fork"}) == [1, 4, 9]


def test_the_log_is_bounded_and_says_what_was_cut(tmp_path):
    """268 MB were seen."""
    assert _ask(tmp_path, {1: f"print {8 << 20}"}) == [1, 4, 9]
    written = (tmp_path / "log").read_bytes()
    assert len(written) < 300_000 and b"bytes more of process" in written[-100:]


def test_a_control_that_fails_stops_the_run(tmp_path, monkeypatch):
    monkeypatch.setattr("experiments.run.processes.pool._control", _broken_control)
    with pytest.raises(MachineError, match="SIGSEGV.*trivial task.*resume"):
        _ask(tmp_path, {2: f"signal {signal.SIGSEGV}"})


def _broken_control(_):
    os.abort()


def test_nothing_is_written_to_the_temporary_folder(tmp_path, monkeypatch):
    """It was nearly full, and 10 of 11 labels came out uncertain."""
    monkeypatch.setenv("TMPDIR", str(tmp_path / "no such folder"))
    monkeypatch.setattr("tempfile.tempdir", None)
    assert _ask(tmp_path, {}) == [1, 4, 9]


RUNNER = """
import sys
from pathlib import Path
from tests.experiments.run.test_pool_faults import _ask
folder = Path(sys.argv[1])
_ask(folder, {1: f"children {folder / 'left'}", 2: f"wait {folder / 'there'}"})
"""


@pytest.mark.parametrize("stopped", [False, True])
def test_nothing_is_left_of_a_runner_that_was_killed(tmp_path, stopped):
    """28 of 38 left orphans. Even a fork server that was stopped cleans up."""
    there = tmp_path / "there"
    runner = subprocess.Popen(
        [sys.executable, "-c", RUNNER, str(tmp_path)], env={**os.environ, "PYTHONPATH": os.getcwd()}
    )
    while not there.exists() or not there.read_text():
        assert runner.poll() is None
        time.sleep(0.02)
    everything = psutil.Process(runner.pid).children(recursive=True)
    assert len(everything) >= 4
    if stopped:
        everything[0].suspend()
    runner.kill()
    runner.wait()
    assert _gone([p.pid for p in everything], 3.0)


def test_the_fork_server_killed_while_a_second_worker_starts_loses_nothing(tmp_path, monkeypatch):
    """What the first worker was at was forgotten: its results were missing, and the run said that
    it was unfinished.
    """
    there, found, start = tmp_path / "there", {}, crew.Crew._start

    def started(self, job, payload):
        if self.workers and not self.deaths:
            while not there.exists():
                time.sleep(0.01)
            crew._current.process.kill()
            crew._current.process.wait()
        return start(self, job, payload)

    monkeypatch.setattr(crew.Crew, "_start", started)
    tasks = [
        Task(
            _open,
            {2: f"wait {there}"},
            [1, 2, 3],
            lambda r: found.update(first=r),
            lambda item, loss: loss,
        ),
        Task(_open, {}, [4, 5], lambda r: found.update(second=r), lambda item, loss: loss),
    ]
    run(tasks, 2, 5.0, tmp_path / "log")
    assert found == {"first": [1, 4, 9], "second": [16, 25]}
