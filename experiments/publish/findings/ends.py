# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Hits at the start or end of a step: OFG is run on them here, as the rows of a run do not record
which faces met.

A separate test by separating axes checks whether the faces that OFG names intersect.
"""

from __future__ import annotations

import numpy as np
import pandas as pd

import ofg
from experiments.run.folder.rows import cases_of
from experiments.run.folder.store import Store
from ofg import Body, Query

CLOSE = 1e-9  # share of the faces' size: the gap that rounding may open between touching faces
COLUMNS = ["case", "scenario", "hit", "found", "meet", "late"]


def known(store: Store, k: int = 8) -> pd.DataFrame:
    """A row per sweep of a run that is certified to start or end in contact.

    hit, found: OFG's answer. meet: whether the answer names two faces that intersect at the start
    or end that it names. late: its time less the certified time, as a share of the step.
    """
    cases, bodies = store.read("cases.parquet"), store.read("bodies.parquet")
    ended = cases[(cases.question != "overlap") & ((cases.start == "hit") | (cases.end == "hit"))]
    made = []
    for case, truth in cases_of(ended, bodies):
        answer = ofg.ask(case.query, k=k)
        said = (answer.hit, answer.found, meets(case.query, answer), answer.time - truth.t_hi)
        made.append((case.id, case.scenario, *said))
    return pd.DataFrame(made, columns=COLUMNS)


def meets(query: Query, answer: ofg.Answer) -> bool:
    """Whether an answer found at the start or end names two faces that intersect then."""
    if answer.found not in ("start", "end") or min(answer.faces) < 0:
        return False
    t = float(answer.found == "end")
    a = face(query.a, answer.pieces[0], answer.faces[0])
    b = face(query.b, answer.pieces[1], answer.faces[1])
    return touch(
        query.motion.pose_at(query.pose_a, t).apply(a),
        query.motion_b.pose_at(query.pose_b, t).apply(b),
    )


def face(body: Body, piece: int, index: int) -> np.ndarray:
    """(3, 3): the corners of a face with the indices of an answer."""
    part = body if piece < 0 else body.pieces[piece]
    return part.vertices[part.faces[index]]


def touch(a: np.ndarray, b: np.ndarray) -> bool:
    """Whether two triangles share a point up to rounding: no candidate separating axis separates
    them.
    """
    size = max(np.ptp(a, axis=0).max(), np.ptp(b, axis=0).max())
    a, b = (a - a[0]) / size, (b - a[0]) / size
    edges_a, edges_b = np.roll(a, -1, 0) - a, np.roll(b, -1, 0) - b
    normals = np.cross(edges_a[:2], edges_a[1:])[:1], np.cross(edges_b[:2], edges_b[1:])[:1]
    axes = np.vstack(
        [
            *normals,
            np.cross(edges_a[:, None], edges_b[None]).reshape(-1, 3),
            np.cross(normals[0], edges_a),
            np.cross(normals[1], edges_b),
        ]
    )
    length = np.linalg.norm(axes, axis=1)
    axes = axes[length > CLOSE] / length[length > CLOSE, None]
    on_a, on_b = a @ axes.T, b @ axes.T
    open_ = np.maximum(on_a.min(0) - on_b.max(0), on_b.min(0) - on_a.max(0))
    return bool(open_.max() <= CLOSE)
