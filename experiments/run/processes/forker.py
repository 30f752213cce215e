# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The process from which workers are forked: with the imports done, a worker starts in
milliseconds.

`crew` starts it. Unlike a server of multiprocessing, it adopts what workers leave behind, and it
ends all of that when its runner is gone, however that died.
"""

from __future__ import annotations

import contextlib
import importlib
import json
import os
import select
import signal
import socket

from . import process

# Without these imports each worker takes a second to start. They include no engine.
PRELOAD = (
    "experiments.cli.app",
    "experiments.run.labelling",
    "experiments.run.answering",
    "experiments.run.timing",
    "experiments.truth",
    "experiments.run.processes.worker",
)
DESCRIPTORS = 4  # descriptors that come with each request: see worker.work


class _RunnerGone(BaseException):
    pass


def serve(fd: int, runner: int) -> None:
    """Answer requests on this socket until the runner (a process id) closes it or dies."""
    process.signal_at_parents_death(signal.SIGKILL)  # during its imports it has nothing to clean up
    if os.getppid() != runner:
        os._exit(0)
    process.adopt_orphans()
    for module in PRELOAD:
        importlib.import_module(module)
    try:
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        # The handler must only wake the loop: anything more would also run during the cleanup.
        signal.signal(signal.SIGCONT, lambda *_: None)
        process.signal_at_parents_death(signal.SIGCONT)  # wakes it even if it was stopped
        _Server(socket.socket(fileno=fd), runner).serve()
    except (_RunnerGone, OSError):
        pass
    finally:
        process.kill_children()
        os._exit(0)


def _check(runner: int) -> None:
    if os.getppid() != runner:
        raise _RunnerGone


class _Server:
    def __init__(self, channel: socket.socket, runner: int):
        self.channel, self.runner = channel, runner
        self.workers: set[int] = set()
        self.wake, wakened = os.pipe()
        for end in (self.wake, wakened):
            os.set_blocking(end, False)
        signal.set_wakeup_fd(wakened)
        signal.signal(signal.SIGCHLD, lambda *_: None)

    def serve(self) -> None:
        ends: list[socket.socket | int] = [self.channel, self.wake]
        self._say(ready=os.getpid())
        while True:
            _check(self.runner)
            ready, _, _ = select.select(ends, [], [])
            if self.wake in ready:
                with contextlib.suppress(BlockingIOError):
                    os.read(self.wake, 4096)
                self._bury()
            if self.channel in ready and not self._request():
                return

    def _request(self) -> bool:
        """Fork a worker, unless the runner is gone."""
        message, fds, _, _ = socket.recv_fds(self.channel, 64, DESCRIPTORS)
        if not message:
            return False
        server = os.getpid()
        try:
            pid = os.fork()
        except OSError as error:
            pid = None
            self._say(failed=str(error))
        if pid == 0:
            self._become_worker(server, fds)
        for fd in fds:
            os.close(fd)
        if pid:
            self.workers.add(pid)
            self._say(pid=pid)
        return True

    def _become_worker(self, server: int, fds: list[int]) -> None:
        """In the child: it gets its own process group, so that all of it can be killed at once."""
        try:
            signal.set_wakeup_fd(-1)
            for which in (signal.SIGCHLD, signal.SIGCONT):
                signal.signal(which, signal.SIG_DFL)
            signal.signal(signal.SIGINT, signal.default_int_handler)
            os.setsid()
            process.signal_at_parents_death(signal.SIGKILL)
            self.channel.close()
            if os.getppid() == server:
                from .worker import work

                work(*fds)
        finally:
            os._exit(1)

    def _bury(self) -> None:
        """Report dead workers, each after its group has ended: its number is not reused before
        that.
        """
        while self.workers:
            info = os.waitid(os.P_ALL, 0, os.WEXITED | os.WNOHANG | os.WNOWAIT)
            if info is None:
                break
            if info.si_pid in self.workers:
                process.kill_group(info.si_pid)
            _, status = os.waitpid(info.si_pid, 0)
            if info.si_pid in self.workers:
                self.workers.discard(info.si_pid)
                if not self.workers:
                    process.kill_children()  # processes that left their group
                self._say(died=info.si_pid, code=os.waitstatus_to_exitcode(status))

    def _say(self, **what: int | str) -> None:
        self.channel.send(json.dumps(what).encode())
