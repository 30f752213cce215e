# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Changes that a method may make to its surroundings."""

from __future__ import annotations

import builtins
import ctypes
import gc
import json
import locale
import os
import pickle
import signal
import sys
import tempfile
import time

import numpy as np

from baselines.contract import Verdict

from .kind import ERROR, OK, kind


def _changing(name: str, change, *statuses: str) -> None:
    def act(query, call):
        change()
        return Verdict(True)

    act.__name__ = name
    kind(*(statuses or (OK,)))(act)


def _fail(*arguments, **more):
    raise RuntimeError("patched by a faulty method")


def _enter_and_delete() -> None:
    folder = tempfile.mkdtemp()
    os.chdir(folder)
    os.rmdir(folder)


def _set_locale() -> None:
    for name in ("de_DE.UTF-8", "tr_TR.UTF-8", "C"):
        try:
            locale.setlocale(locale.LC_ALL, name)
            return
        except locale.Error:
            pass


def _round_upward() -> None:
    ctypes.CDLL("libm.so.6").fesetround(0x800)


def _reset_signals() -> None:
    for number in signal.valid_signals() - {signal.SIGKILL, signal.SIGSTOP}:
        signal.signal(number, signal.SIG_DFL)


def _is_open(fd: int) -> bool:
    try:
        os.fstat(fd)
        return True
    except OSError:
        return False


def _low() -> None:
    depth, frame = 0, sys._getframe()
    while frame:
        depth, frame = depth + 1, frame.f_back
    sys.setrecursionlimit(depth + 60)


_changing("changes_folder", lambda: os.chdir("/"))
_changing("deletes_its_folder", _enter_and_delete)
_changing("clears_the_environment", os.environ.clear)
_changing("sets_a_locale", _set_locale)
_changing("numpy_errors_raise", lambda: np.seterr(all="raise"))
_changing("numpy_prints_otherwise", lambda: np.set_printoptions(precision=1, threshold=1))
_changing("rounds_upward", _round_upward)
_changing("resets_signals", _reset_signals, OK, ERROR)
_changing("closes_its_output", lambda: [os.close(fd) for fd in range(3) if _is_open(fd)])
_changing("closes_sys_stdout", lambda: (sys.stdout.close(), sys.stderr.close()))
_changing("closes_every_file", lambda: os.closerange(3, 4096), OK, ERROR)
_changing("sets_umask", lambda: os.umask(0o777))
_changing("stops_the_collector", gc.disable)
_changing(
    "patches_json", lambda: [setattr(json, n, _fail) for n in ("dump", "dumps", "load", "loads")]
)
_changing(
    "patches_pickle",
    lambda: [setattr(pickle, n, _fail) for n in ("dump", "dumps", "load", "loads")],
    OK,
    ERROR,
)
_changing("patches_open", lambda: setattr(builtins, "open", _fail), OK, ERROR)
_changing(
    "patches_time",
    lambda: [setattr(time, n, lambda: "soon") for n in ("time", "perf_counter", "monotonic")],
    OK,
    ERROR,
)
_changing("empties_modules", sys.modules.clear, OK, ERROR)
_changing("recursion_limit_of_sixty", _low, OK, ERROR)
_changing("sets_a_trace", lambda: sys.settrace(_fail), OK, ERROR)
_changing("sets_a_hook", lambda: setattr(sys, "excepthook", _fail))
_changing("lowest_priority", lambda: os.nice(19))
_changing("one_core", lambda: os.sched_setaffinity(0, {min(os.sched_getaffinity(0))}))
