"""A body flies through a thin wall within one step, or past its rim; both ends of the step are clear."""

import numpy as np

from experiments.scenario import Draft, Scenario
from experiments.shapes import any_convex, box
from ofg import Motion, Pose

from ._place import any_rotation, in_world

HALF_WIDTH = 2.0


def generate(rng, level) -> Draft:
    a = any_convex(rng)
    run_up = a.radius + rng.uniform(0.2, 1.0)
    travel = 2 * run_up * level / (level - 1)
    wall = box(2 * HALF_WIDTH, 2 * HALF_WIDTH, float(np.float32(travel / level)))
    place = ("through", "past the rim")[int(rng.random() < 0.3)]
    along = rng.uniform(-1, 1, 2) if place == "through" else np.array([HALF_WIDTH + a.radius * rng.uniform(1.05, 1.5), 0.0])
    slant = rng.uniform(-0.5, 0.5, 2) * [place == "through", 1]
    start = Pose(any_rotation(rng), [*(along - slant / 2), travel / 2])
    draft = Draft(a, wall, start, Pose(), Motion([*slant, -travel]), {"place": place})
    return in_world(rng, draft)


SCENARIO = Scenario(
    name="thin_wall",
    question="translation",
    exposes="tunnelling: methods that look at the end pose, or at samples of the path",
    axis="travel in the step / thickness of the wall",
    levels=(2.0, 10.0, 100.0, 1e3, 1e4, 1e6),
    generate=generate,
    redraw_if=("start-overlap",),
)
