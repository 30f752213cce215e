# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""One kind of fault."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from ofg import Query

ERROR, TIMEOUT, OK = "error", "timeout", "ok"
KINDS: dict[str, Kind] = {}


@dataclass(frozen=True)
class Kind:
    """act(query, call): the behaviour of the method for a query; call counts from 1, and exceeds 1
    only during timing.

    name: of the method. statuses: allowed in its rows. slow: it waits until the wall deadline.
    built: it is already faulty in `prepare`.
    """

    name: str
    act: Callable[[Query, int], Any]
    statuses: frozenset[str]
    slow: bool = False
    built: bool = False


def kind(*statuses: str, slow: bool = False, built: bool = False):
    """Register the function as a kind, named after it."""

    def keep(act):
        name = "faulty-" + act.__name__.strip("_").replace("_", "-")
        KINDS[name] = Kind(name, act, frozenset(statuses), slow, built)
        return act

    return keep


def once(query: Query, call: int) -> bool:
    """Whether to do long or large work: only for the single motion query of the drill's
    configuration, not during timing.
    """
    return call == 1 and query.question == "motion"
