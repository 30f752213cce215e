"""Meshes of real objects thrown at one another while they turn: onto a point of the surface, just
short of it, or past.
"""

from experiments.cases.placement import in_world
from experiments.cases.realistic import throw
from experiments.cases.scenario import Draft, Scenario


def generate(rng, level) -> Draft:
    return in_world(rng, throw(rng, 2.0, level))


SCENARIO = Scenario(
    name="real_motion",
    question="motion",
    precision="float32",
    exposes="what a curved path of an uneven, concave body costs, and which pieces it really meets",
    axis="angle of the turn, radians",
    levels=(0.5, 1.5, 3.0, 6.0),
    generate=generate,
    redraw_if=("start-overlap",),
)
