# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The certified answer to a query."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import nan
from typing import Any


@dataclass(frozen=True)
class Truth:
    """The label of a query, with its certificate.

    label: "hit", "clear" or "uncertain" (for a sweep: over the whole step).
    t_lo, t_hi: bracket of the time of impact of a hit sweep, clear over [0, t_lo] and overlapping
    at t_hi, both certified; rounded outward to doubles; 0, 0 if the sweep starts in overlap; NaN
    for overlap queries and clear sweeps. start, end: labels at t = 0 and t = 1 alone (for overlap
    queries both equal `label`). A hit with start and end "clear" is a tunnelling hit: a method that
    misses it tunnels. gap: signed distance, length. Positive: a certified lower bound on the
    clearance (for a sweep: the least over the step). Negative: minus an estimate of the penetration
    depth (for a sweep: the deepest found over the step). NaN if unknown. touching: clear, and the
    closed bodies share a point, with the certificate's `touching` as witness. Neither answer is
    wrong then. reason: why a label is uncertain. certificate: JSON-able; see
    experiments/truth/README.md. {} if uncertain.
    """

    label: str
    t_lo: float = nan
    t_hi: float = nan
    start: str = "uncertain"
    end: str = "uncertain"
    gap: float = nan
    reason: str = ""
    certificate: Mapping[str, Any] = field(default_factory=dict)
    touching: bool = False
