# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Verify labels with the checker alone, as a third party does with stored certificates."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from itertools import islice

from experiments.cases.label import Truth
from ofg import Query

from .checker import check_many

BATCH = 64


@dataclass
class Verification:
    """verified: certified labels ("hit", "clear") that the checker accepts, by label. uncertain:
    labels without a claim, by reason. refused: (position, label, reason) of every label that the
    checker does not accept: there should be none.
    """

    verified: Counter = field(default_factory=Counter)
    uncertain: Counter = field(default_factory=Counter)
    refused: list[tuple[int, str, str]] = field(default_factory=list)

    @property
    def ok(self) -> bool:
        return not self.refused

    def __str__(self) -> str:
        reasons = "".join(
            f"\n  {n} uncertain: {reason}" for reason, n in self.uncertain.most_common()
        )
        refusals = "".join(
            f"\n  refused: label {i} ({label}): {reason}" for i, label, reason in self.refused[:20]
        )
        more = f"\n  and {len(self.refused) - 20} more" if len(self.refused) > 20 else ""
        return (
            f"{sum(self.verified.values())} labels verified ({self.verified['hit']} hit,"
            f" {self.verified['clear']} clear), {sum(self.uncertain.values())} uncertain,"
            f" {len(self.refused)} refused{reasons}{refusals}{more}"
        )


def verify(
    labelled: Iterable[tuple[Query, Truth]], advance: Callable[[int], None] = lambda n: None
) -> Verification:
    """Check every (query, truth) with the checker alone; `advance(n)` is called after every n
    labels. Never raises.
    """
    result, labelled, position = Verification(), iter(labelled), 0
    while batch := list(islice(labelled, BATCH)):
        for (_, truth), verdict in zip(batch, check_many(batch)):
            if not verdict.ok:
                result.refused.append((position, truth.label, verdict.reason))
            elif truth.label == "uncertain":
                result.uncertain[truth.reason] += 1
            else:
                result.verified[truth.label] += 1
            position += 1
        advance(len(batch))
    return result
