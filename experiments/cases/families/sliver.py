# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Needles and plates that nearly touch or slightly penetrate: bodies of extreme aspect ratio, a
gap of at most half their thickness.
"""

from experiments.cases.placement import seat
from experiments.cases.scenario import Draft, Scenario
from experiments.cases.shapes import any_convex, plate, rod

PAIRS = {  # the bodies, and the features in contact
    "needle on needle": "edge-edge crossing",
    "plate on needle": "edge-face",
    "body on plate": "vertex-face",
    "plate on plate": "edge-edge crossing",
}


def generate(rng, level) -> Draft:
    kind = list(PAIRS)[rng.integers(len(PAIRS))]
    thin = {
        "needle": lambda: rod(level),
        "plate": lambda: plate(level),
        "body": lambda: any_convex(rng),
    }
    a, b = (thin[word]() for word in kind.split(" on "))
    s = seat(rng, a, b, PAIRS[kind])
    s.tags["kind"] = kind
    thickness = 2 / level
    return s.apart(rng.choice([-1, 1]) * rng.choice([0.5, 0.05, 0.005]) * thickness)


SCENARIO = Scenario(
    name="sliver",
    question="overlap",
    precision="float32",
    exposes=(
        "edge-edge axes that are lost, and large thin faces whose centres are far from the "
        "contact (OFG's selection)"
    ),
    axis="aspect: length / thickness",
    levels=(10.0, 100.0, 1e3, 1e4),
    generate=generate,
)
