# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Show one case, from a run or from a file, on its own page.

The file is JSON: {"case": the row of cases.parquet, "bodies": the two rows of bodies.parquet (one
if both bodies are equal), "observations": rows of observations.parquet (optional), "pieces": a list
with the row of pieces.parquet (optional; without it, methods that decompose are judged by the
mesh)}.

A file written by hand needs these fields. "case": question, body_a, body_b, and, if they differ
from the identity, quaternion_a, position_a, quaternion_b, position_b, displacement, axis, angle,
about (of A's motion; with the suffix "_b", of B's). Each body: body (any name), kind, vertices,
faces (flat lists; a convex body needs no faces; a union also needs piece_vertices and piece_faces).
A case without a label is certified when the file is read.
"""

from __future__ import annotations

import json
import math
import re
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pandas as pd

from baselines import registry
from experiments.analysis import outcome
from experiments.cases.case import Case
from experiments.cases.label import Truth
from experiments.run import answering, piece_truth
from experiments.run.answering import COLUMNS
from experiments.run.config import ConfigError, RunConfig, closest, load_files
from experiments.run.folder import given, record
from experiments.run.folder.rows import _certificate, body_of, body_row, case_row, cases_of, tags_of
from experiments.run.folder.store import Store, StoreError
from experiments.run.processes import pool
from ofg import Body, Motion, Pose, Query, readback

WORST_FIRST = (
    "miss",
    "false alarm",
    "error",
    "timeout",
    "contained",
    "touching",
    "right",
    "no label",
    "unsupported",
)


@dataclass(frozen=True)
class Explained:
    """A case, its truth, its row, and the answers to it (rows of observations.parquet)."""

    case: Case
    truth: Truth
    row: dict
    said: pd.DataFrame
    refused: str = ""  #: why the checker rejects the label
    pieces: pd.DataFrame | None = None  #: the row of pieces.parquet, if there is one


def from_run(store: Store, name: str) -> Explained:
    """A case of a run. Raises StoreError, with the most similar names, if the run has no such
    case.
    """
    rows = store.read("cases.parquet")
    row = rows[rows.case == name]
    if row.empty:
        raise StoreError(
            f"The run {store.folder} has no case '{name}'{closest(name, rows.case)}. Case names"
            " have the form scenario/level/index; the gallery of report.html and cases.parquet list"
            " them."
        )
    bodies = store.read("bodies.parquet")
    ((case, truth),) = cases_of(
        row, bodies[bodies.body.isin([row.body_a.iloc[0], row.body_b.iloc[0]])]
    )
    said = store.read("observations.parquet").query("case == @name").reset_index(drop=True)
    pieces = piece_truth.read(store)
    own = None if pieces is None or name not in set(pieces.case) else pieces[pieces.case == name]
    return Explained(case, truth, row.iloc[0].to_dict(), said, refusal(case.query, truth), own)


def refusal(query: Query, truth: Truth) -> str:
    """Why the checker rejects a label; "" if it accepts it."""
    from experiments.truth import check

    verdict = check(query, truth)
    return "" if verdict.ok else given.shown(verdict.reason) or "its certificate does not prove it"


def _said(rows) -> pd.DataFrame:
    """Rows of observations.parquet. Raises ValueError if `rows` are not such rows."""
    if not isinstance(rows, list) or not all(isinstance(r, dict) for r in rows):
        raise ValueError("observations is not a list of rows")
    said = pd.DataFrame(rows, columns=COLUMNS)
    if (wrong := record.wrong(said, "observations.parquet")) is not None:
        raise ValueError(f"observations: {wrong}")
    return said


def _pieces(rows, case: Case) -> pd.DataFrame:
    """Rows of pieces.parquet. Raises ValueError if `rows` are not such rows or belong to another
    case.
    """
    if not isinstance(rows, list) or not all(isinstance(r, dict) for r in rows):
        raise ValueError("pieces is not a list of rows")
    made = pd.DataFrame(rows, columns=list(record.COLUMNS[piece_truth.FILES[0]]))
    if (wrong := record.wrong(made, piece_truth.FILES[0])) is not None:
        raise ValueError(f"pieces: {wrong}")
    if (made.case != case.id).any():
        raise ValueError("pieces belong to another case")
    return made.astype(dict.fromkeys(("t_lo", "t_hi", "gap"), float))


def _check_names(case: Case, said: pd.DataFrame) -> None:
    for name in (case.id, case.scenario, *said.method):
        if not record.is_name(name):
            raise ValueError(f"{given.shown(repr(name))[:80]} is not a valid name")
    if (said.case != case.id).any():
        raise ValueError("observations belong to another case")


def from_file(path: Path) -> Explained:
    """The case in a file. Raises ConfigError, which names the field, if it cannot be read."""
    if not path.exists():
        raise ConfigError(
            f"The case file {path} does not exist. Write one from a run with: ofg-bench explain"
            f" CASE --run RUN --save {path}"
        )
    try:
        content = given.json_in(path, "The case file", given.MOST_CASE)
        made = {b["body"]: _body(b, i) for i, b in enumerate(content["bodies"])}
        row = content["case"]
        query = Query(
            row["question"],
            made[row["body_a"]],
            made[row["body_b"]],
            _pose(row, "a"),
            _pose(row, "b"),
            _motion(row, ""),
            _motion(row, "_b"),
        )
        case = Case(
            row.get("case", path.stem),
            row.get("scenario", path.stem),
            float(row.get("level", 0)),
            int(row.get("index", 0)),
            query,
            _tags(row),
            row.get("precision", "float64"),
        )
        truth = _truth(row) if "label" in row else _certify(query)
        said = _typed(_said(content.get("observations", [])))
        pieces = _pieces(content["pieces"], case) if "pieces" in content else None
        _check_names(case, said)
    except given.GivenError as error:
        raise ConfigError(str(error)) from error
    except KeyError as error:
        raise ConfigError(
            f"The case file {path} lacks the field {error}. The docstring of"
            " experiments/publish/report/explain.py lists the required fields; for an example, use:"
            " ofg-bench explain CASE --run RUN --save case.json"
        ) from error
    except (
        TypeError,
        ValueError,
        AttributeError,
        IndexError,
        OverflowError,
        RecursionError,
    ) as error:
        raise ConfigError(
            f"The case file {path} has a field of the wrong form ({given.reason(error)}). Compare"
            " it with a file written by: ofg-bench explain CASE --run RUN --save case.json"
        ) from error
    return Explained(case, truth, case_row(case, truth, 0), said, refusal(query, truth), pieces)


def save(explained: Explained, path: Path) -> None:
    """The file that `from_file` reads."""
    q = explained.case.query
    bodies = {row["body"]: row for row in (body_row(q.a), body_row(q.b))}
    said = [
        {k: None if v is pd.NA or v != v else v for k, v in row.items()}
        for row in explained.said[COLUMNS].astype(object).to_dict("records")
    ]
    content = {
        "case": _listed(explained.row),
        "bodies": list(bodies.values()),
        "observations": said,
    }
    if explained.pieces is not None:
        content["pieces"] = [_listed(row) for row in explained.pieces.to_dict("records")]
    path.write_text(json.dumps(content, indent=1, allow_nan=False) + "\n")


def ask(explained: Explained, config: RunConfig, log: Path) -> Explained:
    """Run the methods of the configuration on the case, each in its own process. New answers
    replace earlier ones of the same methods.
    """
    load_files(config)
    rows: list[dict] = []
    tasks = []
    for method in (m for spec in config.asked for m in registry.make(spec)):

        def lost(case, loss, label=method.label):
            return answering.row(case, label, loss.status, detail=loss.detail)

        tasks.append(
            pool.Task(answering.asker, (method.label, config), [explained.case], rows.extend, lost)
        )
    pool.run(
        tasks,
        2,
        config.build_seconds + config.query_seconds,
        log,
        prepare=partial(load_files, config),
    )
    order = {task.argument[0]: i for i, task in enumerate(tasks)}
    fresh = pd.DataFrame(sorted(rows, key=lambda r: order[r["method"]]), columns=COLUMNS)
    kept = explained.said[~explained.said.method.isin(fresh.method)]
    return Explained(
        explained.case,
        explained.truth,
        explained.row,
        _typed(pd.concat([fresh, kept], ignore_index=True) if len(kept) else fresh),
        explained.refused,
        explained.pieces,
    )


def motion_words(motion: Motion) -> str:
    """A motion in words, or 'is at rest'.

    'translates by (0, 0, -2), rotates by 1.5 rad about the axis (0, 0, 1) through its point (1, 0,
    0)'
    """

    def numbers(v) -> str:
        return f"({', '.join(f'{x:.6g}' for x in v)})"

    if motion.rests:
        return "is at rest"
    words = [f"translates by {numbers(motion.displacement)}"] if motion.displacement.any() else []
    if motion.angle:
        point = f" through its point {numbers(motion.about)}" if motion.about.any() else ""
        words.append(
            f"rotates by {motion.angle:.6g} rad about the axis {numbers(motion.axis)}{point}"
        )
    return ", ".join(words)


def digits(value: float) -> str:
    return "-" if value != value else f"{value:.9g}"


def page(explained: Explained, versions: dict) -> str:
    """The text of the case's page."""
    from . import page as pages
    from . import payload

    made = payload.of_case(
        explained.case,
        explained.truth,
        explained.row,
        explained.said,
        versions,
        explained.refused,
        explained.pieces,
    )
    return pages.page(
        made, f"{explained.case.id}: one case, {'not ' * bool(explained.refused)}certified"
    )


def verdicts(explained: Explained) -> pd.DataFrame:
    """Columns method, outcome, time, error, detail; a row per method that answers the case's
    question, wrong answers first.
    """
    found = outcome.judge(explained.said, pd.DataFrame([explained.row]), explained.pieces)
    found = found[~found.detail.fillna("").str.startswith("does not answer")]
    own = (found.truth == piece_truth.PIECES) & (found.detail.fillna("") == "")
    found = found.assign(
        detail=found.detail.mask(own, "judged by the CoACD pieces of the mesh: " + found.label)
    )
    order = {name: i for i, name in enumerate(WORST_FIRST)}
    return (
        found.assign(order=found.outcome.map(order))
        .sort_values("order", kind="stable")[["method", "outcome", "time", "error", "detail"]]
        .reset_index(drop=True)
    )


def _body(row: dict, index: int) -> Body:
    """A body from its row. Raises ValueError, which names the body, if the row is not valid. The
    content is checked against the name only if the name is a digest.
    """
    row = {"name": row["body"], "faces": [], "piece_vertices": [], "piece_faces": [], **row}
    try:
        if row["kind"] == "convex" and not row["faces"]:
            return Body.convex(np.reshape(row["vertices"], (-1, 3)), row["name"])
        if re.fullmatch("[0-9a-f]{24}", row["body"]):
            return body_of(SimpleNamespace(**row))
        return readback.body(
            *(
                row[name]
                for name in ("kind", "vertices", "faces", "piece_vertices", "piece_faces", "name")
            )
        )
    except (ValueError, TypeError) as error:
        raise ValueError(f"bodies[{index}]: {error}") from error


def _pose(row: dict, side: str) -> Pose:
    return Pose(row.get(f"quaternion_{side}", [1, 0, 0, 0]), row.get(f"position_{side}", [0, 0, 0]))


def _motion(row: dict, side: str) -> Motion:
    names = ("displacement", "axis", "angle", "about")
    given = {name: row[name + side] for name in names if name + side in row}
    return Motion(**given)


def _tags(row: dict) -> dict:
    tags = row.get("tags", {})
    return tags_of(tags if isinstance(tags, str) else json.dumps(tags))


def _truth(row: dict) -> Truth:
    t_lo, t_hi, gap = (
        math.nan if row.get(key) is None else float(row[key]) for key in ("t_lo", "t_hi", "gap")
    )
    certificate = row.get("certificate", "{}")
    certificate = _certificate(certificate) if isinstance(certificate, str) else certificate
    if not isinstance(certificate, dict):
        raise ValueError("certificate is not a JSON object")
    for name in ("label", "start", "end"):
        if row.get(name, "uncertain") not in record.LABELS:
            raise ValueError(
                f"{name} is {given.shown(repr(row[name]))}, which is not one of"
                f" {', '.join(record.LABELS)}"
            )
    return Truth(
        row["label"],
        t_lo,
        t_hi,
        row.get("start", "uncertain"),
        row.get("end", "uncertain"),
        gap,
        str(row.get("reason", "")),
        certificate,
        bool(row.get("touching", False)),
    )


def _certify(query: Query) -> Truth:
    from experiments.truth import label

    return label(query)


def _typed(said: pd.DataFrame) -> pd.DataFrame:
    return said.astype({"hit": "boolean", "time": "float64"})


def _listed(row: dict) -> dict:
    made = {k: v.tolist() if isinstance(v, (np.ndarray, np.generic)) else v for k, v in row.items()}
    return {k: None if isinstance(v, float) and math.isnan(v) else v for k, v in made.items()}
