# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The lock of a run's folder: one runner at a time, released when its holder dies.

`fcntl.flock` of the standard library: the kernel releases it with the process, however that ends,
and children do not inherit it across exec. A library (filelock) would call the same function, but
not report the holder.
"""

from __future__ import annotations

import errno
import fcntl
import os
import socket
from pathlib import Path

from experiments.run.progress import say

NAME = ".lock"
# a link in its place is not written through
_FLAGS = os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_CLOEXEC
_NO_LOCKS = (errno.ENOLCK, errno.ENOSYS, errno.EOPNOTSUPP, errno.EINVAL)


class Locked(RuntimeError):
    """Another process holds the folder; the message names it and the remedy."""


class Lock:
    """`with Lock(folder):` Raises Locked, or OSError if the folder is not writable.

    On a file system without locks, a notice is printed and the work continues.
    """

    def __init__(self, folder: Path):
        self.folder, self.path = folder, folder / NAME

    def __enter__(self) -> Lock:
        while True:
            self._file = os.fdopen(os.open(self.path, _FLAGS, 0o666), "r+")
            try:
                self._take()
            except BaseException:
                self._file.close()
                raise
            if self._is_the_one():
                break
            self._file.close()  # its last holder removed it after it was opened here
        self._file.truncate(0)
        self._file.write(f"{os.getpid()} {socket.gethostname()}\n")
        self._file.flush()
        return self

    def __exit__(self, *_: object) -> None:
        # before the lock is released, so that no other process's file is removed
        self.path.unlink(missing_ok=True)
        self._file.close()

    def _take(self) -> None:
        try:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise Locked(self._refusal()) from None
        except OSError as error:
            if error.errno not in _NO_LOCKS:
                raise
            say(
                f"The file system of {self.folder} has no locks ({error.strerror}), so a second "
                "run in it cannot be prevented. Make sure that there is none."
            )

    def _is_the_one(self) -> bool:
        try:
            return os.path.samestat(os.fstat(self._file.fileno()), os.stat(self.path))
        except FileNotFoundError:
            return False

    def _refusal(self) -> str:
        self._file.seek(0)
        process, _, host = self._file.read().strip().partition(" ")
        holder = f"process {process} on {host}" if process else "another process"
        return (
            f"The folder {self.folder} is in use by {holder}. Wait until it ends, end it, or "
            "choose another folder with --out."
        )
