"""The processes of a run, found from outside: by a mark in their environment, and by their place
below the runner.

Every process of a drill's run inherits the variable MARK; /proc keeps what a process was started
with, so that neither a change of its environment nor a new session nor the death of its parent
hides it.
"""

from __future__ import annotations

import psutil

MARK = "OFG_DRILL"
WORKER, SERVER = "worker", "fork server"
_GONE = (psutil.NoSuchProcess, psutil.AccessDenied, psutil.ZombieProcess)


def marked(mark: str) -> list[psutil.Process]:
    """All living processes whose mark begins so; a zombie is none."""
    found = (p for p in psutil.process_iter() if _environment(p).get(MARK, "").startswith(mark))
    return [p for p in found if _alive(p)]


def below(runner: int, role: str) -> list[psutil.Process]:
    """Processes of the runner in a role.

    SERVER: its children that have children of their own, or whose command line names a fork
    server. WORKER: what is below a server, and the runner's other children, except Python's
    resource tracker, which answers nothing.
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
    """The end of its command line, for a message: what is alike is told once, so without its
    number.
    """
    return " ".join(_command(process).split()[1:])[:60] or "a process"


def end(processes: list[psutil.Process]) -> None:
    """kill -9, whatever state they are in; they are gone, or zombies, afterwards."""
    for process in processes:
        send(process, "kill")
    psutil.wait_procs(processes, timeout=2.0)


def send(process: psutil.Process, what: str) -> bool:
    """Call `kill`, `suspend` or `resume` of a process that may be gone; whether it was there."""
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
