# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Which cases a page shows for each method: its misses, false alarms and late times."""

from __future__ import annotations

import pandas as pd

SHOWN = 24  # cases of each kind that the gallery can draw for each method


def gallery(found: pd.DataFrame) -> dict[str, list[str]]:
    """case -> the methods for which the gallery shows it.

    For each method, up to SHOWN misses and SHOWN false alarms, spread over scenarios and levels,
    and the SHOWN latest times.
    """
    wanted: dict[str, list[str]] = {}
    for label, part in found.groupby("method", sort=False):
        late = part[part.error > 0].sort_values("error", ascending=False)
        kinds = [
            _spread(part[part.outcome == "miss"]),
            _spread(part[part.outcome == "false alarm"]),
            late,
        ]
        for case in dict.fromkeys(c for kind in kinds for c in kind.case[:SHOWN]):
            wanted.setdefault(case, []).append(label)
    return wanted


def _spread(part: pd.DataFrame) -> pd.DataFrame:
    return part.assign(turn=part.groupby(["scenario", "level"]).cumcount()).sort_values(
        ["turn", "scenario", "level"], kind="stable"
    )
