# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""What is drawn is the case; a scenario may declare that it is rounded to float32 first, bodies
included.
"""

import numpy as np
import pytest

from experiments.cases.families import scenarios
from experiments.cases.scenario import Draft, Scenario, ScenarioError, snap, snap_body
from ofg import Body, Motion, Pose

CORNERS = np.array(list(np.ndindex(2, 2, 2)), float)
ODD = CORNERS * 0.1 + 1 / 3  # no coordinate of it is a float32 number


def bodies():
    hull = Body.convex(ODD, "hull")
    return [
        hull,
        Body.mesh(hull.vertices, hull.faces, "mesh"),
        Body.union([hull, Body.convex(ODD + 0.7)], "union"),
    ]


def scenario(precision, a, **motions):
    third = Pose(position=(1 / 3, 5, 0))
    return Scenario(
        "mine",
        "motion",
        "e",
        "a",
        (1.0,),
        lambda rng, level: Draft(a, a, third, Pose(), **motions),
        **precision,
    )


MOTIONS = {
    "motion": Motion((0.1, 0, 0), (0.1, 0, 1), 0.3, (0.7, 0, 0)),
    "motion_b": Motion((0.2, 0, 0)),
}


@pytest.mark.parametrize("a", bodies(), ids=lambda body: body.kind)
def test_without_a_word_a_case_is_what_was_drawn(a):
    case = scenario({}, a, **MOTIONS).case(0, 1.0, 0)
    assert case.precision == "float64" and case.query.a is a
    assert case.query.motion is MOTIONS["motion"] and case.query.pose_a.position[0] == 1 / 3


@pytest.mark.parametrize("a", bodies(), ids=lambda body: body.kind)
def test_float32_rounds_every_number(a):
    case = scenario({"precision": "float32"}, a, **MOTIONS).case(0, 1.0, 0)
    q = case.query
    numbers = [q.a.vertices.ravel(), *(p.vertices.ravel() for p in q.a.pieces), q.pose_a.position]
    for m in (q.motion, q.motion_b):
        numbers += [m.displacement, m.axis, [m.angle], m.about]
    for part in numbers:
        assert np.array_equal(part, snap(part))
    assert case.precision == "float32" and q.a.kind == a.kind and q.a.name == a.name
    assert np.abs(q.a.vertices - a.vertices).max() < 1e-7


def test_a_body_that_rounding_flattens_is_no_case():
    far = Body.convex(CORNERS * 1e-9 + 1, "crumb")
    assert scenario({}, far).case(0, 1.0, 0).query.a is far
    with pytest.raises(
        ScenarioError, match="rounded to float32, a body becomes invalid. Body 'crumb'"
    ):
        scenario({"precision": "float32"}, far).case(0, 1.0, 0)


def test_a_number_too_large_for_float32_is_no_case():
    huge = Motion((1e50, 0, 0))
    with pytest.raises(ScenarioError, match="not finite"):
        scenario({"precision": "float32"}, bodies()[0], motion=huge).case(0, 1.0, 0)


def test_another_precision_is_refused():
    with pytest.raises(ValueError, match="float16"):
        scenario({"precision": "float16"}, bodies()[0])


@pytest.mark.parametrize("family", scenarios().values(), ids=scenarios())
def test_families_here_draw_float32_bodies_already(family):
    """Their shapes are made of float32 numbers, so that declaring the precision makes no body
    anew.
    """
    assert family.precision == "float32"
    for level in family.levels:
        draft = family.generate(np.random.default_rng([7, len(family.name)]), level)
        for body in (draft.a, draft.b):
            assert snap_body(body) is body
