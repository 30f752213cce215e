"""A rod turns about its own centre and its end runs into a body at its side, or passes it; both ends of the step are clear."""

import numpy as np

from experiments.scenario import Draft, Scenario
from experiments.shapes import any_convex, rod, scaled
from ofg import Motion, Pose

from ._place import any_rotation, in_world


def generate(rng, level) -> Draft:
    spinner = rod(float(rng.choice([8, 16, 32])))
    place = ("in the way", "out of reach")[int(rng.random() < 0.35)]
    reach = rng.uniform(0.6, 0.9) if place == "in the way" else rng.uniform(1.01, 1.2)
    body = any_convex(rng)
    body = scaled(body, float(np.float32(min(0.4, 0.15 * level) / body.radius)))
    rotation = any_rotation(rng)
    angle = rng.uniform(0.35, 0.65) * level
    out = np.array([np.cos(angle), np.sin(angle), 0.0])
    inner = (Pose(rotation).apply(body.vertices) @ out).min()  # the body's point nearest the rod's centre, at `reach`
    motion = Motion([0, 0, 0], [0, 0, 1], level)
    draft = Draft(spinner, body, Pose(), Pose(rotation, (reach - inner) * out), motion, {"place": place})
    return in_world(rng, draft)


SCENARIO = Scenario(
    name="spin_side",
    question="motion",
    exposes="methods that linearise the path or leave the rotation out: the rod's centre does not move at all",
    axis="angle of the turn, radians",
    levels=(0.5, 1.0, 2.0, 3.0, 6.0),
    generate=generate,
    redraw_if=("start-overlap",),
)
