# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The query times of a run for its page: from Python, and from the native benchmark."""

from __future__ import annotations

import numpy as np
import pandas as pd

from experiments.run.folder import given
from experiments.run.folder.store import Store, StoreError
from experiments.run.timing import FLOOR, LOST, PROBE


def python(store: Store, rows: pd.DataFrame) -> dict:
    """lane -> method -> {cases, ns: medians over rounds; build; floors: [question, faces,
    situation, ns]}; rows without a lane belong to "python".
    """
    place = {case: i for i, case in enumerate(rows.case)}
    times = store.read("timings.parquet")
    times = times[~times.method.isin([PROBE, LOST])]
    times = times.assign(
        ns=[float(np.median(r)) for r in times.rounds_ns],
        lane=times.lane if "lane" in times else "python",
    )
    found: dict[str, dict] = {}
    for (lane, label), part in times.groupby(["lane", "method"], sort=False):
        floor, real = part[part.case == FLOOR], part[part.case != FLOOR]
        found.setdefault(lane, {})[label] = {
            "cases": [place[c] for c in real.case],
            "ns": real.ns.tolist(),
            "build": real.build_ns.tolist(),
            "floors": floor[["question", "faces", "situation", "ns"]].values.tolist(),
        }
    return found


def native(store: Store, labels: set[str]) -> dict:
    """The native times of a run that has tables/native.csv (ofg-bench native RUN), else {}.

    They are medians over some of its certified cases, by question, situation and range of faces.
    """
    if not store.has("tables", "native.csv"):
        return {}
    lane: dict[str, dict] = {}
    times = _native_rows(store)
    for row in times[times.method.isin(labels) & times.native.notna()].itertuples():
        place = [row.question, row.situation, row.faces, row.native]
        lane.setdefault(row.method, {"cases": [], "bins": []})["bins"].append(place)
    return {"native": lane} if lane else {}


def _native_rows(store: Store) -> pd.DataFrame:
    path = store.folder / "tables" / "native.csv"
    words = dict.fromkeys(("question", "situation", "faces", "method"), str)
    wanted = {**words, "native": float}
    given.regular(path, "The file")
    try:
        return pd.read_csv(path, dtype=wanted, usecols=list(wanted))
    except (ValueError, OSError) as error:
        raise StoreError(
            f"{path} is not a table of native times ({given.reason(error)}). Write it again with:"
            f" ofg-bench native {store.folder}, or remove it."
        ) from error
