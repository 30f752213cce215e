# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Things that a method may leave behind: processes, threads, output, files."""

from __future__ import annotations

import atexit
import os
import signal
import subprocess
import tempfile
import threading
import time
from itertools import repeat

from baselines.contract import Verdict

from .kind import ERROR, OK, TIMEOUT, kind, once

FOREVER = 3600.0


def _child(*deeds) -> None:
    if os.fork() == 0:
        for deed in deeds:
            deed()
        time.sleep(FOREVER)
        os._exit(0)


@kind(OK)
def leaves_a_child(query, call):
    if once(query, call):
        _child()
    return Verdict(True)


@kind(OK)
def leaves_three_children(query, call):
    if once(query, call):
        for _ in range(3):
            _child()
    return Verdict(True)


@kind(OK)
def leaves_a_daemon(query, call):
    if once(query, call):
        _child(os.setsid, lambda: signal.signal(signal.SIGTERM, signal.SIG_IGN))
    return Verdict(True)


@kind(OK)
def leaves_an_orphan(query, call):
    """Forked twice: its parent is gone, and it has its own session."""
    if once(query, call):
        child = os.fork()
        if child == 0:
            os.setsid()
            _child(lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
            os._exit(0)
        os.waitpid(child, 0)
    return Verdict(True)


@kind(OK)
def leaves_a_program(query, call):
    if once(query, call):
        subprocess.Popen(["sleep", str(FOREVER)], start_new_session=True)
    return Verdict(True)


@kind(OK, ERROR)
def child_that_returns(query, call):
    """The child continues as if it were the worker."""
    if once(query, call):
        os.fork()
    return Verdict(True)


@kind(OK)
def own_session(query, call):
    if once(query, call) and os.getpid() != os.getsid(0) and os.getpid() != os.getpgid(0):
        os.setsid()
    return Verdict(True)


@kind(OK)
def leaves_a_thread(query, call):
    if once(query, call):
        threading.Thread(target=time.sleep, args=(FOREVER,)).start()
    return Verdict(True)


@kind(OK, TIMEOUT)
def leaves_a_busy_thread(query, call):
    if once(query, call):
        threading.Thread(target=max, args=(repeat(0.0, 1 << 22),)).start()
    return Verdict(True)


@kind(OK)
def waits_at_exit(query, call):
    if once(query, call):
        atexit.register(time.sleep, FOREVER)
    return Verdict(True)


@kind(OK)
def prints_300_megabytes(query, call):
    if once(query, call):
        for _ in range(300):
            os.write(1, b"x" * 999_999 + b"\n")
    return Verdict(True)


@kind(OK)
def prints_what_is_no_text(query, call):
    os.write(2, bytes(range(256)))
    return Verdict(True)


@kind(OK)
def leaves_a_file(query, call):
    if once(query, call):
        tempfile.mkstemp(prefix="faulty-")
    return Verdict(True)
