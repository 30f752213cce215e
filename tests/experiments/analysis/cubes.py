# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Cases in memory for tests that count: poses and bodies of two cubes far apart, so that nobody is
contained.
"""

import numpy as np
import pandas as pd

from experiments.run.folder.rows import body_row
from ofg import Body

BODY = Body.convex(np.array(np.meshgrid([-1, 1], [-1, 1], [-1, 1])).reshape(3, -1).T, "cube")
BODIES = pd.DataFrame([body_row(BODY)])


def placed(cases: pd.DataFrame) -> pd.DataFrame:
    """The cases with poses and bodies."""
    n = len(cases)
    return cases.assign(
        body_a=BODY.digest,
        body_b=BODY.digest,
        quaternion_a=[[1.0, 0, 0, 0]] * n,
        quaternion_b=[[1.0, 0, 0, 0]] * n,
        position_a=[[0.0] * 3] * n,
        position_b=[[9.0, 0, 0]] * n,
    )
