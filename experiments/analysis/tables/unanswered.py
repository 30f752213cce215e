# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The table of unanswered cases, with the reason."""

from __future__ import annotations

import pandas as pd

from .table import Table


def trouble_table(found: pd.DataFrame) -> Table:
    lost = found[(found.status != "ok") & ~found.detail.str.startswith("does not answer")].assign(
        detail=lambda t: t.detail.str.slice(0, 60)
    )
    counts = (
        lost.groupby(["method", "status", "detail"], sort=False)
        .size()
        .rename("cases")
        .reset_index()
    )
    return Table(
        "unanswered",
        "Unanswered cases, with the reason.",
        "None of them is counted as a miss.",
        counts,
        counts.astype(str),
    )
