# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The files of a native study: rows.parquet, ratios.parquet, growths.parquet, native.md and
made.json.
"""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pandas as pd

from experiments.run.folder import manifest
from experiments.run.folder.store import Store

from .measuring import CELL, CONTESTANT
from .summary import COUNTS, RATIO


def save(folder: Path, rows: pd.DataFrame, page: str, made: dict, **further: pd.DataFrame) -> None:
    """Write all. rows: as `small` gives them. further: other frames from which the page was made,
    by the name of their file.
    """
    store = Store(folder)
    for name, frame in {"rows": rows, **further}.items():
        store.write(frame, f"{name}.parquet")
    store.write_text(page, "native.md")
    store.write_text(json.dumps(made, indent=1) + "\n", "made.json")


def small(rows: pd.DataFrame) -> pd.DataFrame:
    """The same with each word stored once; times to four digits, quotients to three."""
    words = {name: rows[name].astype("category") for name in ("class", "over", *CELL, *CONTESTANT)}
    digits = {"ns": 4, "build_ns": 4, "bytes": 4, **dict.fromkeys(RATIO, 3)}
    numbers = {name: rounded(rows[name], n).astype("float32") for name, n in digits.items()}
    counts = {name: rows[name].astype("Int32") for name in ("blocks", "built", *COUNTS)}
    return rows.assign(**words, **numbers, **counts)


def few_digits(ratios: pd.DataFrame) -> pd.DataFrame:
    """Ratios to three digits."""
    return ratios.assign(**{name: rounded(ratios[name].astype(float), 3) for name in RATIO})


def rounded(values: pd.Series, digits: int) -> pd.Series:
    """To so many significant digits."""
    sizes = np.floor(np.log10(values.abs().where(values != 0, 1)))
    unit = 10.0 ** (sizes - digits + 1)
    return (values / unit).round() * unit


def facts(**asked) -> dict:
    """What made.json says of the machine and the code, with what was asked."""
    return {
        "started": manifest.now(),
        "commit": manifest.commit(),
        "build": manifest.build(),
        "before": manifest.machine(),
        **asked,
    }


def for_report(rows: pd.DataFrame, labels: dict[str, str]) -> pd.DataFrame:
    """question, situation, faces, method, native: what the report of a run shows of it.

    labels: engine -> label of its twin in the run. Engines in their generic builds, as Python asks
    them; OFG in its widest instruction set.
    """
    widest = [name for name in ("generic", "x86-64-v3", "AVX-512") if (rows["class"] == name).any()]
    ours = rows.engine.str.startswith("ofg")
    chosen = rows[(rows["class"] == "generic") & ~ours]
    chosen = pd.concat([chosen, rows[(rows["class"] == widest[-1]) & ours]])
    chosen = chosen[chosen.engine.isin(labels) & (chosen.bodies == "convex")]
    return pd.DataFrame(
        {
            **{name: chosen[name] for name in ("question", "situation", "faces")},
            "method": chosen.engine.map(labels),
            "native": chosen.ns.astype(float).round(1),
        }
    )
