# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Objects whose arrays stay read-only, also in copies made by pickle and deepcopy."""

from __future__ import annotations

from typing import Any

import numpy as np


class Frozen:
    """Base of a frozen dataclass of arrays. Pickling a NumPy array drops its read-only flag; a
    method that wrote into a body would then change the queries of every later method.
    """

    def __setstate__(self, state: dict[str, Any]) -> None:
        for value in state.values():
            if isinstance(value, np.ndarray):
                value.setflags(write=False)
        self.__dict__.update(state)
