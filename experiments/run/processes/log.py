# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The output of workers in one small file: the beginning of each process's output, up to a total
limit.
"""

from __future__ import annotations

import contextlib
import os
from pathlib import Path

EACH = 256 << 10  # bytes kept of one process
ALL = 16 << 20  # maximum size of the file in bytes


class Log:
    """Collects output from pipes. A failure to write the file does not end a run: it contains no
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
        """Empty the pipe, at most a megabyte, and keep what fits. False: it has no writer left."""
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
        """The process is gone: record how much of its output was cut."""
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
