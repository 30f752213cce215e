# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The data of the page: the rows of a run, column by column, and the bodies of the cases that it
can draw, in bytes.
"""

from __future__ import annotations

import base64
import gzip
import json
import math

import numpy as np
import pandas as pd

import ofg
from baselines import registry
from baselines.contract import Method
from baselines.label import curve_of, name_of
from experiments.analysis import costs, nesting, outcome, tables, views
from experiments.analysis.tables.methods import UNKNOWN
from experiments.cases import families
from experiments.run import piece_truth
from experiments.run.bins import SIZES, situation_of, size_of
from experiments.run.folder.rows import MOTION, body_row, cases_of, filled
from experiments.run.folder.store import Store
from experiments.run.progress import stage

from . import glossary, lanes
from .gallery import gallery
from .shapes import BYTES, Shapes

CODES = {
    "right": "r",
    "miss": "m",
    "false alarm": "f",
    "contained": "i",
    "touching": "b",
    "no label": "n",
    "unsupported": "u",
    "error": "e",
    "timeout": "t",
}
OVERLAYS = 12  # OFG configurations whose selections are embedded for one case


def of_run(store: Store, made_tables=None) -> dict:
    """All data of the page of a run; page/data.js decodes it."""
    rows, found = filled(nesting.of(store, store.read("cases.parquet"))), outcome.outcomes(store)
    made = {
        "mode": "run",
        "run": _run(store),
        "codes": {code: name for name, code in CODES.items()},
        "cases": _cases(rows),
        "sizes": [name for _, name in SIZES],
        "bands": views.gap_bands(pd.Series([], dtype=float))[1],
        "scenarios": _scenarios(rows),
        "terms": glossary.terms(),
        **_observations(found, rows),
    }
    made["methods"] = [_method(label, made["run"]["versions"]) for label in made["labels"]]
    made["lanes"] = {
        **(lanes.python(store, rows) if store.has("timings.parquet") else {}),
        **lanes.native(store, set(made["labels"])),
    }
    made["tables"] = [_table(t, found) for t in made_tables or tables.build(store)]
    return {**made, **_shapes(store, rows, found)}


def of_case(
    case,
    truth,
    row: dict,
    observations: pd.DataFrame,
    versions: dict,
    refused: str = "",
    pieces: pd.DataFrame | None = None,
) -> dict:
    """The data of the page of one case: `row` is its row of cases.parquet, `observations` the
    answers to it, `pieces` its row of pieces.parquet, if any.

    refused: why the checker rejects its label, or "".
    """
    rows = nesting.added(
        filled(pd.DataFrame([row])),
        pd.DataFrame([body_row(b) for b in (case.query.a, case.query.b)]),
    )
    found = outcome.judge(observations, rows, pieces)
    made = {
        "mode": "case",
        "run": {"versions": versions, **({"refused": refused} if refused else {})},
        "codes": {code: name for name, code in CODES.items()},
        "cases": _cases(rows),
        "sizes": [name for _, name in SIZES],
        "bands": views.gap_bands(pd.Series([], dtype=float))[1],
        "scenarios": _scenarios(rows),
        "lanes": {},
        "tables": [],
        **_observations(found, rows),
    }
    made["methods"] = [_method(label, versions) for label in made["labels"]]
    shapes = Shapes(float("inf"), anew=True)
    shapes.add(
        0,
        case,
        truth,
        [label for label in made["labels"] if name_of(label) == "ofg"],
        len(made["labels"]),
    )
    return {**made, **shapes.packed()}


def encode(payload: dict) -> str:
    """JSON, gzip, base64, which page/data.js decodes with DecompressionStream. Equal payloads give
    equal bytes.
    """
    return pack(json.dumps(_plain(payload), allow_nan=False, separators=(",", ":")).encode())


def pack(content: bytes) -> str:
    return base64.b64encode(gzip.compress(content, 9, mtime=0)).decode()


def _run(store: Store) -> dict:
    facts = store.facts
    noise = costs.noise(store) if store.has("timings.parquet") else math.nan
    return {
        "name": store.folder.resolve().name,
        "title": store.config.title or store.folder.resolve().name,
        "about": store.config.about,
        "noise": noise,
        "config": json.loads(store.config.model_dump_json()),
        **facts,
    }


def _cases(rows: pd.DataFrame) -> dict:
    relative = rows.gap / rows["size"]
    situation = situation_of(rows).where(rows.label != "uncertain", "uncertain")
    columns = [
        "case",
        "scenario",
        "level",
        "question",
        "label",
        "t_lo",
        "t_hi",
        "start",
        "end",
        "gap",
        "touching",
        "reason",
        "kind",
        "size",
        "faces",
        *MOTION,
        "quaternion_a",
        "position_a",
        "quaternion_b",
        "position_b",
        "attempt",
    ]
    made = {name: rows[name].tolist() for name in columns}
    made.update(
        tags=[json.loads(t) for t in rows.tags],
        situation=situation.tolist(),
        sizes=size_of(rows.faces).tolist(),
        band=views.gap_bands(relative)[0].where(relative.notna(), None).tolist(),
        relative=relative.tolist(),
    )
    return made


def _scenarios(rows: pd.DataFrame) -> dict:
    known = families.scenarios()
    return {
        name: {"axis": known[name].axis, "exposes": known[name].exposes}
        for name in rows.scenario.unique()
        if name in known
    }


def _method(label: str, versions: dict) -> dict:
    name = name_of(label)
    cls = registry.methods().get(name)
    if cls is None:
        return {
            "label": label,
            "name": name,
            "curve": label,
            "engine": name,
            "configuration": "",
            "solid": None,
            "tolerance": "unknown",
            "guarantee": UNKNOWN,
            "answers": [],
            "bodies": [],
        }
    try:
        (method,) = registry.make(label)
    except (ValueError, ImportError):
        method = cls
    return {
        "label": label,
        "name": name,
        "curve": curve_of(label),
        "engine": cls.engine,
        "version": versions.get(cls.engine),
        "configuration": method.configuration,
        "solid": method.solid,
        "tolerance": str(method.tolerance) if isinstance(method, Method) else "unknown",
        "guarantee": cls.guarantee,
        "answers": [q for q in ofg.QUESTIONS if q in cls.questions],
        "bodies": sorted(cls.bodies),
    }


def _observations(found: pd.DataFrame, rows: pd.DataFrame) -> dict:
    """labels; outcome: for each method, one letter per case ("." if there is no row); time, error,
    detail: sparse.

    truth, sparse: the label and whether the method can tunnel, if it is judged by pieces.
    """
    place = {case: i for i, case in enumerate(rows.case)}
    labels = list(dict.fromkeys(found.method))
    made = {
        "labels": labels,
        "outcome": [],
        "time": [],
        "error": [],
        "detail": [],
        "details": [],
        "truth": [],
    }
    known: dict[str, int] = {}
    for _, part in found.groupby(pd.Categorical(found.method, labels), observed=True):
        letters = ["."] * len(rows)
        at = part.case.map(place)
        for i, what, within in zip(at, part.outcome, part.within):
            letters[i] = CODES[what].upper() if within else CODES[what]
        made["outcome"].append("".join(letters))
        for name in ("time", "error"):
            there = part[name].notna()
            made[name].append([at[there].tolist(), part[name][there].tolist()])
        own = part.truth == piece_truth.PIECES
        made["truth"].append(
            [at[own].tolist(), part.label[own].tolist(), part.can_tunnel[own].tolist()]
        )
        said = part.detail.fillna("") != ""
        made["detail"].append(
            [at[said].tolist(), [known.setdefault(d, len(known)) for d in part.detail[said]]]
        )
    made["details"] = list(known)
    return made


def _table(table, found: pd.DataFrame) -> dict:
    from .cells import links

    return {
        "name": table.name,
        "title": table.title,
        "caption": table.caption,
        "columns": [str(c) for c in table.text.columns],
        "own": table.choice is not None,
        "rows": table.text.astype(str).values.tolist(),
        "links": links(table, found),
    }


def _shapes(store: Store, rows: pd.DataFrame, found: pd.DataFrame) -> dict:
    """Bodies, certificates and OFG's selections of the cases that can be drawn: first the cases of
    the gallery, then the others while there is room.
    """
    wanted = gallery(found)
    order = list(dict.fromkeys([*wanted, *rows.case]))
    place = {case: i for i, case in enumerate(rows.case)}
    known = {case.id: (case, truth) for case, truth in cases_of(rows, store.read("bodies.parquet"))}
    shapes, ours = Shapes(BYTES), found[found.method.map(name_of) == "ofg"]
    first = ours.method.iloc[:1].tolist()
    wrong = ours[ours.wrong | (ours.error > 0)].groupby("case", sort=False).method.agg(list)
    with stage("draw cases for the page", len(order)) as advance:
        for i in order:
            labels = [label for label in wanted.get(i, ()) if name_of(label) == "ofg"]
            labels = list(dict.fromkeys([*labels, *wrong.get(i, [])]))
            shapes.add(place[i], *known[i], labels or first, OVERLAYS)
            advance(1)
    return shapes.packed()


def _plain(value):
    """The value with NaN and infinities replaced by None, as JSON has neither, and numpy numbers by
    Python's.
    """
    if isinstance(value, dict):
        return {str(k): _plain(v) for k, v in value.items()}
    if isinstance(value, (list, tuple, np.ndarray)):
        return [_plain(v) for v in value]
    if isinstance(value, np.generic):
        value = value.item()
    return None if isinstance(value, float) and not math.isfinite(value) else value
