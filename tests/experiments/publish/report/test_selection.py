# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The selections that the page shows are those of the core: asked about them alone, all against
all, the core gives OFG's own answer.
"""

import numpy as np
import pytest

import ofg
from experiments.cases import families
from experiments.publish.report import selection
from experiments.run.folder.rows import cases_of
from ofg import _core
from ofg.algorithm import BRUTE_FORCE
from ofg.arrays import row
from ofg.options import core_options

OPTIONS = [
    {"k": 4},
    {"k": 8},
    {"k": 16},
    {"k": 8, "broad": "start"},
    {"k": 4, "nearest": "point-triangle"},
    {"k": 4, "adaptive_k": True},
    {"k": 4, "selection_times": 2},
    {"k": 4, "selection_times": 3},
    {"k": 8, "concave": "undivided"},
]


def alone(body: ofg.Body, faces: list[int]) -> _core.Solid:
    """A surface of these faces, without the other vertices of the body."""
    used, index = np.unique(body.faces[faces], return_inverse=True)
    return _core.Solid(
        np.ascontiguousarray(body.vertices[used]),
        np.ascontiguousarray(index.reshape(-1, 3), dtype=np.int32),
        False,
        [],
        [],
    )


@pytest.mark.parametrize("options", OPTIONS, ids=str)
def test_all_pairs_of_the_selected_faces_give_the_answer_of_ofg(run, options):
    answers = set()
    for case, truth in cases_of(run.read("cases.parquet"), run.read("bodies.parquet")):
        q = case.query
        made = selection.trace(q, options, truth.t_hi)
        motions = [row(x)[None] for x in (q.pose_a, q.pose_b, q.motion, ofg.Motion())]
        found = _core.ask_many(
            alone(q.a, made["a"]),
            alone(q.b, made["b"]),
            *motions,
            core_options(),
            BRUTE_FORCE,
            q.question != "overlap",
            False,
            1,
        )[0][0]
        assert (bool(found) and not made["stopped"]) == made["hit"], case.id
        answers.add(made["hit"])
    assert answers == {True, False}


@pytest.mark.parametrize("options", [*OPTIONS, {"k": 8, "repairs": "all"}], ids=str)
def test_faces_that_met_are_among_the_selected(run, options):
    met = 0
    for case, truth in cases_of(run.read("cases.parquet"), run.read("bodies.parquet")):
        made = selection.trace(case.query, options, truth.t_hi)
        if made["met"]:
            assert made["met"][0] in made["a"] and made["met"][1] in made["b"], case.id
            met += 1
    assert met


def test_faces_that_should_have_met_do_meet_and_a_face_among_the_k_nearest_was_taken(run):
    seen = 0
    for case, truth in cases_of(run.read("cases.parquet"), run.read("bodies.parquet")):
        made, q = selection.trace(case.query, {"k": 4}, truth.t_hi), case.query
        should = made.get("should")
        if truth.label == "hit" and should:
            at = ofg.Query(
                "overlap", q.a, q.b, q.motion.pose_at(q.pose_a, should["time"]), q.pose_b
            )
            assert ofg.brute_force(at).faces == tuple(should["faces"])
            for place, face, taken in zip(
                should["places"], should["faces"], (made["a"], made["b"])
            ):
                assert place is None or (place <= 4) == (face in taken), case.id
            seen += 1
    assert seen


@pytest.mark.parametrize("repairs", ["arcs", "arcs+both-vertices"])
def test_the_parts_of_the_step_are_those_that_the_core_halves_it_into(repairs):
    """Halving makes 2 n - 1 windows of n parts; the core passes over those where spheres are
    apart.
    """
    reached = 0
    for name in ("both_moving", "screw_wall", "rotational_contact"):
        family = families.get(name)
        for level in family.levels:
            query = family.case(3, level, 0).query
            answer, shown = (
                ofg.ask(query, repairs=repairs),
                selection.trace(query, {"k": 8, "repairs": repairs}),
            )
            parts = shown["parts"]
            assert parts & (parts - 1) == 0
            if not answer.hit:
                assert answer.counts["steps"] <= 2 * parts - 1
                reached += answer.counts["steps"] > 1
    assert reached
