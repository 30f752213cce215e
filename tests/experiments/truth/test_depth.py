# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The depth of an overlap is the least translation that ends it, so no more than the one the
scenario was built with.

Cause of this test: of edge-edge contacts 1e-10 deep, `gap` came out as -0.05 (the depth along the
best face normal), and a miss at 1e-10 was filed in the tables under "deep". Tables are split by
this number, so it matters as much as the label.
"""

import pytest

from experiments.cases import families
from experiments.truth import label


@pytest.mark.parametrize("level", [-1e-2, -1e-4, -1e-6, -1e-8, -1e-10])
def test_depth_is_at_most_the_built_one(level):
    scenario = families.get("feature_gap")
    for index in range(14):
        case = scenario.case(1, level, index)
        truth = label(case.query)
        built = abs(level) * min(case.query.a.size, case.query.b.size)
        assert truth.label == "hit" and 0 < -truth.gap <= 1.5 * built, (
            case.id,
            case.tags,
            truth.gap,
            built,
        )
