# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The article's steps, plain: `ask` with accelerations gives their answers and their counts, and
the readings differ as they must.
"""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import ofg
from ofg import Body, Motion, Pose, Query
from ofg.algorithm import ARTICLE
from tests.ofg.conftest import CUBE as CORNERS

CUBE = Body.convex(CORNERS, "cube")
WALL = Body.convex(CUBE.vertices * [4, 4, 0.01], "wall")
COUNTED = ("spheres", "distances", "face_pairs", "edge_faces")


def hull(rng, n=12):
    return Body.convex(np.round(rng.normal(size=(n, 3)), 2 if rng.random() < 0.3 else 6))


def union(rng):
    return Body.union(
        [Body.convex(hull(rng, 8).vertices * 0.5 + rng.normal(size=3)) for _ in range(3)]
    )


def query(rng, question):
    bodies = [union(rng) if rng.random() < 0.3 else hull(rng) for _ in "ab"]
    poses = [Pose(rng.normal(size=4), rng.normal(size=3) * s) for s in (0.3, 1.2)]
    motions = [Motion(), Motion()]
    if question != "overlap":
        angle = question == "motion"
        motions = [
            Motion(
                rng.normal(size=3) * 2,
                rng.normal(size=3),
                angle * rng.uniform(-3, 3),
                rng.normal(size=3),
            )
            for _ in "ab"
        ]
    return Query(question, *bodies, *poses, *motions)


@settings(max_examples=150, deadline=None)
@given(
    seed=st.integers(0, 2**32 - 1),
    question=st.sampled_from(ofg.QUESTIONS),
    k=st.sampled_from([1, 2, 4, 8, 64]),
    toi=st.sampled_from(["velocity", "halving", "none"]),
    order=st.sampled_from(["ends", "steps"]),
    broad=st.sampled_from(["start", "swept"]),
    precision=st.sampled_from(["double", "float"]),
)
def test_accelerations_change_no_answer_and_no_count(
    seed, question, k, toi, order, broad, precision
):
    q = query(np.random.default_rng(seed), question)
    options = dict(k=k, toi=toi, order=order, broad=broad, precision=precision)
    plain, fast = ofg.article(q, **options), ofg.ask(q, **options)
    assert (plain.hit, plain.found, plain.faces, plain.pieces) == (
        fast.hit,
        fast.found,
        fast.faces,
        fast.pieces,
    )
    assert np.array_equal(plain.time, fast.time, equal_nan=True)
    assert [plain.counts[c] for c in COUNTED] == [fast.counts[c] for c in COUNTED]
    assert plain.counts["full_tests"] == plain.counts["face_pairs"]
    assert plain.counts["evaluated"] == plain.counts["distances"] - pieces_compared(q) * (
        plain.counts["distances"] > 0
    )


def pieces_compared(q):
    """Distances to the centres of pieces, which stand among the others."""
    return sum(len(body.pieces) for body in (q.a, q.b) if len(body.pieces) > 1)


def test_a_hit_at_an_end_has_its_faces_and_needs_no_estimate():
    """The pair of the issue: overlap at the start, and the virtual edges met the far side on their
    way out, at 0.2333.
    """
    unit = Body.convex(CUBE.vertices / 2)
    q = Query(
        "translation", unit, unit, Pose(position=(0.3, 0.2, 0.1)), Pose(), Motion((3, 0.1, 0.05))
    )
    for toi in ("velocity", "bisection", "halving"):
        answer = ofg.ask(q, k=12, toi=toi)
        assert (answer.found, answer.time, answer.estimate) == ("start", 0.0, "none") and min(
            answer.faces
        ) >= 0
    literal = ofg.ask(q, k=12, order="steps")
    assert literal.found == "edge-face" and literal.time == pytest.approx(0.23333, abs=1e-4)
    back = Query(
        "translation",
        unit,
        unit,
        Pose(position=(3.3, 0.3, 0.15)),
        Pose(),
        Motion((-3, -0.1, -0.05)),
    )
    answer = ofg.ask(back, k=12)
    assert (answer.found, answer.time) == ("end", 1.0)


def test_the_moment_of_a_hit_that_only_the_end_shows():
    unit = Body.convex(CUBE.vertices / 2)
    q = Query(
        "translation", unit, unit, Pose(position=(3.0, 0.3, 0.15)), Pose(), Motion((-2.5, 0, 0))
    )
    assert ofg.ask(q, k=12).time == 1.0
    assert ofg.ask(q, k=12, repairs="end-moment").time == pytest.approx(0.8, abs=2e-6)
    assert ofg.ask(q, k=12, repairs="end-moment").found == "end"


def test_halving_goes_forward_only():
    """1/2, 3/4, 7/8, ...: a body that is in the wall between two of these moments is never seen,
    and the hit has no time.
    """

    def through(start):
        return Query(
            "translation", CUBE, WALL, Pose(position=(0, 0, start)), Pose(), Motion((0, 0, -16))
        )

    assert ofg.ask(through(8.0), k=12, toi="halving").time == 0.5
    assert ofg.ask(through(12.0), k=12, toi="halving").time == 0.75
    missed = ofg.ask(through(5.0), k=12, toi="halving", iterations=20)
    assert missed.hit and np.isnan(missed.time)
    assert ofg.ask(through(5.0), k=12, toi="bisection").time == pytest.approx(
        (5 - 1.01) / 16, abs=1e-5
    )


def test_pieces_are_chosen_over_time_by_a_repair():
    """A flies past: at the start the near piece of B is chosen, and A meets the far one."""
    b = Body.union(
        [Body.convex(CUBE.vertices * 0.5 + [0, 0, -3]), Body.convex(CUBE.vertices + [8, 0.3, 0.2])]
    )
    q = Query("translation", CUBE, b, Pose(position=(0, 0, 0)), Pose(), Motion((16, 0, 0)))
    assert not ofg.ask(q, k=12).hit
    found = ofg.ask(q, k=12, repairs="pieces-over-time")
    assert found.hit and found.pieces == (0, 1)


def test_the_article_knows_no_repair():
    q = Query("overlap", CUBE, CUBE)
    for wrong in ({"containment": True}, {"repairs": "all"}, {"screen": True}):
        with pytest.raises(TypeError, match="The article has no option"):
            ofg.article(q, **wrong)
    assert ofg.prepare(q, algorithm=ARTICLE, broad="start")()[0]
