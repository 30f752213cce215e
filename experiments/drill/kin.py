# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Find the processes of a run from outside: by a mark in their environment, and by their position
below the runner.

Every process of a drill's run inherits the variable MARK; /proc keeps the environment with which a
process started, so a change of its environment, a new session or the death of its parent does not
hide it.
"""

from __future__ import annotations

import psutil

MARK = "OFG_DRILL"
WORKER, SERVER = "worker", "fork server"
_GONE = (psutil.NoSuchProcess, psutil.AccessDenied, psutil.ZombieProcess)


def marked(mark: str) -> list[psutil.Process]:
    """All living processes whose mark has this prefix, without zombies."""
    found = (p for p in psutil.process_iter() if _environment(p).get(MARK, "").startswith(mark))
    return [p for p in found if _alive(p)]


def below(runner: int, role: str) -> list[psutil.Process]:
    """Processes of the runner in a role.

    SERVER: its children that have children of their own, or whose command line names a fork server.
    WORKER: the processes below a server, and the runner's other children, except Python's resource
    tracker, which answers nothing.
    """
    try:
        children = [
            p for p in psutil.Process(runner).children() if "resource_tracker" not in _command(p)
        ]
        servers = [p for p in children if "forkserver" in _command(p) or p.children()]
        if role == SERVER:
            return servers
        return [p for p in children if p not in servers] + [
            w for s in servers for w in s.children(recursive=True)
        ]
    except _GONE:
        return []


def describe(process: psutil.Process) -> str:
    """The end of its command line, without its number, so that equal ones are reported once."""
    return " ".join(_command(process).split()[1:])[:60] or "a process"


def end(processes: list[psutil.Process]) -> None:
    """kill -9, whatever their state; afterwards they are gone, or zombies."""
    for process in processes:
        send(process, "kill")
    psutil.wait_procs(processes, timeout=2.0)


def send(process: psutil.Process, what: str) -> bool:
    """Call `kill`, `suspend` or `resume` of a process that may be gone; returns whether it
    existed.
    """
    try:
        getattr(process, what)()
        return True
    except _GONE:
        return False


def _environment(process: psutil.Process) -> dict[str, str]:
    try:
        return process.environ()
    except (*_GONE, OSError):
        return {}


def _alive(process: psutil.Process) -> bool:
    try:
        return process.status() != psutil.STATUS_ZOMBIE
    except _GONE:
        return False


def _command(process: psutil.Process) -> str:
    try:
        return " ".join(process.cmdline())
    except _GONE:
        return ""
