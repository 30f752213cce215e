# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The documented tolerance of an engine: declared by each method and credited to each by one
rule.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

SIDES = ("both", "alarms", "misses")


@dataclass(frozen=True)
class Tolerance:
    """The distance up to which an answer may be wrong by the engine's documentation: the sum of
    three parts.

    length: in the units of the query. relative: a share of the size of the larger body. step: a
    share of the path of the step, which is the length of the displacement plus angle times size.
    sides: "alarms" (a clear pair reported as a hit), "misses" or "both". ValueError for a negative
    number or another side.
    """

    length: float = 0.0
    relative: float = 0.0
    step: float = 0.0
    sides: str = "both"

    def __post_init__(self):
        if self.sides not in SIDES or not all(
            0 <= v < np.inf for v in (self.length, self.relative, self.step)
        ):
            raise ValueError(
                f"{self} is not a tolerance: use numbers from 0 on, and sides one of "
                f"{', '.join(SIDES)}."
            )

    def reach(self, size, path):
        """The distance, for bodies of this size and a step of this path: floats or (n,) arrays."""
        return self.length + self.relative * np.asarray(size) + self.step * np.asarray(path)

    def covers(self, side: str) -> bool:
        """Whether it covers a side, "alarms" or "misses"."""
        return self.sides in ("both", side)

    def __str__(self):
        parts = [
            f"{self.length:g}" if self.length else "",
            f"{self.relative:g} of the size" if self.relative else "",
            f"{self.step:g} of the step" if self.step else "",
        ]
        said = " + ".join(filter(None, parts)) or "none"
        return said if said == "none" or self.sides == "both" else f"{said} ({self.sides})"


NONE = Tolerance()
