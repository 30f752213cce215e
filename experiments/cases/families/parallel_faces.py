# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Two faces that are parallel, or minutely tilted, with a gap between them or penetrating."""

from dataclasses import replace

from experiments.cases.placement import seat
from experiments.cases.scenario import Draft, Scenario
from experiments.cases.shapes import any_convex, box, hull_of, scaled
from ofg import Body


def generate(rng, level) -> Draft:
    s = seat(rng, scaled(any_convex(rng), 0.25), box(2.0, 2.0, 0.5), "face-face")
    gap = rng.choice([1e-2, 1e-4, 1e-6, 1e-8]) * rng.choice([-1, 1])
    return replace(s, a=tilted(s.a, level)).apart(gap * s.size)


def tilted(body: Body, slope: float) -> Body:
    """The body with its bottom face sheared by `slope` along x, not below z = 0: a pose could
    not represent a tilt of 1e-12.
    """
    v = body.vertices.copy()
    ground = v[:, 2] == 0
    v[ground, 2] = slope * (v[ground, 0] - v[ground, 0].min())
    return hull_of(v, body.name)


SCENARIO = Scenario(
    name="parallel_faces",
    question="overlap",
    precision="float32",
    exposes="stalls and cycles of GJK and EPA, whose simplices degenerate between parallel faces",
    axis="tilt, radians",
    levels=(1e-2, 1e-3, 1e-5, 1e-7, 1e-9, 1e-12, 0.0),
    generate=generate,
)
