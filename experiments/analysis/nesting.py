# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Find the hits that a test of surfaces cannot detect: one body lies inside the other, and their
surfaces never meet.
"""

from __future__ import annotations

from weakref import WeakKeyDictionary

import numpy as np
import pandas as pd

from experiments.run.folder.rows import filled, named
from experiments.run.folder.store import Store
from ofg import Motion, Pose

#: Minimum depth behind a plane, relative to the lengths from which it is computed: some 4,000
#: rounding errors of a double.
DEPTH = 1e-12


_made: WeakKeyDictionary[Store, pd.DataFrame] = WeakKeyDictionary()


def of(store: Store, cases: pd.DataFrame) -> pd.DataFrame:
    """`added` for the cases of a finished run, computed once per Store."""
    if not store.has("bodies.parquet"):
        return cases.assign(kind="", nested=False)  # a reference for `compare` has no bodies
    made = _made.get(store)
    if made is None or list(made.case) != list(cases.case):
        made = _made[store] = added(cases, store.read("bodies.parquet"))[["case", "kind", "nested"]]
    return cases.assign(kind=made.kind.to_numpy(), nested=made.nested.to_numpy())


def added(cases: pd.DataFrame, bodies: pd.DataFrame) -> pd.DataFrame:
    """The cases with two more columns: `kind` (of the bodies: "convex", "union", or "mesh" if one
    is) and `nested`.

    nested: containment is proved in double precision with a margin, for hits of overlap and
    translation queries whose outer body is convex or a union. A case without a proof counts as not
    nested, so a miss remains a miss.
    """
    rows = {row.body: row for row in bodies.itertuples()}
    kinds = {name: row.kind for name, row in rows.items()}
    solids = {}
    for row in bodies.itertuples():
        with named("bodies.parquet", row.Index, row.body):
            solids[row.body] = _Solid(row)
    if unknown := sorted({*cases.body_a, *cases.body_b} - rows.keys()):
        raise ValueError(
            f"bodies.parquet has no body {unknown[0]}, which cases.parquet names. Copy the run"
            " again from its source, or repeat it."
        )
    kind = [_kind(kinds[a], kinds[b]) for a, b in zip(cases.body_a, cases.body_b)]
    nested = [
        row.label == "hit" and row.question != "motion" and _nested(row, solids)
        for row in filled(cases).itertuples()
    ]
    return cases.assign(kind=kind, nested=nested)


def _kind(*kinds: str) -> str:
    return next(k for k in ("mesh", "union", "convex") if k in kinds)


class _Solid:
    """The vertices of a body and the planes of its convex pieces, computed on first use."""

    def __init__(self, row):
        self.vertices = np.reshape(row.vertices, (-1, 3))
        self.faces = np.reshape(row.faces, (-1, 3))
        if not 0 <= self.faces.min() <= self.faces.max() < len(self.vertices) or np.sum(
            row.piece_faces
        ) != len(self.faces):
            raise ValueError("its faces do not match its vertices, or its pieces its faces.")
        self.row, self.radius = row, np.linalg.norm(self.vertices, axis=1).max()
        self._planes = None

    @property
    def pieces(self) -> list[tuple[np.ndarray, np.ndarray, np.ndarray]]:
        """For each convex piece: (m, 3) normals of any length, (m, 3) points on the planes, (m,)
        products of edge lengths.
        """
        if self._planes is None:
            first = np.concatenate([[0], np.cumsum(self.row.piece_faces)])
            self._planes = [
                _planes(self.vertices[self.faces[i:j]]) for i, j in zip(first, first[1:])
            ]
        return self._planes


def _planes(triangles: np.ndarray):
    e, f = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    return np.cross(e, f), triangles[:, 0], np.linalg.norm(e, axis=1) * np.linalg.norm(f, axis=1)


def _nested(row, solids) -> bool:
    a, b = solids[row.body_a], solids[row.body_b]
    pose_a, pose_b = Pose(row.quaternion_a, row.position_a), Pose(row.quaternion_b, row.position_b)
    # a point inside a convex body at the start and end of a translation is inside throughout
    times = (0.0,) if row.question == "overlap" else (0.0, 1.0)
    moved = [(_at(pose_a, row.displacement, t), _at(pose_b, row.displacement_b, t)) for t in times]
    return _within(a, b, moved) or _within(b, a, [pair[::-1] for pair in moved])


def _at(pose: Pose, displacement, t: float) -> Pose:
    return Motion(displacement).pose_at(pose, t)


def _within(inner: _Solid, outer: _Solid, poses: list[tuple[Pose, Pose]]) -> bool:
    """Whether, at all these poses, every vertex of `inner` is inside one piece of `outer` and on
    one side of the surface of each other piece.
    """
    if outer.row.kind == "mesh" or inner.radius > 2 * outer.radius:
        return False
    reach = (
        max(np.abs(p.position).max() + np.abs(q.position).max() for p, q in poses)
        + inner.radius
        + outer.radius
    )
    # The points at start and end together: a point that is on one side of a plane at both is on
    # that side throughout, so a single plane must hold for all of them.
    points = np.concatenate(
        [(inner.vertices @ p.rotation.T + (p.position - q.position)) @ q.rotation for p, q in poses]
    )
    if not any(np.all(n @ points[0] < np.einsum("ij,ij->i", n, on)) for n, on, _ in outer.pieces):
        return False
    sides = [_side(points, reach, piece) for piece in outer.pieces]
    return all(sides) and "inside" in sides


def _side(points: np.ndarray, reach: float, piece) -> str:
    """ "inside" the piece, "outside" one of its planes, or "" if neither is certain."""
    normals, on, edges = piece
    least = DEPTH * edges * reach
    offsets = np.einsum("ij,ij->i", normals, on)
    outside = normals @ points[0] - offsets > least
    if outside.any():  # not inside; only these planes can have all points on their outer side
        heights = points @ normals[outside].T - offsets[outside]
        return "outside" if np.any(np.all(heights > least[outside], axis=0)) else ""
    return "inside" if np.all(points @ normals.T - offsets < -least) else ""
