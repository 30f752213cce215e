# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Certified labels: `prove` proposes a label, `check` decides, `label` does both."""

from __future__ import annotations

from collections.abc import Iterable

from experiments.cases.label import Truth
from ofg import Query

from .check.checker import Check, check, check_many
from .check.verify import Verification, verify
from .prove.prover import prove, uncertain

__all__ = [
    "Check",
    "Truth",
    "Verification",
    "check",
    "check_many",
    "label",
    "label_many",
    "prove",
    "verify",
]


def label(query: Query) -> Truth:
    """Prove, then check. A label that the checker refuses becomes "uncertain" with the checker's
    reason.
    """
    return label_many([query])[0]


def label_many(queries: Iterable[Query]) -> list[Truth]:
    """`label` for each query, in one process; the checker's double arithmetic is batched over
    all of them.
    """
    queries = list(queries)
    truths = [prove(q) for q in queries]
    checks = check_many(zip(queries, truths))
    return [
        t if c.ok else uncertain(f"the checker refused a proposed {t.label}: {c.reason}")
        for t, c in zip(truths, checks)
    ]
