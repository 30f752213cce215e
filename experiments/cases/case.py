# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""A case: a query and the scenario from which it was drawn."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from ofg import Query


@dataclass(frozen=True, eq=False)
class Case:
    """A query with its origin.

    id: "thin_wall/100/0007": scenario, level of difficulty, index. level: the value on the
    scenario's difficulty axis. tags: further keys by which a table may be split ({"feature":
    "edge-edge"}); strings or numbers. precision: "float32" if the scenario declares that every
    number is a float32 number, else "float64".
    """

    id: str
    scenario: str
    level: float
    index: int
    query: Query
    tags: Mapping[str, str | float] = field(default_factory=dict)
    precision: str = "float64"
