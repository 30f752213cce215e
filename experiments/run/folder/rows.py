# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Conversion of cases, bodies and truths to rows of a table, readable without this code, and
back.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
import pandas as pd

from experiments.cases.case import Case
from experiments.cases.label import Truth
from ofg import Body, BodyError, Motion, Pose, Query, readback

from . import given


class RowError(ValueError):
    """A row that is not a valid body or case; the message names the file and the row."""


Row = dict[str, object]  #: of a table, by column
MOTION = (
    "displacement",
    "axis",
    "angle",
    "about",
    "displacement_b",
    "axis_b",
    "angle_b",
    "about_b",
)


def case_row(case: Case, truth: Truth, attempt: int) -> Row:
    """One row of cases.parquet. attempt: the number of rejected draws before this one."""
    q = case.query
    return {
        "case": case.id,
        "scenario": case.scenario,
        "level": case.level,
        "index": case.index,
        "attempt": attempt,
        "precision": case.precision,
        "question": q.question,
        "body_a": q.a.digest,
        "body_b": q.b.digest,
        "quaternion_a": q.pose_a.quaternion.tolist(),
        "position_a": q.pose_a.position.tolist(),
        "quaternion_b": q.pose_b.quaternion.tolist(),
        "position_b": q.pose_b.position.tolist(),
        **_motion_row(q.motion, ""),
        **_motion_row(q.motion_b, "_b"),
        "size": max(q.a.size, q.b.size),
        "faces": max(len(q.a.faces), len(q.b.faces)),
        "tags": json.dumps(dict(case.tags), sort_keys=True),
        **truth_row(truth),
    }


def truth_row(truth: Truth) -> Row:
    """The columns of a row that contain a truth."""
    return {
        "label": truth.label,
        "t_lo": truth.t_lo,
        "t_hi": truth.t_hi,
        "start": truth.start,
        "end": truth.end,
        "gap": truth.gap,
        "touching": truth.touching,
        "reason": truth.reason,
        "certificate": json.dumps(dict(truth.certificate), sort_keys=True),
    }


def _motion_row(motion: Motion, side: str) -> Row:
    """A's motion is in `displacement`, `axis`, `angle` and `about`; B's in columns of the same
    names with the suffix "_b".
    """
    return {
        f"displacement{side}": motion.displacement.tolist(),
        f"axis{side}": motion.axis.tolist(),
        f"angle{side}": motion.angle,
        f"about{side}": motion.about.tolist(),
    }


def filled(cases: pd.DataFrame) -> pd.DataFrame:
    """The rows with every column. Defaults for runs recorded before a column existed: B rests, A
    rotates about its origin, every pose and motion consists of float32 numbers, and no case is
    known to touch.
    """
    rest = {
        f"{name}{side}": value
        for side in ("", "_b")
        for name, value in _motion_row(Motion(), "").items()
    }
    rest.update(precision="float32", touching=False, index=0, attempt=0, reason="")
    missing = {
        name: [np.array(value) if isinstance(value, list) else value] * len(cases)
        for name, value in rest.items()
        if name not in cases
    }
    return cases.assign(**missing)


def body_row(body: Body) -> Row:
    """One row of bodies.parquet: flat arrays; the pieces of a union one after another, face
    indices into all vertices.
    """
    pieces = body.pieces if body.kind == "union" else (body,)
    return {
        "body": body.digest,
        "name": body.name,
        "kind": body.kind,
        "vertices": body.vertices.ravel().tolist(),
        "faces": body.faces.ravel().tolist(),
        "piece_vertices": [len(p.vertices) for p in pieces],
        "piece_faces": [len(p.faces) for p in pieces],
    }


def body_of(row: Any) -> Body:
    """The body of a row with its original vertices and faces. BodyError if it is invalid, or if
    its content does not match its recorded digest.
    """
    body = readback.body(
        row.kind, row.vertices, row.faces, row.piece_vertices, row.piece_faces, row.name
    )
    if body.digest != row.body:
        raise BodyError(
            f"Body '{row.name}': its content has the digest {body.digest}, but it is recorded "
            f"under {row.body}."
        )
    return body


def _certificate(text: str) -> Any:
    """The stored certificate; the text itself if it is not JSON, or too deep, which the checker
    refuses.
    """
    try:
        return json.loads(text)
    except (ValueError, TypeError, RecursionError):
        return text


def tags_of(text: str) -> dict[str, str | float]:
    try:
        tags = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise ValueError(f"its tags are not JSON ({given.reason(error)})") from error
    if not isinstance(tags, dict) or not all(
        isinstance(v, (str, int, float)) for v in tags.values()
    ):
        raise ValueError("its tags are not strings and numbers by name")
    return tags


def cases_of(cases: pd.DataFrame, bodies: pd.DataFrame) -> Iterable[tuple[Case, Truth]]:
    """Cases and truths in the order of the rows; equal bodies are one object.

    RowError, which names the file and the row, for an invalid body or case.
    """
    made: dict[str, Body] = {}
    for row in bodies.itertuples():
        with named("bodies.parquet", row.Index, row.body):
            made[row.body] = body_of(row)
    for row in filled(cases).itertuples():
        with named("cases.parquet", row.Index, row.case):
            for digest in (row.body_a, row.body_b):
                if digest not in made:
                    raise ValueError(f"bodies.parquet has no body {digest}")
            found = _case(row, made)
        yield found


def _case(row: Any, made: dict[str, Body]) -> tuple[Case, Truth]:
    query = Query(
        row.question,
        made[row.body_a],
        made[row.body_b],
        Pose(row.quaternion_a, row.position_a),
        Pose(row.quaternion_b, row.position_b),
        Motion(row.displacement, row.axis, row.angle, row.about),
        Motion(row.displacement_b, row.axis_b, row.angle_b, row.about_b),
    )
    truth = Truth(
        row.label,
        row.t_lo,
        row.t_hi,
        row.start,
        row.end,
        row.gap,
        row.reason,
        _certificate(row.certificate),
        bool(row.touching),
    )
    return (
        Case(row.case, row.scenario, row.level, row.index, query, tags_of(row.tags), row.precision),
        truth,
    )


@contextmanager
def named(file: str, index: int, name: str) -> Iterator[None]:
    """Convert errors of a row to RowError."""
    try:
        yield
    except (ValueError, TypeError) as error:
        raise RowError(
            f"Row {index} of {file} ({given.shown(name)}) cannot be used: "
            f"{given.clipped(str(error))} The file was changed or is damaged; copy the run again "
            "from its source, or make it again."
        ) from error
