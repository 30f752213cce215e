# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The certified truth of the convex pieces that some methods use in place of meshes."""

from __future__ import annotations

import pandas as pd

from baselines import registry

from .folder.store import Store

FILES = ("pieces.parquet", "pieces-bodies.parquet")
NAME = "CoACD pieces"  #: whose row is the pieces' own error: not an engine
CLAIMS = ("precision", "label", "t_lo", "t_hi", "start", "end", "gap", "touching")
PIECES, MESH = "pieces", "mesh"


def read(store: Store) -> pd.DataFrame | None:
    """The rows of pieces.parquet; None for a run without them, which is judged by the meshes."""
    return store.read(FILES[0]) if store.has(FILES[0]) else None


def put(table: pd.DataFrame, pieces: pd.DataFrame | None) -> pd.DataFrame:
    """Answers with the truth of their cases, or of the pieces if a method answered for those.

    table: rows of observations.parquet merged with cases. truth: PIECES, or MESH if the original
    bodies are the reference. case_label: the label for the original bodies.
    """
    table = table.assign(case_label=table.label)
    if pieces is None:
        return table.assign(truth=MESH)
    names = {label for label in table.method.unique() if decomposes(label)}
    about = table.method.isin(names) & table.case.isin(pieces.case)
    own = pieces.set_index("case").loc[table.case[about]]
    made = table.assign(truth=about.map({True: PIECES, False: MESH}))
    for name in CLAIMS:
        made.loc[about, name] = own[name].astype(made[name].dtype).to_numpy()
    return made


def decomposes(label: str) -> bool:
    """As the method declares; False if its file no longer exists."""
    try:
        return bool(registry.make(label)[0].decomposes)
    except (ValueError, ImportError):
        return False


def own_error(cases: pd.DataFrame, pieces: pd.DataFrame) -> pd.DataFrame:
    """The answers of the pieces compared with the meshes, as rows of observations.parquet under
    NAME.

    Only cases with both certified; without those whose pieces touch, which decide nothing.
    """
    certain = cases.case[cases.label != "uncertain"]
    said = pieces[(pieces.label != "uncertain") & ~pieces.touching.astype(bool)]
    said = said[said.case.isin(certain)]
    return pd.DataFrame(
        {
            "case": said.case,
            "method": NAME,
            "status": "ok",
            "hit": (said.label == "hit").astype("boolean"),
            "time": float("nan"),
            "detail": "",
        }
    ).reset_index(drop=True)


def note(table: pd.DataFrame) -> str:
    """The sentences under a table that name the methods judged by the truth of pieces; "" if
    there are none.
    """
    methods = table.method[table.truth == PIECES].unique()
    if not len(methods):
        return ""
    own = (
        f" {NAME} is not an engine: the certified answers for the pieces, judged by the meshes, "
        "if both are certified."
        if (table.method == NAME).any()
        else ""
    )
    return (
        " On meshes, judged by the certified truth of the pieces into which they are decomposed: "
        f"{', '.join(methods)}.{own}"
    )


def as_cases(cases: pd.DataFrame, pieces: pd.DataFrame) -> pd.DataFrame:
    """Rows of cases.parquet, in the order of `pieces`, with the pieces as bodies and their truth.

    Their bodies are in pieces-bodies.parquet. size and faces stay those of the meshes.
    """
    rest = cases.drop(columns=[c for c in pieces.columns if c != "case" and c in cases])
    return pieces.merge(rest, on="case", how="left", validate="one_to_one")
