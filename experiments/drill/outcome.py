# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The outcome of a try: equal, an honest stop, or failed."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from pathlib import Path

from .command import Attempt, Ending

FILES = ("cases.parquet", "bodies.parquet", "observations.parquet")
EQUAL, HONEST, FAILED = "equal", "honest stop", "failed"
WORDS = 5  # minimum length of a reason: "Aborted." gives none
TRACEBACK = "Traceback (most recent call last)"


@dataclass(frozen=True)
class Outcome:
    """kind: EQUAL, HONEST or FAILED. why: the reason, if it failed or stopped."""

    kind: str
    why: str = ""


def sums(folder: Path) -> tuple[str, ...]:
    """SHA-256 of each file of accuracy of a run; "missing" if there is none."""
    paths = [folder / name for name in FILES]
    return tuple(
        hashlib.sha256(p.read_bytes()).hexdigest() if p.is_file() else "missing" for p in paths
    )


def misconduct(ending: Ending) -> str:
    """A fault that no command may show at its end, or ""."""
    if ending.code is None:
        return "it hung"
    if TRACEBACK in ending.text:
        return f"a traceback: {ending.reason}"
    if ending.orphans:
        left = ", ".join(ending.orphans)
        return f"exit code {ending.code}, left behind {len(ending.orphans)}: {left}"
    return ""


def settle(attempt: Attempt, ending: Ending, halts: frozenset[int] = frozenset()) -> Outcome:
    """The outcome of a command with this ending. halts: exit codes that the fault itself accounts
    for.

    If it stopped, the same command is repeated; it must then finish with the files of the
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
        return Outcome(FAILED, f"repeated: {bad}")
    if again.code:
        return Outcome(FAILED, f"repeated, it refused with {again.code}: {again.reason}")
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
