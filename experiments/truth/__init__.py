"""Certified labels: `prove` proposes, `check` decides, `label` does both."""

from __future__ import annotations

from typing import Iterable

from ofg import Query

from .checker import Check, check
from .label import Truth
from .prover import prove, uncertain

__all__ = ["Check", "Truth", "check", "label", "label_many", "prove"]


def label(query: Query) -> Truth:
    """Prove, then check. A label that its own checker refuses becomes "uncertain" with the checker's reason."""
    truth = prove(query)
    verdict = check(query, truth)
    return truth if verdict.ok else uncertain(f"the checker refused a proposed {truth.label}: {verdict.reason}")


def label_many(queries: Iterable[Query]) -> list[Truth]:
    """`label` for each query, in one process."""
    return [label(q) for q in queries]
