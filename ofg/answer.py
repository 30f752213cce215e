# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The results of OFG: one answer, or arrays of answers for arrays of poses."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

#: What was found to collide, in the order of the core's codes.
FOUND = ("nothing", "start", "end", "edge-face", "face-edge", "edge-edge", "inside", "within")
#: The operations counted: see `Answer.counts`.
COUNTS = (
    "spheres",
    "distances",
    "face_pairs",
    "edge_faces",
    "edge_pairs",
    "full_tests",
    "evaluated",
    "steps",
    "growths",
)


@dataclass(frozen=True)
class Answer:
    """The answer to one query.

    hit: whether the bodies collide. time: time of impact in [0, 1]; 0 or 1 if faces meet at an end
    of the step; NaN for an overlap query, and if the estimate gives no time.

    found: what met. "start" or "end": faces at that pose of the step; an overlap query has only
    "start". "edge-face": a virtual edge of A and a face of B. With repairs also "face-edge": a face
    of A and a virtual edge of B; "edge-edge": two virtual edges; "within": faces at a time within
    the step, where one of the parts ends into which the repair "arcs" divides the step; "inside": a
    point of one body lies in the other at the start or the end, and none of the k nearest faces met
    there (with k >= faces, one body is wholly inside the other). "nothing": no hit.
    faces: (face of A, face of B) that met, indices into the faces of `pieces`; -1 if no face met,
    as for "inside".
    pieces: (piece of A, piece of B) that were tested; -1 for an undivided mesh.
    estimate: how the time was computed: "velocity", "bisection", "halving" or "none".
    counts: operations by kind: spheres (pairs compared), distances (point to face or piece),
    face_pairs (settled), edge_faces (virtual edges against faces), edge_pairs, full_tests (the
    face_pairs not settled by a cheap rejection), evaluated (distances computed to settle
    `distances`, to faces and to boxes of blocks of faces), steps (parts of the step, halvings),
    growths (of `verified`, which says what its counts are).
    """

    hit: bool
    time: float
    found: str
    faces: tuple[int, int]
    pieces: tuple[int, int]
    estimate: str
    counts: dict[str, int]

    def __bool__(self) -> bool:
        return self.hit


@dataclass(frozen=True, eq=False)
class Answers:
    """The fields of `Answer` as arrays over n queries.

    hit: (n,) bool. time: (n,) float64. found: (n,) int8, indices into FOUND. faces and pieces: (n,
    2) int32. counts: (n, 9) int64 in the order of COUNTS. answers[i] is one Answer. The truth value
    of many answers is ambiguous: bool(answers) raises ValueError.
    """

    hit: np.ndarray
    time: np.ndarray
    found: np.ndarray
    faces: np.ndarray
    pieces: np.ndarray
    counts: np.ndarray
    toi: str = "velocity"

    def __len__(self) -> int:
        return len(self.hit)

    def __bool__(self) -> bool:
        raise ValueError(
            "The truth value of many answers is ambiguous; use answers.hit.any(), "
            "answers.hit.all() or len(answers)."
        )

    def __getitem__(self, i: int) -> Answer:
        found = FOUND[self.found[i]]
        estimate = self.toi if found in ("edge-face", "face-edge", "edge-edge") else "none"
        return Answer(
            bool(self.hit[i]),
            float(self.time[i]),
            found,
            (int(self.faces[i, 0]), int(self.faces[i, 1])),
            (int(self.pieces[i, 0]), int(self.pieces[i, 1])),
            estimate,
            dict(zip(COUNTS, map(int, self.counts[i]))),
        )

    def count(self, name: str) -> np.ndarray:
        """(n,) int64: counts of one kind of operation."""
        return self.counts[:, COUNTS.index(name)]
