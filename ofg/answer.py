"""What OFG returns: one answer, or one per row of arrays of poses."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

#: what the hit is, in the order of the core's codes
FOUND = ("nothing", "start", "end", "edge-face", "face-edge", "edge-edge", "inside", "within")
#: what is counted: see `Answer.counts`
COUNTS = (
    "spheres",
    "distances",
    "face_pairs",
    "edge_faces",
    "edge_pairs",
    "full_tests",
    "evaluated",
    "steps",
)


@dataclass(frozen=True)
class Answer:
    """hit: the bodies meet. time: of impact in [0, 1]: 0 or 1 where faces meet at an end of the
    step; NaN of an overlap query, and where the estimate gives none.

    found: what met. "start" or "end": faces at that pose of the step; an overlap query has only
    "start". "edge-face": a virtual edge of A and a face of B. With repairs also "face-edge": a
    virtual edge of B; "edge-edge"; "within": faces at a moment within the step, at which one of the
    parts ends that the repair "arcs" cuts the step into; "inside": a point of one body lies in the
    other at the start or the end, and none of the k nearest faces met there (with k >= faces, one
    body is wholly inside the other). "nothing" without a hit.
    faces: (face of A, face of B) that met, indices into the faces of `pieces`; -1 where no face
    did, as with "inside".
    pieces: (piece of A, piece of B) that were asked; -1 for an undivided mesh.
    estimate: "velocity", "bisection", "halving" or "none": how the time was found.
    counts: operations by kind: spheres (pairs compared), distances (point to face or piece),
    face_pairs (settled), edge_faces (virtual edges against faces), edge_pairs, full_tests (of
    face_pairs: not settled by a cheap rejection), evaluated (distances computed to settle
    `distances`, to faces and to boxes of blocks of faces), steps (parts of the step, halvings).
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
    """The fields of `Answer` as arrays over n queries: hit (n,) bool, time (n,) float64, found (n,)
    int8 (codes: index into FOUND), faces and pieces (n, 2) int32, counts (n, 8) int64 in the order
    of COUNTS. answers[i] is one Answer. Many answers are neither true nor false: bool(answers)
    raises ValueError.
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
            "Whether many answers are true is ambiguous; use answers.hit.any(), answers.hit.all() "
            "or len(answers)."
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
        """(n,) int64 of one kind of operation."""
        return self.counts[:, COUNTS.index(name)]
