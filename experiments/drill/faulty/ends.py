# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Ways in which a method may end its process."""

from __future__ import annotations

import ctypes
import faulthandler
import os
import resource
import signal
import sys

import numpy as np

from baselines.contract import Verdict

from .kind import ERROR, OK, kind, once

# Bytes after which "allocates without end" stops by itself, so that the machine survives if nothing
# else stops it.
ENOUGH = 6 << 30


def _exiting(name: str, leave, *statuses: str):
    def act(query, call):
        leave()

    act.__name__ = name
    kind(*(statuses or (ERROR,)))(act)


for _code in (0, 1, 75):
    _exiting(f"sys_exit_{_code}", lambda code=_code: sys.exit(code))
    _exiting(f"os_exit_{_code}", lambda code=_code: os._exit(code))
for _code in (0, 1):
    _exiting(f"c_exit_{_code}", lambda code=_code: ctypes.CDLL(None).exit(code))
_exiting("aborts", os.abort)
_exiting("segfaults", lambda: ctypes.string_at(0))
_exiting(
    "segfaults_silently",
    lambda: (
        faulthandler.disable(),
        signal.signal(signal.SIGSEGV, signal.SIG_DFL),
        ctypes.string_at(0),
    ),
)
for _signal in (
    signal.SIGKILL,
    signal.SIGTERM,
    signal.SIGINT,
    signal.SIGHUP,
    signal.SIGPIPE,
    signal.SIGFPE,
):
    _exiting(
        f"{_signal.name.lower()}_to_itself",
        lambda number=_signal: (
            signal.signal(number, signal.SIG_DFL) if number != signal.SIGKILL else None,
            os.kill(os.getpid(), number),
        ),
    )


@kind(ERROR)
def recursion_in_c(query, call):
    sys.setrecursionlimit(10**8)

    def deeper(_):
        return list(map(deeper, [0]))

    deeper(0)


@kind(ERROR)
def allocates_without_end(query, call):
    if query.question != "motion":
        raise MemoryError
    kept, size = [], 1 << 26
    while len(kept) * size < ENOUGH:
        # a limit counts it; the machine does not: no page is touched
        kept.append(np.empty(size, np.uint8))
    raise RuntimeError("nothing stopped me")


@kind(ERROR)
def allocates_at_once(query, call):
    bytearray(1 << 42)


@kind(OK)
def ends_at_the_second_call(query, call):
    if call > 1:
        os._exit(0)
    return Verdict(True)


@kind(OK)
def segfaults_at_the_second_call(query, call):
    if call > 1:
        ctypes.string_at(0)
    return Verdict(True)


@kind(OK, ERROR)
def alarm_that_kills_later(query, call):
    if once(query, call):
        signal.setitimer(signal.ITIMER_REAL, 0.01)
    return Verdict(True)


@kind(OK, ERROR)
def no_more_files(query, call):
    resource.setrlimit(resource.RLIMIT_NOFILE, (3, resource.getrlimit(resource.RLIMIT_NOFILE)[1]))
    return Verdict(True)


@kind(OK, ERROR)
def files_of_no_size(query, call):
    resource.setrlimit(resource.RLIMIT_FSIZE, (0, resource.getrlimit(resource.RLIMIT_FSIZE)[1]))
    return Verdict(True)
