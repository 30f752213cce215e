# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The first contact of moving bodies, between two proved times."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .answer import Answer, Answers


@dataclass(frozen=True)
class Impact(Answer):
    """An `Answer` whose time is bracketed.

    time: until then the interiors are proved not to meet, so it is never later than the first
    contact. latest: a time at which they are proved to meet; 0 with `time` for bodies that overlap
    at the start. Both are shares of the step, NaN without a hit. proved: True if the answer is
    proved and latest - time is at most 1e-9. False for a hit whose contact is approached too slowly
    for that, where `latest` is later, and for one that could not be told from touching, where
    `latest` is NaN. A clear is always proved.
    """

    latest: float
    proved: bool


@dataclass(frozen=True, eq=False)
class Impacts(Answers):
    """The fields of `Impact` as arrays over n queries.

    latest: (n,) float64. proved: (n,) bool. The others as in `Answers`. impacts[i] is one Impact.
    """

    latest: np.ndarray = None  # type: ignore[assignment]
    proved: np.ndarray = None  # type: ignore[assignment]

    def __getitem__(self, i: int) -> Impact:
        answer = super().__getitem__(i)
        return Impact(**vars(answer), latest=float(self.latest[i]), proved=bool(self.proved[i]))
