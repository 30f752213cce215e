"""Two convex bodies with one feature each a prescribed distance apart, or inside each other by as
much.
"""

from experiments.cases.placement import seat
from experiments.cases.scenario import Draft, Scenario
from experiments.cases.shapes import any_convex


def generate(rng, level) -> Draft:
    s = seat(rng, any_convex(rng), any_convex(rng))
    return s.apart(level * s.size)


SCENARIO = Scenario(
    name="feature_gap",
    question="overlap",
    precision="float32",
    exposes=(
        "absolute and relative tolerances: a method errs from the gap on at which its own epsilon"
        " begins"
    ),
    axis="signed gap / size",
    levels=tuple(sign * 10.0**-e for e in (1, 2, 3, 4, 6, 8, 10, 12, 14, 16) for sign in (1, -1)),
    generate=generate,
)
