"""One way of being faulty."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from ofg import Query

ERROR, TIMEOUT, OK = "error", "timeout", "ok"
KINDS: dict[str, Kind] = {}


@dataclass(frozen=True)
class Kind:
    """act(query, call): what the method does when it is asked; call counts from 1, and is beyond 1
    only while time is taken.

    name: of the method. statuses: which its rows may have. slow: it waits until the wall deadline.
    built: it is faulty in `prepare` already.
    """

    name: str
    act: Callable[[Query, int], Any]
    statuses: frozenset[str]
    slow: bool = False
    built: bool = False


def kind(*statuses: str, slow: bool = False, built: bool = False):
    """Keep the function as a kind; its name says what it does."""

    def keep(act):
        name = "faulty-" + act.__name__.strip("_").replace("_", "-")
        KINDS[name] = Kind(name, act, frozenset(statuses), slow, built)
        return act

    return keep


def once(query: Query, call: int) -> bool:
    """Whether to do what takes long or much: at the one question of motion of the drill's
    configuration, not while timing.
    """
    return call == 1 and query.question == "motion"
