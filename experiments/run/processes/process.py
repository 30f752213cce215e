# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Linux facilities that leave no process behind: signals at a parent's death, and adoption of
orphans.
"""

from __future__ import annotations

import contextlib
import ctypes
import os
import signal

import psutil

_PR_SET_PDEATHSIG, _PR_SET_CHILD_SUBREAPER = 1, 36
_libc = ctypes.CDLL(None, use_errno=True)


def signal_at_parents_death(which: int) -> None:
    """This process gets the signal when the thread that started it ends."""
    _libc.prctl(_PR_SET_PDEATHSIG, which, 0, 0, 0)


def adopt_orphans(yes: bool = True) -> None:
    """Descendants of this process that lose their parent become its children instead of init's."""
    _libc.prctl(_PR_SET_CHILD_SUBREAPER, int(yes), 0, 0, 0)


def kill_group(leader: int) -> None:
    """Kill a process group, which may be gone."""
    with contextlib.suppress(ProcessLookupError, PermissionError):
        os.killpg(leader, signal.SIGKILL)


def kill_children(variable: str = "", value: str = "") -> None:
    """Kill every child, and the orphans adopted as a result, until none is left, not even a zombie.

    variable, value: only those in whose environment this was set.
    """
    while found := [
        c for c in psutil.Process().children() if not variable or _has(c, variable, value)
    ]:
        for child in found:
            with contextlib.suppress(ProcessLookupError, PermissionError):
                os.kill(child.pid, signal.SIGKILL)
        for child in found:
            with contextlib.suppress(ChildProcessError):
                os.waitpid(child.pid, 0)


def _has(process: psutil.Process, variable: str, value: str) -> bool:
    try:
        return process.environ().get(variable) == value
    except psutil.Error:  # a zombie has none: the process that knows it waits for it
        return False
