"""A small body wholly inside a large one (surfaces apart, solids overlap), or just outside it."""

from experiments.scenario import Draft, Scenario
from experiments.shapes import any_convex, scaled
from ofg import Pose

from ._place import in_world, touching


def generate(rng, level) -> Draft:
    large, small = any_convex(rng), any_convex(rng)
    small = scaled(small, level * large.size / small.size / 4)
    place = ("inside", "outside")[int(rng.random() < 0.3)]
    rotation, position, _ = touching(rng, small, large, small.size)
    if place == "inside":  # towards the centre, until the small body is clear of the surface
        position = position * rng.uniform(0.0, 0.4)
    draft = Draft(small, large, Pose(rotation, position), Pose(), tags={"place": place})
    return in_world(rng, draft)


SCENARIO = Scenario(
    name="contained",
    question="overlap",
    exposes="tests of surfaces alone, which see nothing when one body is wholly inside the other",
    axis="size of the inner body / size of the outer",
    levels=(0.5, 0.1, 1e-2, 1e-3),
    generate=generate,
)
