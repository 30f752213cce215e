# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""What a reader counts in outcomes.parquet is what the tables print, to the digit."""

import pandas as pd
import pytest

from experiments.analysis.views import LEAST


@pytest.fixture(scope="module")
def said(run):
    """Read as a notebook would: no module of this project is asked."""
    return pd.read_parquet(run.folder / "outcomes.parquet")


def table(run, name):
    return pd.read_csv(run.folder / "tables" / f"{name}.csv")


def counted(part, by):
    """Misses, false alarms, wrong, beyond, contained and judged of each group."""
    judged = part.outcome.isin(["right", "miss", "false alarm"])
    flags = pd.DataFrame(
        {
            "misses": part.outcome == "miss",
            "false_alarms": part.outcome == "false alarm",
            "wrong": part.outcome.isin(["miss", "false alarm"]),
            "beyond": (
                part.outcome.isin(["miss", "false alarm"]) & ~(part.gap.abs() <= part.tolerance)
            ),
            "contained": part.outcome == "contained",
            "judged": judged,
            "hits": judged & (part.label == "hit"),
            "clears": judged & (part.label == "clear"),
        }
    )
    return flags.groupby([part[name] for name in by]).sum()


def same(run, name, mine, by):
    printed = table(run, name).set_index(by)
    columns = [c for c in mine if c in printed]
    assert "beyond" in columns and ("wrong" in columns or "misses" in columns)
    mine = mine.loc[printed.index]
    for column in columns:
        assert printed[column].tolist() == mine[column].tolist(), (name, column)


@pytest.mark.parametrize("question", ["overlap", "translation", "motion"])
def test_tables_of_a_question(run, said, question):
    part = said[said.question == question]
    for name, by in (
        (f"accuracy-{question}", ["method"]),
        (f"scenarios-{question}", ["method", "scenario"]),
    ):
        same(run, name, counted(part, by), by)
    kept = (part.status == "ok").groupby(part.method).mean()
    own = part[part.method.isin(set(table(run, f"accuracy-{question}").method) - {"CoACD pieces"})]
    shared = own[own.method.isin(kept.index[kept >= LEAST])]
    whole = (shared.status == "ok").groupby(shared.case).all()
    common = shared[shared.case.isin(whole.index[whole])]
    same(run, f"common-{question}", counted(common, ["method"]), ["method"])
    ranks = counted(common, ["method"]).wrong.rank(method="min").astype(int)
    assert table(run, f"common-{question}").set_index("method")["rank"].to_dict() == ranks.to_dict()


def test_the_leaderboard(run, said):
    same(run, "leaderboard", counted(said, ["method"]), ["method"])


def test_the_bands_of_the_gap(run, said):
    part = said[(said.question == "overlap") & said.relative_gap.notna()]
    edges = [-float("inf"), -1e-2, -1e-4, -1e-7, 0.0, 1e-7, 1e-4, 1e-2, float("inf")]
    names = [
        "below -1e-2",
        "-1e-2 to -1e-4",
        "-1e-4 to -1e-7",
        "-1e-7 to 0",
        "0 to 1e-7",
        "1e-7 to 1e-4",
        "1e-4 to 1e-2",
        "above 1e-2",
    ]
    mine = counted(
        part.assign(band=pd.cut(part.relative_gap, edges, labels=names).astype(str)),
        ["method", "band"],
    )
    printed = table(run, "gap-overlap").set_index(["method", "band"])
    methods = printed.index.get_level_values("method").unique()
    mine = mine.loc[mine.index.get_level_values("method").isin(methods)]
    assert (
        set(printed.index) == set(mine.index)
        and len(set(printed.index.get_level_values("band"))) > 1
    )
    for column in ("misses", "false_alarms", "beyond", "contained", "hits", "clears"):
        assert printed[column].to_dict() == mine[column].to_dict(), column
