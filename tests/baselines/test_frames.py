# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The same question in another frame: what the bodies find of each other stays as it was."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from baselines import registry
from baselines.contract import Method, Unsupported, Verdict
from baselines.easy_queries import bar, body
from baselines.frames import about_origins, one_mover, seen_from, shifted, stated
from baselines.units import normalised
from ofg import Motion, Pose, Query

number = st.floats(-8, 8, width=32)
vector = st.tuples(number, number, number)


@st.composite
def motions(draw, turns):
    angle = draw(number) if turns else 0.0
    return Motion(draw(vector), draw(vector.filter(any)), angle, draw(vector))


@st.composite
def queries(draw, turns):
    poses = [Pose(draw(vector.filter(any)) + (0.5,), draw(vector)) for _ in range(2)]
    pair = [draw(motions(turn)) for turn in turns]
    return Query("motion", body("convex"), bar("union"), *poses, *pair)


def distances(query: Query, t: float) -> np.ndarray:
    """Of every vertex of A to every vertex of B at time t: what no rigid change of frame alters."""
    a = query.motion.pose_at(query.pose_a, t).apply(query.a.vertices)
    b = query.motion_b.pose_at(query.pose_b, t).apply(query.b.vertices)
    return np.linalg.norm(a[:, None] - b[None], axis=2)


@settings(max_examples=60, deadline=None)
@given(
    st.sampled_from([(True, False), (False, True), (False, False)]).flatmap(queries),
    st.floats(0, 1),
)
def test_one_mover_asks_the_same(query, t):
    made = stated(query, movers=1, about=False)
    assert made.motion_b.rests and not made.motion.about.any()
    before, after = distances(query, t), distances(made, t)
    np.testing.assert_allclose(after.T if query.motion_b.angle else after, before, atol=1e-12)


@settings(max_examples=60, deadline=None)
@given(
    queries((True, True)),
    st.floats(0, 1),
    st.sampled_from([about_origins, lambda q: normalised(q, 1.0)]),
)
def test_both_turning_stays_the_same(query, t, change):
    made = change(query)
    unit = made.a.size / query.a.size
    np.testing.assert_allclose(distances(made, t) / unit, distances(query, t), atol=1e-12)


@settings(max_examples=60, deadline=None)
@given(queries((True, True)), st.floats(0, 1))
def test_a_is_placed_as_b_sees_it(query, t):
    at_a = query.motion.pose_at(query.pose_a, t)
    at_b = query.motion_b.pose_at(query.pose_b, t)
    still = replace(query, motion=Motion(), motion_b=Motion())
    made = replace(still, pose_a=seen_from(at_b, at_a, query.pose_b))
    np.testing.assert_allclose(distances(made, 0), distances(query, t), atol=1e-11)


def test_a_question_that_is_stated_so_already_is_left_alone():
    query = Query("motion", body("convex"), body("mesh"), motion=Motion((1, 2, 3), (1, 0, 0), 2.0))
    assert stated(query, movers=1, about=False) is query


def test_two_turning_bodies_are_no_question_about_one():
    query = Query(
        "motion", body("convex"), body("mesh"), motion=Motion(angle=1), motion_b=Motion(angle=1)
    )
    with pytest.raises(Unsupported, match="both bodies rotate"):
        one_mover(query)


def test_a_shifted_body_is_made_once():
    cube = body("union")
    assert shifted(cube, (1.0, 0.0, 0.0)) is shifted(cube, (1.0, 0.0, 0.0))
    assert (
        shifted(cube, (1.0, 0.0, 0.0)).pieces[0].vertices == cube.pieces[0].vertices - [1, 0, 0]
    ).all()


class Recorder(Method):
    """A method as its author writes it who never heard of motion_b: it keeps what it was given."""

    name = engine = imports = guarantee = "recorder"
    configuration, solid = "default", True
    questions, bodies = frozenset({"motion"}), frozenset({"convex"})

    def prepare(self, query):
        self.refuse(query)
        self.given = query
        return lambda: Verdict(False)


def test_who_does_not_declare_two_movers_is_never_given_them():
    method, cube = Recorder(), body("convex")
    query = Query(
        "motion", cube, cube, motion=Motion((3, 0, 0)), motion_b=Motion((1, 0, 0), angle=1.0)
    )
    method.ready(query)
    assert method.given.motion_b.rests and method.given.motion.displacement[0] == -2
    with pytest.raises(Unsupported, match="ready"):
        method.prepare(query)
    with pytest.raises(Unsupported, match="both bodies rotate"):
        method.ready(replace(query, motion=Motion(angle=1.0)))
    with pytest.raises(Unsupported, match="does not answer overlap"):
        method.ready(Query("overlap", cube, cube))


@pytest.mark.parametrize(
    "name", ["bullet", "coal-convex", "drake", "fcl-convex", "ipctk", "mujoco", "parry"]
)
def test_an_engine_that_places_both_says_what_the_relative_pose_says(name):
    """The bar falls onto the cube that rises and turns to it; both ways of posing meet it at one
    sample.
    """
    discrete, substeps = (registry.methods()[n] for n in (name, f"{name}-substeps"))
    if reason := registry.available(substeps):
        pytest.skip(reason)
    pair = Motion((0, 0, -3), (0, 1, 0), 1.0), Motion((0, 0, 2), (1, 1, 0), 2.0, (0.5, 0, 0))
    query = Query("motion", bar("convex"), body("convex"), Pose(position=(0, 0, 4)), Pose(), *pair)
    placed = substeps(n=64).ready(query)()
    place, test = discrete().build(replace(query, motion_b=Motion()))
    for i in range(1, 65):
        at_a, at_b = (m.pose_at(p, i / 64) for m, p in zip(pair, (query.pose_a, query.pose_b)))
        if test(place(seen_from(at_b, at_a, query.pose_b))):
            break
    assert placed.hit and placed.time == i / 64 and 0.1 < placed.time < 0.9
