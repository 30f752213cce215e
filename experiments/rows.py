"""Cases, bodies and truths as rows of a table, readable without this code, and back."""

from __future__ import annotations

import json
from typing import Iterable

import numpy as np
import pandas as pd

from ofg import Body, Motion, Pose, Query

from .case import Case
from .truth.label import Truth


MOTION = ("displacement", "axis", "angle", "about", "displacement_b", "axis_b", "angle_b", "about_b")


def case_row(case: Case, truth: Truth, attempt: int) -> dict:
    """One row of cases.parquet. attempt: how many draws before this one were thrown away."""
    q = case.query
    return {
        "case": case.id, "scenario": case.scenario, "level": case.level, "index": case.index, "attempt": attempt,
        "precision": case.precision,
        "question": q.question, "body_a": q.a.digest, "body_b": q.b.digest,
        "quaternion_a": q.pose_a.quaternion.tolist(), "position_a": q.pose_a.position.tolist(),
        "quaternion_b": q.pose_b.quaternion.tolist(), "position_b": q.pose_b.position.tolist(),
        **_motion_row(q.motion, ""), **_motion_row(q.motion_b, "_b"),
        "size": max(q.a.size, q.b.size), "faces": max(len(q.a.faces), len(q.b.faces)), "tags": json.dumps(dict(case.tags), sort_keys=True),
        "label": truth.label, "t_lo": truth.t_lo, "t_hi": truth.t_hi, "start": truth.start, "end": truth.end, "gap": truth.gap,
        "touching": truth.touching, "reason": truth.reason,
        "certificate": json.dumps(dict(truth.certificate), sort_keys=True),
    }


def _motion_row(motion: Motion, side: str) -> dict:
    """A's motion is in `displacement`, `axis`, `angle` and `about`; B's has the same names with "_b" behind."""
    return {
        f"displacement{side}": motion.displacement.tolist(), f"axis{side}": motion.axis.tolist(), f"angle{side}": motion.angle,
        f"about{side}": motion.about.tolist(),
    }


def filled(cases: pd.DataFrame) -> pd.DataFrame:
    """The rows with every column. Runs recorded before a column was: B rests there, A turns about its origin, every
    pose and motion is of float32 numbers, and no case is known to touch."""
    rest = {f"{name}{side}": value for side in ("", "_b") for name, value in _motion_row(Motion(), "").items()}
    rest.update(precision="float32", touching=False)
    missing = {name: [np.array(value) if isinstance(value, list) else value] * len(cases) for name, value in rest.items() if name not in cases}
    return cases.assign(**missing)


def body_row(body: Body) -> dict:
    """One row of bodies.parquet: flat arrays; the pieces of a union one after another, faces counted through."""
    pieces = body.pieces if body.kind == "union" else (body,)
    return {
        "body": body.digest, "name": body.name, "kind": body.kind, "vertices": body.vertices.ravel().tolist(),
        "faces": body.faces.ravel().tolist(), "piece_vertices": [len(p.vertices) for p in pieces], "piece_faces": [len(p.faces) for p in pieces],
    }


def body_of(row) -> Body:
    """The body of a row, vertex for vertex and face for face as it was."""
    v, f = np.reshape(row.vertices, (-1, 3)), np.reshape(row.faces, (-1, 3))
    if row.kind != "union":
        return Body._of(row.kind, v, f, (), row.name)
    v0 = np.cumsum([0, *row.piece_vertices])
    f0 = np.cumsum([0, *row.piece_faces])
    pieces = tuple(Body._of("convex", v[v0[i]:v0[i + 1]], f[f0[i]:f0[i + 1]] - v0[i], (), f"{row.name}[{i}]") for i in range(len(row.piece_vertices)))
    return Body._of("union", v, f, pieces, row.name)


def _certificate(text: str):
    """The stored certificate; the text itself where it is no JSON, or too deep, which the checker refuses."""
    try:
        return json.loads(text)
    except (ValueError, TypeError, RecursionError):
        return text


def cases_of(cases: pd.DataFrame, bodies: pd.DataFrame) -> Iterable[tuple[Case, Truth]]:
    """Cases and truths in the order of the rows; equal bodies are one object."""
    made = {row.body: body_of(row) for row in bodies.itertuples()}
    for row in filled(cases).itertuples():
        query = Query(row.question, made[row.body_a], made[row.body_b], Pose(row.quaternion_a, row.position_a),
                      Pose(row.quaternion_b, row.position_b), Motion(row.displacement, row.axis, row.angle, row.about),
                      Motion(row.displacement_b, row.axis_b, row.angle_b, row.about_b))
        truth = Truth(row.label, row.t_lo, row.t_hi, row.start, row.end, row.gap, row.reason,
                      _certificate(row.certificate), bool(row.touching))
        tags = json.loads(row.tags)
        case = Case(row.case, row.scenario, row.level, row.index, query, tags, row.precision)
        yield case, truth
