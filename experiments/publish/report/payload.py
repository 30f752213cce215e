"""The data of the page: the rows of a run, column by column, and the bodies of the cases that it
can draw, in bytes.
"""

from __future__ import annotations

import base64
import gzip
import json
import math
from collections.abc import Iterable
from dataclasses import replace
from typing import Any

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
from experiments.run.folder.rows import MOTION, body_row, cases_of, filled
from experiments.run.folder.store import Store
from experiments.run.progress import stage
from experiments.run.timing import SIZES, situation_of, size_of
from ofg import Body, Query
from ofg.decomposition import kept_at

from . import glossary, lanes, selection
from .certificate import drawable

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
SHOWN = 24  # cases of each kind that the gallery can draw for each method
BYTES = 8_000_000  # limit on the bodies of a page, before compression
CASES = 3_000  # limit on the cases that a page can draw, which bounds the time to make it
EXACT = 5_000  # bodies of up to this many vertices are never rounded
# A larger selection is not drawn; for k = inf on a large mesh the page gives only its size.
SELECTED = 2_000
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
    shapes, ours = Shapes(BYTES), found[found.method.str.split().str[0] == "ofg"]
    first = ours.method.iloc[:1].tolist()
    wrong = ours[ours.wrong | (ours.error > 0)].groupby("case", sort=False).method.agg(list)
    with stage("draw cases for the page", len(order)) as advance:
        for i in order:
            labels = [label for label in wanted.get(i, ()) if name_of(label) == "ofg"]
            labels = list(dict.fromkeys([*labels, *wrong.get(i, [])]))
            shapes.add(place[i], *known[i], labels or first, OVERLAYS)
            advance(1)
    return shapes.packed()


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


class Shapes:
    """Collects bodies (each once), certificates and selections, up to `room` bytes of bodies."""

    def __init__(self, room: float, anew: bool = False):
        """anew: whether to decompose meshes, which can take a minute each; otherwise OFG's pieces
        are shown only if the run left them in the cache.
        """
        self.room, self.anew, self.bytes = room, anew, bytearray()
        self.bodies, self.drawn, self.proofs, self.ofg = [], {}, {}, {}
        self._known: dict[str, int] = {}
        self._decomposed: dict[str, Body] = {}

    def add(self, place: int, case, truth, labels: Iterable[str], most: int) -> None:
        q = case.query
        cost = sum(
            _cost(body)
            for body in {b.digest: b for b in (q.a, q.b)}.values()
            if body.digest not in self._known
        )
        if len(self.bytes) + cost > self.room or len(self.drawn) == CASES:
            return
        self.drawn[place] = [self._body(q.a), self._body(q.b)]
        self.proofs[place] = drawable(truth.certificate)
        for label in list(labels)[:most]:
            made = self._trace(q, label, truth)
            if made:
                self.ofg.setdefault(place, {})[label] = made

    def packed(self) -> dict:
        return {
            "bodies": self.bodies,
            "drawn": self.drawn,
            "proofs": self.proofs,
            "ofg": self.ofg,
            "bytes": bytes(self.bytes),
        }

    def _trace(self, query: Query, label: str, truth) -> dict | None:
        """OFG's selections; None if the method refuses the query or its pieces are not in the
        cache. "bodies": indices of the bodies in the query, which may be pieces of a mesh.
        """
        (method,) = registry.make(label)
        options = {**method.options()}
        if method.decomposes:
            if not self.anew and not all(
                body.kind != "mesh" or kept_at(body).is_file() for body in (query.a, query.b)
            ):
                return None
            try:
                pieces = [self._pieces(query.a), self._pieces(query.b)]
            except ofg.BodyError:
                return None
            query = replace(query, a=pieces[0], b=pieces[1])
        made = selection.trace(query, options, truth.t_hi)
        for side in ("a", "b"):
            made[f"n{side}"] = len(made[side])
            made[side] = made[side] if len(made[side]) <= SELECTED else []
        seen = [query.a.digest, query.b.digest]
        if any(d not in self._known for d in seen):
            made["bodies"] = [self._body(query.a), self._body(query.b)]
        else:
            made["bodies"] = [self._known[d] for d in seen]
        return made

    def _pieces(self, body: Body) -> Body:
        if body.digest not in self._decomposed:
            self._decomposed[body.digest] = ofg.decompose(body)
        return self._decomposed[body.digest]

    def _body(self, body: Body) -> int:
        if body.digest in self._known:
            return self._known[body.digest]
        vertices, faces = body.vertices, body.faces
        exact = np.array_equal(vertices, vertices.astype(np.float32))
        kind = "f4" if exact or len(vertices) > EXACT else "f8"
        index = "u2" if len(vertices) < 65536 else "u4"
        entry: dict[str, Any] = {
            "name": body.name,
            "kind": body.kind,
            "v": [self._put(vertices.astype("<" + kind)), kind, len(vertices)],
            "f": [self._put(faces.astype("<" + index)), index, len(faces)],
            "rounded": kind == "f4" and not exact,
        }
        if body.kind == "union":
            entry["pieces"] = [[len(p.vertices), len(p.faces)] for p in body.pieces]
        self.bodies.append(entry)
        self._known[body.digest] = len(self.bodies) - 1
        return self._known[body.digest]

    def _put(self, array: np.ndarray) -> int:
        self.bytes.extend(b"\0" * (-len(self.bytes) % 8))
        start = len(self.bytes)
        self.bytes.extend(array.tobytes())
        return start


def _cost(body: Body) -> int:
    return 24 * len(body.vertices) + 6 * len(body.faces)


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
