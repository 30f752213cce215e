"""Times of a run for its page: those taken from Python, and those of the native lane."""

from __future__ import annotations

import numpy as np
import pandas as pd

from experiments.run.folder import given
from experiments.run.folder.store import Store, StoreError
from experiments.run.timing import FLOOR, LOST, PROBE, size_of

# of experiments/native.py: ours
NATIVE = {
    "apart": ("overlap", "apart"),
    "overlapping": ("overlap", "deep"),
    "flight": ("translation", "hit"),
}


def python(store: Store, rows: pd.DataFrame) -> dict:
    """lane -> method -> {cases, ns: medians over rounds; floors: [question, faces, situation, ns]};
    "python" where no lane is named.
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
    """The native lane of a run that has a native.csv (python -m experiments.native --out RUN).

    It times pairs of its own of given sizes, so no case of the run stands behind it.
    """
    if not store.has("native.csv"):
        return {}
    lane: dict[str, dict] = {}
    times = _native_rows(store)
    times = times.assign(sizes=size_of(times.faces))
    for row in times[
        times.method.isin(labels) & times.native.notna() & times.situation.isin(NATIVE)
    ].itertuples():
        lane.setdefault(row.method, {"cases": [], "bins": []})["bins"].append(
            [*NATIVE[row.situation], row.sizes, row.native]
        )
    return {"native": lane} if lane else {}


def _native_rows(store: Store) -> pd.DataFrame:
    path, wanted = (
        store.folder / "native.csv",
        {
            "method": str,
            "faces": float,
            "native": float,
            "situation": str,
        },
    )
    given.regular(path, "The file")
    try:
        return pd.read_csv(path, dtype=wanted, usecols=list(wanted))
    except (ValueError, OSError) as error:
        raise StoreError(
            f"{path} is no table of the native lane ({given.reason(error)}). Make it again with: "
            f"python -m experiments.native --out {store.folder}, or remove it."
        ) from error
