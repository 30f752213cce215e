# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""After the article's scheme for concave bodies: two collections whose nearest pieces are not
the ones that collide.
"""

import numpy as np

from experiments.cases.placement import in_world
from experiments.cases.scenario import Draft, Scenario
from experiments.cases.shapes import box
from ofg import Body, Pose

BAR = 0.2  # width of the bars


def generate(rng, level) -> Draft:
    height = float(np.float32(rng.uniform(1.6, 2.4)))
    # A's block stands next to B's, apart from it. The end of A's bar, far from both centres, is at
    # B's upright bar.
    a = Body.union(
        [moved(box(0.5, 0.5, 0.5), [1.25, 0, 0]), moved(box(4, BAR, BAR), [2, height, 0])],
        "block and bar",
    )
    b = Body.union(
        [box(0.5, 0.5, 0.5), moved(box(BAR, 3, BAR), [-BAR / 2, 1.75, 0])], "block and upright bar"
    )
    size = min(a.size, b.size)
    return in_world(
        rng, Draft(a, b, Pose(position=[level * size, 0, 0]), Pose(), tags={"aim": level * size})
    )


def moved(body: Body, by) -> Body:
    return Body.convex(np.float32(body.vertices + by).astype(float), body.name)


SCENARIO = Scenario(
    name="article_pieces",
    question="overlap",
    exposes="the selection of a single pair of pieces by their centres",
    axis="signed gap / size",
    levels=(-0.01, -0.001, 0.001, 0.01),
    generate=generate,
    precision="float32",
)
