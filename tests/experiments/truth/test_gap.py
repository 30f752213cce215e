# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""How far below the distance a certified gap may be."""

import fcl

from experiments.cases import families
from experiments.truth import label


def surface(body, pose):
    model = fcl.BVHModel()
    model.beginModel(len(body.vertices), len(body.faces))
    model.addSubModel(body.vertices, body.faces)
    model.endModel()
    return fcl.CollisionObject(model, fcl.Transform(pose.rotation, pose.position))


def test_the_gap_of_an_overlap_is_at_most_15_percent_low():
    """The documentation said 5 %; this case, found by search over all families, is 10 % low."""
    query = families.get("scale").case(77, 0.001, 8).query
    sides = surface(query.a, query.pose_a), surface(query.b, query.pose_b)
    distance = fcl.distance(*sides, fcl.DistanceRequest(), fcl.DistanceResult())
    gap = label(query).gap
    assert 0.85 * distance < gap <= distance * (1 + 1e-9)
    assert gap < 0.95 * distance
