"""Meshes of real objects thrown at a point of one another's surface, from outside, right through or just short of it."""

import numpy as np

from experiments.scenario import Draft, Scenario
from ofg import Motion, Pose

from ._place import in_world, touching
from ._real import any_pair


def generate(rng, level) -> Draft:
    a, b, kind = any_pair(rng)
    rotation, target, normal = touching(rng, a, b, 0.0)
    place = ("onto", "short of", "past")[rng.choice(3, p=[0.6, 0.2, 0.2])]
    heading = -normal + 0.5 * rng.normal(size=3)
    heading *= np.sign(-heading @ normal) / np.linalg.norm(heading)
    if place == "past":
        aside = np.cross(heading, rng.normal(size=3))
        target = target + aside / np.linalg.norm(aside) * rng.uniform(0.5, 1.5) * (a.radius + b.radius)
    travel = level * b.size
    clear_of_b = 1.1 * (a.radius + b.radius) + target @ heading
    start = target - (1.05 * travel if place == "short of" else clear_of_b) * heading
    motion = Motion(travel * heading)
    tags = {"kind": kind, "place": place, "bodies": f"{a.name} on {b.name}"}
    return in_world(rng, Draft(a, b, Pose(rotation, start), Pose(), motion, tags))


SCENARIO = Scenario(
    name="real_sweep",
    question="translation",
    exposes="sweeps of real meshes: hollow bodies, pieces, and thin parts of a few uneven triangles",
    axis="travel / size of the body hit",
    levels=(2.0, 5.0, 20.0),
    generate=generate,
    redraw_if=("start-overlap",),
)
