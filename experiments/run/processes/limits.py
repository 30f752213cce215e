# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Two limits on a worker: processor time, and a wall-clock deadline of about ten times that.

The worker enforces the first itself with a kernel timer; the runner enforces both from outside,
through a page of memory that the two share.
"""

from __future__ import annotations

import contextlib
import math
import mmap
import os
import signal
import struct
from collections.abc import Iterator
from time import monotonic, process_time

import psutil

GRACE = 60.0  # seconds of the wall deadline beyond ten times the limit
SLACK = 0.5  # seconds of processor time for the worker's own timer, before the runner intervenes
_HEAD = struct.Struct("=Qd")  # number of the active limit, its seconds (0: none active)
_SIZE = mmap.PAGESIZE
_page: mmap.mmap | None = None  # of this process, if it is a worker
_number = 0


@contextlib.contextmanager
def limit(seconds: float) -> Iterator[None]:
    """End this process if the block takes more processor time, in all its threads.

    The process dies by SIGPROF, whose default action needs no interpreter lock: native code that
    holds it is ended too. Within another limit, the remainder of that limit still applies.
    """
    outer, begun = signal.getitimer(signal.ITIMER_PROF)[0], process_time()
    signal.setitimer(signal.ITIMER_PROF, min(seconds, outer or math.inf))
    _tell(seconds)
    try:
        yield
    finally:
        left = max(1e-3, outer - (process_time() - begun)) if outer else 0.0
        signal.setitimer(signal.ITIMER_PROF, left)
        _tell(left)


def mark(text: str) -> None:
    """Record what this process is working on: the runner reads it if the process dies."""
    if _page is not None:
        words = text.encode("utf-8", "backslashreplace")[: _SIZE - _HEAD.size - 2]
        struct.pack_into(f"=H{len(words)}s", _page, _HEAD.size, len(words), words)


def _tell(seconds: float) -> None:
    global _number
    if _page is not None:
        _number += 1
        _HEAD.pack_into(_page, 0, _number, seconds)


def share(fd: int) -> None:
    """In a worker: write limits and marks to this page from now on."""
    global _page, _number
    _page, _number = mmap.mmap(fd, _SIZE), 0


class Page:
    """The runner's side of the page that it shares with one worker.

    fd: for the worker. `overdue` is called now and then; it measures from the first time that it
    finds a new limit, so that it never charges too much.
    """

    def __init__(self) -> None:
        self.fd = os.memfd_create("ofg-limits", os.MFD_CLOEXEC)
        os.ftruncate(self.fd, _SIZE)
        self._memory = mmap.mmap(self.fd, _SIZE)
        self._number, self._begun = -1, monotonic()
        self._spent: float | None = None

    @property
    def number(self) -> int:
        """Number of the active limit: another number, another limit."""
        number: int = _HEAD.unpack_from(self._memory)[0]
        return number

    @property
    def seconds(self) -> float:
        """The active limit, 0 if there is none."""
        seconds: float = _HEAD.unpack_from(self._memory)[1]
        return seconds

    @property
    def mark(self) -> str:
        """The worker's last mark."""
        (length,) = struct.unpack_from("=H", self._memory, _HEAD.size)
        start = _HEAD.size + 2
        return self._memory[start : start + length].decode("utf-8", "replace")

    def overdue(self, pid: int) -> str:
        """The limit that the worker has exceeded: "timeout" (processor time), "deadline" or ""."""
        now = monotonic()
        if self.number != self._number:
            self._number, self._begun, self._spent = self.number, now, None
        elapsed = now - self._begun
        if elapsed > deadline(self.seconds):
            return "deadline"
        if self._spent is None:  # measured late, in the worker's favour
            self._spent = processor_seconds(pid) if elapsed > min(1.0, self.seconds) else None
            return ""
        most = self.seconds + SLACK
        over = self.seconds and elapsed > most
        return "timeout" if over and processor_seconds(pid) - self._spent > most else ""

    def forgive(self) -> None:
        """Restart the wall clock: the runner itself was stopped and cannot account for the time
        since.
        """
        self._begun = monotonic()

    def close(self) -> None:
        self._memory.close()
        os.close(self.fd)


def deadline(seconds: float) -> float:
    """Seconds of wall time after which a limit of so many processor seconds is given up."""
    return 10.0 * seconds + GRACE


def processor_seconds(pid: int) -> float:
    """Processor time of a process and of what it started, dead or alive; 0 if it is gone."""
    total = 0.0
    try:
        process = psutil.Process(pid)
        for one in (process, *process.children(recursive=True)):
            with contextlib.suppress(psutil.Error):
                # user, system, and both of the children it waited for
                total += sum(one.cpu_times()[:4])
    except psutil.Error:
        pass
    return total
