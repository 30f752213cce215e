"""The certified truth of the convex pieces that some methods put in place of meshes."""

from __future__ import annotations

import pandas as pd

from baselines import registry

from .folder.store import Store

FILES = ("pieces.parquet", "pieces-bodies.parquet")
NAME = "CoACD pieces"  #: whose row the pieces' own error is: no engine
CLAIMS = ("precision", "label", "t_lo", "t_hi", "start", "end", "gap", "touching")
PIECES, MESH = "pieces", "mesh"


def read(store: Store) -> pd.DataFrame | None:
    """The rows of pieces.parquet; None of a run without them, which is judged by the meshes."""
    return store.read(FILES[0]) if store.has(FILES[0]) else None


def put(table: pd.DataFrame, pieces: pd.DataFrame | None) -> pd.DataFrame:
    """Answers with their cases' truth, and that of the pieces where a method was asked about them.

    table: rows of observations.parquet merged with cases. truth: PIECES, or MESH where the bodies
    are judged as they are given. case_label: the label by the bodies as they are given.
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
    """As the method declares it; False for one whose file is not there any more."""
    try:
        return bool(registry.make(label)[0].decomposes)
    except (ValueError, ImportError):
        return False


def own_error(cases: pd.DataFrame, pieces: pd.DataFrame) -> pd.DataFrame:
    """What the pieces say of the meshes, as rows of observations.parquet under NAME.

    Of the cases where both are certified; without those whose pieces touch, which say nothing.
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
    """The sentences under a table that say who is judged by the truth of pieces; "" if nobody
    is.
    """
    methods = table.method[table.truth == PIECES].unique()
    if not len(methods):
        return ""
    own = (
        f" {NAME} is no engine: the certified answers of the pieces, judged by the meshes, where "
        "both are certified."
        if (table.method == NAME).any()
        else ""
    )
    return (
        " Judged on meshes by the certified truth of the pieces that they are decomposed into: "
        f"{', '.join(methods)}.{own}"
    )


def as_cases(cases: pd.DataFrame, pieces: pd.DataFrame) -> pd.DataFrame:
    """Rows of cases.parquet, in the order of `pieces`, about the pieces and with their truth.

    Their bodies are in pieces-bodies.parquet. size and faces stay those of the meshes.
    """
    rest = cases.drop(columns=[c for c in pieces.columns if c != "case" and c in cases])
    return pieces.merge(rest, on="case", how="left", validate="one_to_one")
