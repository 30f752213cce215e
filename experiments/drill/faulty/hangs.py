# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Ways in which a method may hang. If only the wall deadline ends it, it hangs at one case only."""

from __future__ import annotations

import faulthandler
import os
import re
import resource
import signal
import threading
import time
from itertools import repeat

from baselines.contract import Verdict

from .kind import ERROR, OK, TIMEOUT, kind, once


@kind(TIMEOUT)
def loops_in_python(query, call):
    while True:
        pass


@kind(TIMEOUT)
def loops_in_c(query, call):
    max(repeat(1))  # never handles signals, never releases the interpreter's lock


@kind(TIMEOUT)
def catastrophic_pattern(query, call):
    re.match("(a+)+$", "a" * 64 + "b")


@kind(TIMEOUT, built=True)
def loops_in_prepare(query, call):
    max(repeat(1))


@kind(TIMEOUT)
def cancels_the_watchdog(query, call):
    faulthandler.cancel_dump_traceback_later()
    max(repeat(1))


@kind(TIMEOUT)
def cancels_every_timer(query, call):
    faulthandler.cancel_dump_traceback_later()
    for timer in (signal.ITIMER_REAL, signal.ITIMER_VIRTUAL, signal.ITIMER_PROF):
        signal.setitimer(timer, 0)
    soft, hard = resource.getrlimit(resource.RLIMIT_CPU)
    resource.setrlimit(resource.RLIMIT_CPU, (hard, hard))
    max(repeat(1))


@kind(TIMEOUT)
def ignores_every_signal(query, call):
    for number in signal.valid_signals() - {signal.SIGKILL, signal.SIGSTOP}:
        signal.signal(number, signal.SIG_IGN)
    max(repeat(1))


@kind(OK, ERROR, TIMEOUT, slow=True)
def sleeps(query, call):
    if once(query, call):
        time.sleep(1e6)
    return Verdict(True)


@kind(OK, ERROR, TIMEOUT, slow=True)
def stops_itself(query, call):
    if once(query, call):
        os.kill(os.getpid(), signal.SIGSTOP)
    return Verdict(True)


@kind(OK, ERROR, TIMEOUT, slow=True)
def waits_for_a_lock(query, call):
    if once(query, call):
        faulthandler.cancel_dump_traceback_later()
        lock = threading.Lock()
        lock.acquire()
        lock.acquire()
    return Verdict(True)


@kind(OK, ERROR, TIMEOUT, slow=True)
def waits_for_its_child(query, call):
    if once(query, call):
        if not (child := os.fork()):
            time.sleep(1e6)
        os.waitpid(child, 0)
    return Verdict(True)
