# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Two L-shaped bodies, each with its arm in the corner of the other; the end of one arm is near
the other's side or inside it.
"""

from experiments.cases.placement import in_world
from experiments.cases.scenario import Draft, Scenario
from experiments.cases.shapes import hook
from ofg import Pose

ARM, WIDTH = 1.0, 0.25


def generate(rng, level) -> Draft:
    form = ("mesh", "union")[rng.integers(2)]
    body = hook(ARM, WIDTH, form)
    far = ARM - WIDTH
    across = rng.uniform(0.1, 0.6) * far, rng.uniform(-0.7, 0.7) * WIDTH
    # B is rotated by half a turn about z; its upright stands before the end of A's foot, its foot
    # before A's upright.
    b = Pose([0, 0, 0, 1], [far + level * body.size, *across])
    return in_world(
        rng, Draft(body, body, Pose(), b, tags={"form": form, "aim": level * body.size})
    )


SCENARIO = Scenario(
    name="hooked_ls",
    question="overlap",
    precision="float32",
    exposes=(
        "the selection of pieces: those with the closest centres do not collide, and the hulls "
        "always overlap"
    ),
    axis="signed gap / size",
    levels=tuple(sign * 10.0**-e for e in (1, 2, 3, 4, 5) for sign in (1, -1)),
    generate=generate,
)
