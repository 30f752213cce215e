# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The cases that are timed together: of one question, size and situation."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd

from baselines import registry
from experiments.cases.case import Case

from .config import RunConfig
from .folder.rows import cases_of
from .folder.store import Store

SITUATIONS = ("deep", "near", "apart", "hit", "clear")  # see situation_of
# least number of faces, name
SIZES = (
    (0, "to 24"),
    (25, "25-150"),
    (151, "151-700"),
    (701, "over 700"),
)
NEAR = 1e-2  # of gap over size: cases closer to contact are timed separately


@dataclass(frozen=True)
class Bin:
    """Cases of one question, one range of faces (of the larger body), one situation. methods:
    label -> ids of the cases it answered.
    """

    question: str
    faces: str
    situation: str
    cases: list[Case]
    methods: dict[str, set[str]]


def choose(store: Store, config: RunConfig) -> list[Bin]:
    """The first cases of each bin, spread evenly over its scenarios and levels; the same for
    every method.
    """
    cases, observations = store.read("cases.parquet"), store.read("observations.parquet")
    objects = {case.id: case for case, _ in cases_of(cases, store.read("bodies.parquet"))}
    answered = observations[observations.status == "ok"].groupby("case").method.agg(set)
    labels = [m.label for spec in config.asked for m in registry.make(spec)]
    cases = cases[cases.label != "uncertain"].assign(
        faces=lambda c: size_of(c.faces), situation=situation_of
    )
    bins = []
    for (question, faces, situation), rows in cases.groupby(
        ["question", "faces", "situation"], sort=False, observed=True
    ):
        chosen = [
            objects[i]
            for i in rows.sort_values(["index", "scenario", "level"]).case[: config.timing.cases]
        ]
        methods = {
            label: {c.id for c in chosen if label in answered.get(c.id, ())} for label in labels
        }
        bins.append(
            Bin(question, faces, situation, chosen, {k: v for k, v in methods.items() if v})
        )
    return bins


def size_of(faces: pd.Series) -> pd.Series:
    """The range of faces to which each number belongs."""
    return pd.cut(
        faces,
        [least for least, _ in SIZES] + [np.inf],
        right=False,
        labels=[title for _, title in SIZES],
    ).astype(str)


def situation_of(cases: pd.DataFrame) -> pd.Series:
    """Overlap: "deep", "near" or "apart", by the signed gap over the size. Sweeps: their label."""
    relative = cases.gap / cases["size"]
    overlap = np.select([relative < -NEAR, relative > NEAR], ["deep", "apart"], "near")
    return pd.Series(np.where(cases.question == "overlap", overlap, cases.label), cases.index)
