# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The work of one worker process: it opens a task, processes its items in turn, and sends each
result at once.
"""

from __future__ import annotations

import os
import pickle
import resource
import signal
import struct
import sys
import traceback

from . import limits

IMPORT_SECONDS = 60.0  # at least, for `prepare` and `open`: imports of engines, not an answer
NO_CHANNEL = 70  # exit code: the results could not be sent
NO_MEMORY = 71  # exit code: our own code ran out of memory after a method took it
LENGTH = struct.Struct("=Q")  # before each pickled frame (kind, value)


class Channel:
    """The pipe to the runner. A child that a method forked and that returns to us must not write
    to it.
    """

    def __init__(self, fd: int):
        self.fd, self.owner = fd, os.getpid()

    def send(self, kind: str, value: object = None) -> None:
        """Send a frame. The process ends if that fails: its results would be lost."""
        if os.getpid() != self.owner:
            os._exit(0)
        body = pickle.dumps((kind, value))
        rest = memoryview(LENGTH.pack(len(body)) + body)
        try:
            while rest:
                rest = rest[os.write(self.fd, rest) :]
        except OSError:  # a method closed it, or the runner is gone
            os._exit(NO_CHANNEL)


def work(payload: int, results: int, page: int, log: int) -> None:
    """Process the payload, and never return. All four are descriptors made by the runner."""
    for standard in (1, 2):
        os.dup2(log, standard)
    os.close(log)
    signal.signal(signal.SIGPROF, signal.SIG_DFL)
    limits.share(page)
    channel = Channel(results)
    try:
        _ask(payload, channel)
    except ValueError as error:  # bad input, described in the message; its origin is in the log
        traceback.print_exc()
        channel.send("refused", str(error))
    except MemoryError:
        os._exit(NO_MEMORY)
    except BaseException:
        channel.send("bug", traceback.format_exc())
    os._exit(0)  # skips the destructors of engines, some of which crash


def _ask(payload: int, channel: Channel) -> None:
    with open(payload, "rb") as stream:
        folder, sys.path[:] = pickle.load(stream)
        os.chdir(folder)
        prepare, open_, argument, items, seconds, memory = pickle.load(stream)
    _bound(memory)
    with limits.limit(max(IMPORT_SECONDS, seconds)):
        if prepare:
            prepare()
        answer = open_(argument)
    for item in items:
        limits.mark("")
        with limits.limit(seconds):
            result = answer(item)
        channel.send("result", result)
        if resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024 > memory:
            return channel.send("recycle")
    channel.send("end")


def _bound(memory: int) -> None:
    """Make an allocation fail beyond twice the memory at which a worker is replaced, as
    MemoryError or bad_alloc.
    """
    hard = resource.getrlimit(resource.RLIMIT_DATA)[1]
    most = 2 * memory if hard == resource.RLIM_INFINITY else min(2 * memory, hard)
    resource.setrlimit(resource.RLIMIT_DATA, (most, most))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))  # core dumps of engines would fill the disk
