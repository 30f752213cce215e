# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The table of a drill."""

from __future__ import annotations

from collections import Counter, defaultdict

from tabulate import tabulate

from .outcome import EQUAL, FAILED, HONEST, Outcome

HEADS = ("fault", "tries", "equal", "honest stops", "failed", "missed", "note")
SHOWN = 20  # failures reported per fault


class Tally:
    """Counts outcomes by fault, in the order in which faults first appear."""

    def __init__(self):
        self.counts: dict[str, Counter] = defaultdict(Counter)
        self.whys: list[tuple[str, str, str]] = []
        self.notes: dict[str, str] = {}

    def name(self, fault: str, note: str) -> None:
        self.counts[fault], self.notes[fault] = Counter(), note

    def add(self, fault: str, what: str, outcome: Outcome | None) -> None:
        """what: a description that allows repeating the try. None: the fault never struck."""
        self.counts[fault][outcome.kind if outcome else "missed"] += 1
        if outcome and outcome.why:
            self.whys.append((fault, f"{outcome.kind}, {what}", outcome.why))

    @property
    def failed(self) -> int:
        """Tries that failed; a fault that never struck has shown nothing, and counts as one."""
        return sum(c[FAILED] + (not c[EQUAL] + c[HONEST] + c[FAILED]) for c in self.counts.values())

    def text(self, form: str = "simple") -> str:
        """form: of tabulate, "github" for Markdown."""
        rows = [
            (
                fault,
                sum(c.values()) - c["missed"],
                c[EQUAL],
                c[HONEST],
                c[FAILED],
                c["missed"],
                self.notes[fault],
            )
            for fault, c in self.counts.items()
        ]
        return tabulate(rows, HEADS, tablefmt=form)

    def reasons(self) -> list[str]:
        """A line for each failure and each honest stop, at most SHOWN per fault; equal ones are
        reported once.
        """
        kept: dict[str, Counter] = defaultdict(Counter)
        for fault, what, why in self.whys:
            kept[fault][what.split(",")[0] + ": " + " ".join(why.split())] += 1
        return [
            f"{fault}, {n} x {why}"
            for fault, whys in kept.items()
            for why, n in whys.most_common(SHOWN)
        ]
