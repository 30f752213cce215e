# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Units and origin: the question stays the same, and best-effort methods do not care about its
scale and place.
"""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from baselines import registry
from baselines.easy_queries import body, box
from baselines.units import normalised
from ofg import Body, Motion, Pose, Query

BEST = [
    name
    for name, cls in registry.methods().items()
    if cls.configuration == "best effort" and "overlap" in cls.questions and cls.solid
]
numbers = st.floats(-1e4, 1e4, width=32)


@settings(max_examples=50, deadline=None)
@given(
    p=st.tuples(numbers, numbers, numbers),
    d=st.tuples(numbers, numbers, numbers),
    power=st.integers(-20, 20),
    length=st.sampled_from([1.0, 32.0]),
)
def test_normalising_is_exact(p, d, power, length):
    size = 2.0**power
    a, b = box(size, 1.5 * size, 2 * size), box(3 * size, size, size)
    query = Query(
        "motion",
        a,
        Body.union([b, b]),
        Pose((1, 2, 3, 4), p),
        Pose((0, 1, 0, 1), (1, 2, 3)),
        Motion(d, (1, 0, 1), 2.0),
    )
    made = normalised(query, length)
    unit = made.a.vertices.max() / a.vertices.max()
    assert (
        2 ** round(np.log2(unit)) == unit
        and length / 1.5 < min(made.a.radius, made.b.radius) < length * 1.5
    )
    assert np.array_equal(made.a.vertices / unit, a.vertices) and np.array_equal(
        made.b.pieces[1].vertices / unit, b.vertices
    )
    assert (
        np.array_equal(made.pose_a.position / unit, query.pose_a.position - query.pose_b.position)
        and not made.pose_b.position.any()
    )
    assert (
        np.array_equal(made.motion.displacement / unit, query.motion.displacement)
        and made.motion.angle == 2.0
    )
    assert (
        np.array_equal(made.pose_a.quaternion, query.pose_a.quaternion)
        and made.question == query.question
    )


@pytest.mark.parametrize("name", BEST)
@pytest.mark.parametrize("size, far", [(2.0**-20, 0), (2.0**20, 0), (1.0, 2.0**24)])
def test_best_effort_knows_no_scale_and_no_place(name, size, far):
    cls = registry.methods()[name]
    if reason := registry.available(cls):
        pytest.skip(reason)
    cube = body("convex", size)
    (method,) = registry.make(name)
    for offset, hit in ((2.25, False), (2 + 2.0**-8, False), (2 - 2.0**-8, True)):
        query = Query(
            "overlap",
            cube,
            cube,
            Pose(position=(far + offset * size, 0.25 * size, far)),
            Pose(position=(far, 0, far)),
        )
        assert method.prepare(query)().hit == hit
