# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""What verified OFG is to reach, written down before it was measured, and where it does."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import pandas as pd

from .classes import CLASSES, V3

GROWTH = 0.5  #: the largest exponent of time over faces, upper end of its interval
NEAR = ("gap", "shallow", "deep")
ALL = tuple(CLASSES)


@dataclass(frozen=True)
class Target:
    """Cells of one kind, and the ratio that each of them is to reach.

    against: of ratios.AGAINST. least: the ratio; but: faces -> another. faces: from, to.
    """

    what: str
    builds: str
    mode: str
    situations: tuple[str, ...]
    least: float
    but: Mapping[int, float] = field(default_factory=dict)
    against: str = "engine"
    faces: tuple[int, int] = (12, 1280)

    def cells(self, ratios: pd.DataFrame) -> pd.DataFrame:
        """The rows that it is about, with `wanted`."""
        rows = ratios[
            (ratios["class"] == self.builds)
            & (ratios["mode"] == self.mode)
            & (ratios.against == self.against)
            & ratios.situation.isin(self.situations)
            & ratios.faces.astype(str).str.isdigit()
            & ratios.ratio.notna()
        ]
        faces = rows.faces.astype(str).astype(int)
        rows = rows.assign(wanted=faces.map(lambda n: self.but.get(n, self.least)).astype(float))
        return rows[faces.between(*self.faces)]

    @property
    def asked(self) -> str:
        others = "; ".join(f"{n:,} faces: {least:g}" for n, least in self.but.items())
        return f">= {self.least:g}" + (f" ({others})" if others else "")


def _calls(builds: str, least: float, but: Mapping[int, float] = {}) -> list[Target]:
    return [
        Target(f"one call, {mode}", builds, mode, NEAR, least, but) for mode in ("warm", "cold")
    ]


TARGETS = (
    *_calls(V3, 3, {12: 3.5, 1280: 8}),
    Target("batch", V3, "batch", NEAR, 6),
    *_calls("AVX-512", 3.5),
    Target("batch", "AVX-512", "batch", NEAR, 8),
    *_calls("generic", 1.5),
    Target("near contact, with a cache", V3, "coherent", ("gap", "contact"), 5),
    *(
        Target(f"apart, {mode}", builds, mode, ("gap", "apart"), 1, {}, "screen", (320, 20480))
        for builds in ALL
        for mode in ("warm", "batch")
    ),
)


def table(ratios: pd.DataFrame, growths: pd.DataFrame) -> pd.DataFrame:
    """A row per target: what is asked, in how many cells it is reached, and the worst cell.

    ratios, growths: as ratios.py gives them. "-" where no cell of a target was measured.
    """
    rows = [_reached(target, target.cells(ratios)) for target in TARGETS]
    return pd.DataFrame([*rows, *(_grown(growths, name) for name in ALL)])


def _reached(target: Target, cells: pd.DataFrame) -> dict[str, str]:
    others = "screen" if target.against == "screen" else "fastest engine without an error"
    row = _head(target.builds, f"{target.what}: time of the {others} / its own", target.asked)
    if cells.empty:
        return row
    worst = cells.loc[(cells.ratio / cells.wanted).idxmin()]
    return row | {
        "reached": f"{(cells.ratio >= cells.wanted).sum()} of {len(cells)}",
        "by the interval": f"{(cells.low >= cells.wanted).sum()} of {len(cells)}",
        "worst cell": f"{worst.bodies} {worst.faces} {worst.situation}, {worst.over}",
        "ratio": f"{worst.ratio:.2f} ({worst.low:.2f}-{worst.high:.2f})",
    }


def _grown(growths: pd.DataFrame, name: str) -> dict[str, str]:
    rows = growths[growths["class"] == name]
    row = _head(name, "exponent of its time over 80 to 20,480 faces", f"<= {GROWTH:g}")
    if rows.empty:
        return row
    worst = rows.loc[rows.high.idxmax()]
    return row | {
        "reached": f"{(rows.exponent <= GROWTH).sum()} of {len(rows)}",
        "by the interval": f"{(rows.high <= GROWTH).sum()} of {len(rows)}",
        "worst cell": f"{worst.bodies} {worst.situation}, {worst['mode']}",
        "ratio": f"{worst.exponent:.2f} ({worst.low:.2f}-{worst.high:.2f})",
    }


def _head(builds: str, target: str, asked: str) -> dict[str, str]:
    row = {"OFG": CLASSES[builds], "target": target, "asked": asked}
    return row | dict.fromkeys(("reached", "by the interval", "worst cell", "ratio"), "-")
