# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The runner's side of its workers: it starts them, receives their messages, enforces their
limits and cleans up after them.
"""

from __future__ import annotations

import contextlib
import json
import os
import pickle
import select
import signal
import socket
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from time import monotonic
from typing import Any

from . import process
from .limits import Page
from .log import Log
from .machine import MachineError
from .worker import LENGTH

TICK = 0.5  # seconds between two checks of the limits
STOPPED = 5.0  # seconds of delay of a check: the runner itself was stopped meanwhile
ANSWER = 120.0  # seconds for the fork server to start, or to answer
STARTS = 5  # fork servers that may die in a row without progress
VARIABLE = "OFG_RUNNER"  # in the environment of everything that a runner starts: its process id

News = dict[str, Any]  #: from the fork server: see forker._Server._say


@dataclass
class Worker:
    """One process. frames: its messages, (kind, value). ended_for: why the runner killed it."""

    pid: int
    page: Page
    results: int
    output: int
    job: Any
    frames: list[tuple[str, Any]] = field(default_factory=list)
    buffer: bytearray = field(default_factory=bytearray)
    ended_for: str = ""
    ended_at: int = -1  # number of the exceeded limit
    page_mark: str = ""
    page_number: int = -1
    deaf: set[int] = field(default_factory=set)  # pipes that it closed

    def hear(self) -> None:
        """Read its messages so far."""
        with contextlib.suppress(BlockingIOError):
            while data := os.read(self.results, 1 << 16):
                self.buffer += data
            self.deaf.add(self.results)
        while len(self.buffer) >= LENGTH.size:
            end = LENGTH.size + LENGTH.unpack_from(self.buffer)[0]
            if len(self.buffer) < end:
                break
            self.frames.append(pickle.loads(self.buffer[LENGTH.size : end]))
            del self.buffer[:end]

    def look(self) -> None:
        """Kill it, with its group, if it has exceeded a limit."""
        if not self.ended_for and (why := self.page.overdue(self.pid)):
            self.ended_for, self.ended_at = why, self.page.number
            process.kill_group(self.pid)

    def close(self) -> None:
        """Free its resources; the last text on its page is kept."""
        self.page_mark, self.page_number = self.page.mark, self.page.number
        self.page.close()
        os.close(self.results)
        os.close(self.output)


Ended = tuple[Worker, int | None]  #: with its exit code: see Crew.wait


class Crew:
    """All workers of one `pool.run`. A context: at its end, nothing that it started is left."""

    def __init__(self, log: Path):
        self.log, self.deaths = Log(log), 0
        self.workers: dict[int, Worker] = {}
        self.news: list[News] = []
        self.looked = monotonic()
        # with a fork server that died while another worker was started
        self.ended: list[Ended] = []

    @property
    def busy(self) -> bool:
        """Whether `wait` has workers to wait for, or to report."""
        return bool(self.workers or self.ended)

    def __enter__(self) -> Crew:
        process.adopt_orphans()
        return self

    def __exit__(self, *error: object) -> None:
        for worker in list(self.workers.values()):
            process.kill_group(worker.pid)
        with contextlib.suppress(_ServerGone, MachineError):
            for said in self.news:
                if "died" in said:
                    self._buried(said["died"])
            while self.workers:
                self._await("died")
        for worker in self.workers.values():
            worker.close()
        process.adopt_orphans(False)
        self.log.close()

    def start(self, job: Any, payload: Sequence[Any]) -> None:
        """Start a fresh worker for the job. payload: see worker.work. MachineError if none can
        be started.
        """
        while True:
            try:
                return self._start(job, payload)
            except _ServerGone:
                self.ended += self._bury_all()
            except OSError as error:
                raise MachineError(
                    f"No process could be started ({error.strerror or error}). {RESUME}"
                ) from error

    def _start(self, job: Any, payload: Sequence[Any]) -> None:
        server = _server()
        page, (results, tell), (output, say) = Page(), os.pipe(), os.pipe()
        for end in (results, output):
            os.set_blocking(end, False)
        task = os.memfd_create("ofg-task", os.MFD_CLOEXEC)
        try:
            with open(task, "wb", closefd=False) as stream:
                stream.write(pickle.dumps((os.getcwd(), sys.path)) + pickle.dumps(tuple(payload)))
            os.lseek(task, 0, os.SEEK_SET)
            server.ask([task, tell, page.fd, say])
            pid = self._await("pid")["pid"]
        except BaseException:
            page.close()
            for fd in (results, output):
                os.close(fd)
            raise
        finally:
            for fd in (task, tell, say):
                os.close(fd)
        self.workers[pid] = Worker(pid, page, results, output, job)

    def wait(self) -> list[Ended]:
        """Workers that have ended, each with its exit code: -n for signal n, None if its fork
        server died.
        """
        if self.ended:
            ended, self.ended = self.ended, []
            return ended
        try:
            return self._wait()
        except _ServerGone:
            return self._bury_all()

    def _wait(self) -> list[Ended]:
        server = _server()
        ended: list[Ended] = []
        listened: list[socket.socket | int] = [server.channel]
        listened += [
            fd for w in self.workers.values() for fd in (w.results, w.output) if fd not in w.deaf
        ]
        ready, _, _ = select.select(listened, [], [], 0 if self.news else TICK)
        late = monotonic() - self.looked > STOPPED
        for worker in self.workers.values():
            self._hear(worker)
        if server.channel in ready:
            self.news.append(server.hear())
        while self.news:
            said = self.news.pop(0)
            if "died" in said:
                ended.append((self._buried(said["died"]), said["code"]))
        if monotonic() - self.looked >= TICK:
            for worker in self.workers.values():
                worker.page.forgive() if late else worker.look()
            self.looked = monotonic()
        return ended

    def _hear(self, worker: Worker) -> None:
        before = len(worker.frames)
        worker.hear()
        if not self.log.write(worker.pid, worker.output):
            worker.deaf.add(worker.output)
        if len(worker.frames) > before:
            self.deaths = 0

    def _buried(self, pid: int) -> Worker:
        worker = self.workers.pop(pid)
        self._hear(worker)
        self.log.end(pid)
        worker.close()
        return worker

    def _bury_all(self) -> list[Ended]:
        """The fork server died: kill what it had started, which the kernel made our own
        children.
        """
        self.deaths += 1
        _forget_server()
        for pid in self.workers:
            process.kill_group(pid)
        for pid in self.workers:
            with contextlib.suppress(ChildProcessError):
                os.waitpid(pid, 0)
        process.kill_children(VARIABLE, str(os.getpid()))
        self.news.clear()
        ended: list[Ended] = [(self._buried(pid), None) for pid in list(self.workers)]
        if self.deaths >= STARTS:
            raise MachineError(
                f"The process that starts the workers died {STARTS} times without progress in "
                f"between. {RESUME}"
            )
        return ended

    def _await(self, kind: str) -> News:
        """The next message of one kind; others are kept for `wait`."""
        while True:
            said = _server().hear()
            if "failed" in said:
                raise MachineError(f"No process could be started ({said['failed']}). {RESUME}")
            if kind == "died" and "died" in said:
                self._buried(said["died"])
            if kind in said:
                return said
            self.news.append(said)


RESUME = (
    "What was finished is kept. Check the machine (memory, limits on processes, another program "
    "that ends them), then repeat the command, or run: ofg-bench resume RUN"
)


class _ServerGone(Exception):
    pass


class _Server:
    """A fork server and the socket to it. owner: the process that started it; a fork of that
    process needs its own.
    """

    def __init__(self) -> None:
        self.owner = os.getpid()
        self.channel, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        self.channel.settimeout(ANSWER)
        code = (
            f"import sys; sys.path[:] = {sys.path!r}; from experiments.run.processes.forker import"
            f" serve; serve({theirs.fileno()}, {self.owner})"
        )
        with theirs:
            self.process = subprocess.Popen(
                [sys.executable, "-c", code],
                pass_fds=[theirs.fileno()],
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                start_new_session=True,
                env={**os.environ, VARIABLE: str(self.owner)},
            )
        self.hear()

    def ask(self, fds: list[int]) -> None:
        try:
            socket.send_fds(self.channel, [b"fork"], fds)
        except (BrokenPipeError, ConnectionError) as error:
            raise _ServerGone from error

    def hear(self) -> News:
        try:
            message = self.channel.recv(4096)
        except (OSError, TimeoutError) as error:
            raise _ServerGone from error
        if not message:
            raise _ServerGone
        news: News = json.loads(message)
        return news


_current: _Server | None = None


def _server() -> _Server:
    """The fork server of this process, started at the first call; consecutive runs share it."""
    global _current
    if _current is None or _current.owner != os.getpid():
        _current = _Server()
    return _current


def _forget_server() -> None:
    global _current
    if _current is not None and _current.owner == os.getpid():
        with contextlib.suppress(ProcessLookupError):
            _current.process.send_signal(signal.SIGKILL)
        _current.process.wait()
        _current.channel.close()
    _current = None
