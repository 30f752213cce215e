"""What workers print, in one file that stays small: the beginning of what each process prints, up
to a bound for all.
"""

from __future__ import annotations

import contextlib
import os
from pathlib import Path

EACH = 256 << 10  # bytes kept of one process
ALL = 16 << 20  # bytes that the file may hold


class Log:
    """Takes what comes through pipes. That the file cannot be written ends no run: nothing in it is
    data.
    """

    def __init__(self, path: Path):
        self.file, self.size = None, 0
        with contextlib.suppress(OSError):
            self.file = open(path, "ab", buffering=0)
            self.size = path.stat().st_size
        self.kept: dict[int, int] = {}
        self.cut: dict[int, int] = {}

    def write(self, pid: int, fd: int) -> bool:
        """Empty the pipe, at most a megabyte of it, and keep what has a place. False: nobody writes
        there any more.
        """
        for _ in range(16):
            try:
                data = os.read(fd, 1 << 16)
            except BlockingIOError:
                return True
            if not data:
                return False
            place = max(0, min(EACH - self.kept.get(pid, 0), ALL - self.size))
            self._put(data[:place])
            self.kept[pid] = self.kept.get(pid, 0) + len(data[:place])
            self.cut[pid] = self.cut.get(pid, 0) + len(data[place:])
        return True

    def end(self, pid: int) -> None:
        """The process is gone: say what of its words was cut."""
        self.kept.pop(pid, None)
        if cut := self.cut.pop(pid, 0):
            self._put(f"\n[{cut} bytes more of process {pid} were cut]\n".encode())

    def _put(self, data: bytes) -> None:
        if self.file and data:
            with contextlib.suppress(OSError):
                self.size += self.file.write(data)

    def close(self) -> None:
        if self.file:
            self.file.close()
