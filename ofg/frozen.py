"""Objects whose arrays cannot be written, also in the copies that pickle and deepcopy make."""

from __future__ import annotations

from typing import Any

import numpy as np


class Frozen:
    """Base of a frozen dataclass of arrays. Numpy forgets on the way through pickle that an array
    is read-only: what one method writes into a body, every later method would be asked about.
    """

    def __setstate__(self, state: dict[str, Any]) -> None:
        for value in state.values():
            if isinstance(value, np.ndarray):
                value.setflags(write=False)
        self.__dict__.update(state)
