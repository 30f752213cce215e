"""What became of a try: equal, an honest stop, or failed."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from pathlib import Path

from .command import Attempt, Ending

FILES = ("cases.parquet", "bodies.parquet", "observations.parquet")
EQUAL, HONEST, FAILED = "equal", "honest stop", "failed"
WORDS = 5  # that a reason has at least: "Aborted." names nothing
TRACEBACK = "Traceback (most recent call last)"


@dataclass(frozen=True)
class Outcome:
    """kind: EQUAL, HONEST or FAILED. why: in words, where it failed or stopped."""

    kind: str
    why: str = ""


def sums(folder: Path) -> tuple[str, ...]:
    """SHA-256 of each file of accuracy of a run; "missing" where one is."""
    paths = [folder / name for name in FILES]
    return tuple(
        hashlib.sha256(p.read_bytes()).hexdigest() if p.is_file() else "missing" for p in paths
    )


def misconduct(ending: Ending) -> str:
    """What no end of a command may show, or nothing."""
    if ending.code is None:
        return "it hung"
    if TRACEBACK in ending.text:
        return f"a traceback: {ending.reason}"
    if ending.orphans:
        left = ", ".join(ending.orphans)
        return f"exit code {ending.code}, left behind {len(ending.orphans)}: {left}"
    return ""


def settle(attempt: Attempt, ending: Ending, halts: frozenset[int] = frozenset()) -> Outcome:
    """The outcome of a command that ended so. halts: exit codes that the fault itself accounts
    for.

    Where it stopped, the same command is said again; it must then finish with the files of the
    undisturbed run.
    """
    if bad := misconduct(ending):
        return Outcome(FAILED, bad)
    if ending.code == 0:
        return _compare(attempt)
    if ending.code not in halts:
        if ending.code != 1:
            return Outcome(FAILED, f"exit code {ending.code}: {ending.reason}")
        if len(ending.reason.split()) < WORDS:
            return Outcome(FAILED, f"exit code 1 without a reason: '{ending.reason}'")
    again = attempt.say()
    if bad := misconduct(again):
        return Outcome(FAILED, f"said again: {bad}")
    if again.code:
        return Outcome(FAILED, f"said again, it refused with {again.code}: {again.reason}")
    found = _compare(attempt)
    if found.kind == EQUAL and ending.code not in halts:
        return Outcome(HONEST, ending.reason)
    return found


def _compare(attempt: Attempt) -> Outcome:
    found = sums(attempt.folder)
    changed = [name for name, a, b in zip(FILES, found, attempt.bench.sums) if a != b]
    return (
        Outcome(FAILED, f"exit code 0 with other bytes: {', '.join(changed)}")
        if changed
        else Outcome(EQUAL)
    )
