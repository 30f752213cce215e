"""Two limits on what a worker does: processor time, and a deadline on the wall ten times later.

The worker keeps the first itself, by a timer of the kernel; the runner looks after both from
outside, by a page of memory that the two share.
"""

from __future__ import annotations

import contextlib
import math
import mmap
import os
import signal
import struct
from time import monotonic, process_time

import psutil

GRACE = 60.0  # seconds of the wall deadline beyond ten times the limit
SLACK = 0.5  # seconds of processor time that the worker's own timer has, before the runner steps in
_HEAD = struct.Struct("=Qd")  # number of the limit that holds, its seconds (0: none holds)
_SIZE = mmap.PAGESIZE
_page: mmap.mmap | None = None  # of this process, where it is a worker
_number = 0


@contextlib.contextmanager
def limit(seconds: float):
    """End this process if the block takes more processor time, in all its threads.

    Death is by SIGPROF, whose default action needs no interpreter lock: native code that holds it
    is ended too. Within another limit, what is left of that one still holds.
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
    """Leave word of what this process is about: the runner reads it if the process dies."""
    if _page is not None:
        words = text.encode("utf-8", "backslashreplace")[: _SIZE - _HEAD.size - 2]
        struct.pack_into(f"=H{len(words)}s", _page, _HEAD.size, len(words), words)


def _tell(seconds: float) -> None:
    global _number
    if _page is not None:
        _number += 1
        _HEAD.pack_into(_page, 0, _number, seconds)


def share(fd: int) -> None:
    """In a worker: tell limits and marks through this page from now on."""
    global _page, _number
    _page, _number = mmap.mmap(fd, _SIZE), 0


class Page:
    """The runner's side of the page that it shares with one worker.

    fd: for the worker. `overdue` is asked now and then; what it measures counts from the first time
    that it finds a new limit, so that it never charges too much.
    """

    def __init__(self):
        self.fd = os.memfd_create("ofg-limits", os.MFD_CLOEXEC)
        os.ftruncate(self.fd, _SIZE)
        self._memory = mmap.mmap(self.fd, _SIZE)
        self._number, self._begun, self._spent = -1, monotonic(), None

    @property
    def number(self) -> int:
        """Which limit holds: another number, another limit."""
        return _HEAD.unpack_from(self._memory)[0]

    @property
    def seconds(self) -> float:
        """The limit that holds, 0 where none does."""
        return _HEAD.unpack_from(self._memory)[1]

    @property
    def mark(self) -> str:
        """What the worker said last that it was about."""
        (length,) = struct.unpack_from("=H", self._memory, _HEAD.size)
        start = _HEAD.size + 2
        return self._memory[start : start + length].decode("utf-8", "replace")

    def overdue(self, pid: int) -> str:
        """Which limit the worker has passed: "timeout" (processor time), "deadline" or ""."""
        now = monotonic()
        if self.number != self._number:
            self._number, self._begun, self._spent = self.number, now, None
        elapsed = now - self._begun
        if elapsed > deadline(self.seconds):
            return "deadline"
        if self._spent is None:  # measured late, which is to the worker's advantage
            self._spent = processor_seconds(pid) if elapsed > min(1.0, self.seconds) else None
            return ""
        over = self.seconds and elapsed > self.seconds + SLACK
        return "timeout" if over and self._used(pid) > self.seconds + SLACK else ""

    def _used(self, pid: int) -> float:
        return processor_seconds(pid) - self._spent

    def forgive(self) -> None:
        """Count the wall anew: the runner itself was stopped and knows nothing of the time
        since.
        """
        self._begun = monotonic()

    def close(self) -> None:
        self._memory.close()
        os.close(self.fd)


def deadline(seconds: float) -> float:
    """Seconds on the wall after which a limit of so many processor seconds is given up."""
    return 10.0 * seconds + GRACE


def processor_seconds(pid: int) -> float:
    """Processor time of a process and of what it started, dead or alive; 0 where it is gone."""
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
