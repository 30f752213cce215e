# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Two regular bodies, or two irregular ones, with a given number of faces, slightly apart or
slightly penetrating.
"""

from experiments.cases.placement import seat
from experiments.cases.scenario import Draft, Scenario
from experiments.cases.shapes import box, hull, icosphere

SUBDIVISIONS = {20: 0, 80: 1, 320: 2, 1280: 3, 5120: 4, 20480: 5}


def generate(rng, level) -> Draft:
    kind, faces = ("regular", "hulls")[rng.integers(2)], int(level)
    if kind == "regular":
        a = b = icosphere(SUBDIVISIONS[faces]) if faces in SUBDIVISIONS else box()
    else:
        a, b = (hull(faces, int(rng.integers(2))) for _ in range(2))
    s = seat(rng, a, b)
    s.tags["kind"] = kind
    return s.apart(rng.choice([1e-1, 1e-2, 1e-3]) * rng.choice([-1, 1]) * s.size)


SCENARIO = Scenario(
    name="face_count",
    question="overlap",
    precision="float32",
    exposes=(
        "how the cost grows with the number of faces, and how small a share of them a selection "
        "of k faces is"
    ),
    axis="faces of each body",
    levels=(12.0, *map(float, SUBDIVISIONS)),
    generate=generate,
)
