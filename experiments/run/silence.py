# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Report methods that answered nothing in a run, with the reason: empty table cells do not
explain it.
"""

from __future__ import annotations

import pandas as pd

from .folder import given
from .folder.store import Store


def warnings(store: Store) -> list[str]:
    """A sentence for each reason, which names the methods that answered none of their cases for
    that reason.
    """
    rows = store.read("observations.parquet")
    answered = rows.assign(ok=rows.status == "ok").groupby("method", sort=False).ok.any()
    reasons: dict[str, list[str]] = {}
    for method in answered.index[~answered]:
        reasons.setdefault(_reason(rows[rows.method == method]), []).append(method)
    return [
        f"Warning: {', '.join(methods)} answered none of the {rows.case.nunique()} cases"
        f" ({reason})."
        for reason, methods in reasons.items()
    ]


def _reason(rows: pd.DataFrame) -> str:
    """The most frequent status and its detail, in short."""
    (status, detail), n = next(
        iter(
            rows.groupby(["status", "detail"], sort=False)
            .size()
            .sort_values(ascending=False)
            .items()
        )
    )
    share = "" if n == len(rows) else f" in {n} of them"
    return given.clipped(f"{status}{share}: {given.printable(detail)}".rstrip(": "))
