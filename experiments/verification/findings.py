# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The findings of a verification."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field

SHOWN = 40


@dataclass
class Findings:
    """refused: one sentence for each fault. notes: what was not checked, or cannot be. labels:
    for the cases without a fault, the number of each label; pieces: the same for the cases about
    pieces of meshes.
    """

    refused: list[str] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    labels: Counter = field(default_factory=Counter)
    pieces: Counter = field(default_factory=Counter)
    asked: int = 0

    @property
    def ok(self) -> bool:
        return not self.refused

    def refuse(self, where: str, what: str) -> None:
        self.refused.append(f"{where}: {what}")

    def note(self, words: str) -> None:
        self.notes.append(words)

    def __str__(self) -> str:
        n = self.labels
        head = (
            f"{n['hit'] + n['clear']} labels verified ({n['hit']} hit, {n['clear']} clear), "
            f"{n['uncertain']} uncertain, {len(self.refused)} refused."
        )
        p = self.pieces
        pieces = (
            [
                f"{p['hit'] + p['clear']} labels of pieces verified ({p['hit']} hit, {p['clear']} "
                f"clear), {p['uncertain']} uncertain."
            ]
            if p
            else []
        )
        asked = [f"{self.asked} answers repeated."] if self.asked else []
        more = len(self.refused) - SHOWN
        return "\n".join(
            [
                head,
                *pieces,
                *asked,
                *self.notes,
                *(f"refused: {r}" for r in self.refused[:SHOWN]),
                *([f"and {more} more refused"] if more > 0 else []),
            ]
        )
