# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Judge each answer by the certified label of its case, never by another method."""

from __future__ import annotations

import numpy as np
import pandas as pd

from baselines import registry
from baselines.tolerance import NONE, Tolerance
from experiments.run import piece_truth
from experiments.run.bins import situation_of
from experiments.run.folder.rows import filled
from experiments.run.folder.store import Store, StoreError

from . import nesting

JUDGED = ("right", "miss", "false alarm")  # the outcomes that enter rates
FILE = "outcomes.parquet"
KEPT = (
    "case",
    "method",
    "scenario",
    "level",
    "question",
    "kind",
    "truth",
    "label",
    "gap",
    "relative_gap",
    "touching",
    "nested",
    "status",
    "hit",
    "time",
    "outcome",
    "wrong",
    "tolerance",
    "within",
    "can_tunnel",
    "tunnelled",
    "error",
)


def outcomes(store: Store, by_pieces: bool = True, nested: bool = True) -> pd.DataFrame:
    """One row per case and method: the observation, the truth and the outcome.

    outcome: "right"; "miss" (certified hit, answered clear); "false alarm" (certified clear,
    answered hit); "contained" (a test of surfaces missed a body inside the other whose surfaces do
    not meet; in no rate); "touching" (the bodies share a boundary point but no interior point, so
    neither answer is wrong; in no rate); "no label" (truth uncertain); or the status if it is not
    ok. wrong: a miss or a false alarm. tolerance: the distance that the method's documentation
    allows in this case, in units of length. within: wrong, and the clearance or penetration depth
    is within the tolerance. tunnelled: a miss of a sweep whose start and end are certified clear.
    error: signed error of the time of impact outside the certified bracket, as a share of the step:
    positive if late, negative if early, 0 inside; NaN if there is none. kind: of the bodies,
    "convex", "union", or "mesh" if one of them is. truth: "pieces" for a mesh query answered by a
    method that decomposes, whose label, bracket and gap are then those of the pieces, while
    relative_gap and situation remain those of the mesh; otherwise, and always if by_pieces is
    False, "mesh". The argument `nested` states whether to look for contained bodies.
    """
    said, cases = store.read("observations.parquet"), store.read("cases.parquet")
    unknown = said.case[~said.case.isin(cases.case)]
    if len(unknown):
        raise StoreError(
            f"{store.folder / 'observations.parquet'} has answers to the case '{unknown.iloc[0]}',"
            " which is not in cases.parquet. The run was changed or is damaged; copy it again from"
            " its source, or repeat it."
        )
    return judge(
        said,
        nesting.of(store, cases) if nested else cases,
        piece_truth.read(store) if by_pieces else None,
    )


def save(store: Store) -> None:
    """Write the outcomes that the tables count to outcomes.parquet, for a reader's own analysis."""
    found = with_pieces(store, outcomes(store))
    store.write(found[[name for name in KEPT if name in found]], FILE)


def judge(
    observations: pd.DataFrame, cases: pd.DataFrame, pieces: pd.DataFrame | None = None
) -> pd.DataFrame:
    """`outcomes` for rows of observations.parquet, cases.parquet and pieces.parquet. Without a
    column `nested` in `cases`, no outcome is "contained".
    """
    cases = filled(cases)
    cases = cases.assign(
        touching=cases.touching.astype(bool),
        path=_path(cases),
        nested=cases.nested if "nested" in cases else False,
    )
    table = observations.merge(
        cases.drop(columns=["certificate"]), on="case", how="left", validate="many_to_one"
    )
    table["relative_gap"], table["situation"] = table.gap / table["size"], situation_of(table)
    table = piece_truth.put(table, pieces)
    methods = _declared(table.method.unique())
    answered, hit = table.status == "ok", table.hit.fillna(False).astype(bool)
    clear, meets = table.label == "clear", table.label == "hit"
    surfaces = ~table.method.map({label: solid for label, (solid, _) in methods.items()}).astype(
        bool
    )
    table["outcome"] = np.select(
        [
            ~answered,
            table.label == "uncertain",
            table.touching,
            surfaces & table.nested & meets & ~hit,
            meets & ~hit,
            clear & hit,
        ],
        [table.status, "no label", "touching", "contained", "miss", "false alarm"],
        "right",
    )
    table["wrong"] = table.outcome.isin(["miss", "false alarm"])
    table["tolerance"] = _tolerances(table, methods)
    table["within"] = table.wrong & (table.gap.abs() <= table.tolerance)
    sweep = table.question != "overlap"
    table["can_tunnel"] = (
        answered & sweep & meets & (table.start == "clear") & (table.end == "clear")
    )
    table["tunnelled"] = table.can_tunnel & ~hit
    late, early = (table.time - table.t_hi).clip(lower=0), (table.time - table.t_lo).clip(upper=0)
    timed = answered & sweep & meets & hit & table.time.notna() & (table.start == "clear")
    table["error"] = (late + early).where(timed)
    return table


def with_pieces(store: Store, found: pd.DataFrame) -> pd.DataFrame:
    """`outcomes`, followed by the certified answers of the pieces, judged by the meshes."""
    pieces = piece_truth.read(store)
    if pieces is None:
        return found
    cases = filled(store.read("cases.parquet"))
    own = judge(piece_truth.own_error(cases, pieces), cases)
    return pd.concat([found, own], ignore_index=True) if len(own) else found


def _path(cases: pd.DataFrame) -> np.ndarray:
    """(n,) upper bounds of the path length of a point of one body relative to the other, length.

    The relative displacement, plus, for each body, its angle times a bound on the distance of a
    point of either body from the axis: the size plus the distance of the rotation centre `about`
    from the body's origin.
    """
    if "displacement" not in cases:
        return np.zeros(len(cases))
    gone = np.stack(cases.displacement.to_list()) - np.stack(cases.displacement_b.to_list())
    made = np.linalg.norm(gone, axis=1)
    for side in ("", "_b"):
        lever = np.linalg.norm(np.stack(cases[f"about{side}"].to_list()), axis=1)
        made += cases[f"angle{side}"].abs().to_numpy() * (cases["size"].to_numpy() + lever)
    return made


def _tolerances(table: pd.DataFrame, methods: dict[str, tuple[bool, Tolerance]]) -> pd.Series:
    """The declared tolerance for the error possible in each row (miss or false alarm), length."""
    made, hits = np.zeros(len(table)), (table.label == "hit").to_numpy()
    for label, rows in table.groupby("method", sort=False).indices.items():
        _, declared = methods[label]
        rows = rows[np.where(hits[rows], declared.covers("misses"), declared.covers("alarms"))]
        made[rows] = declared.reach(table["size"].to_numpy()[rows], table.path.to_numpy()[rows])
    return pd.Series(made, index=table.index)


def _declared(labels) -> dict[str, tuple[bool, Tolerance]]:
    """Whether each method tests solids, and its tolerance; (True, NONE) if the method's file is
    missing.
    """
    return {
        label: (m.solid, m.tolerance) if (m := method_of(label)) else (True, NONE)
        for label in labels
    }


def method_of(label: str):
    """The method of a label, or None if its file is missing."""
    try:
        return registry.make(label)[0]
    except (ValueError, ImportError):
        return None


def out_of_their_depth(table: pd.DataFrame) -> set[str]:
    """Labels of single-precision methods that answered cases stored in double precision."""
    asked = table[(table.precision == "float64") & (table.status == "ok")].method.unique()
    return {label for label in asked if (m := method_of(label)) and m.precision == "single"}
