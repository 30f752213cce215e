# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Verified OFG in the native study: what it is put over, its growth, and its targets."""

import numpy as np
import pandas as pd
import pytest

from experiments.studies.native import further, lanes, preparation, targets
from experiments.studies.native.classes import V3
from experiments.studies.native.ratios import CACHE, MPR, SCREENED, VERIFIED, growths, ratios
from experiments.studies.native.summary import summary

BLOCKS = 5


def times(each: dict, mode="warm", faces=80, situation="gap", **columns) -> pd.DataFrame:
    """Rows of one cell: each engine's ns, in block b times 2**b; OFG with AVX2, the others V3."""
    rows = [
        {
            "bodies": "hull",
            "faces": str(faces),
            "question": "overlap",
            "situation": situation,
            "engine": name,
            "isa": "AVX2" if name.startswith("ofg") else V3,
            "build": "here",
            "mode": mode,
            "block": b,
            "ns": ns * 2.0**b,
            "build_ns": 1000,
            "built": 2,
            "bytes": 4096,
            **columns,
        }
        for name, ns in each.items()
        for b in range(BLOCKS)
    ]
    return pd.DataFrame(rows)


def answers(rows: pd.DataFrame, wrong=()) -> pd.DataFrame:
    """A clear case for each row, a false alarm of those that are wrong."""
    return rows.assign(case="x", time=np.nan, hit=rows.engine.isin(wrong), label="clear")


def against(rows: pd.DataFrame, wrong=()) -> pd.DataFrame:
    return ratios(rows, answers(rows, wrong)).set_index(["mode", "against"])


EACH = {VERIFIED: 10, MPR: 20, SCREENED: 15, "parry": 50, "bullet": 30, "spheres-bullet": 5}


def test_the_engine_is_the_fastest_without_an_error_and_no_control():
    found = against(times(EACH))
    assert found.ratio.to_dict() == {
        ("warm", "engine"): 3,
        ("warm", "spheres"): 0.5,
        ("warm", "mpr"): 2,
        ("warm", "screen"): 1.5,
    }
    assert found.over["warm", "engine"] == "bullet"
    found = against(times(EACH), wrong=["bullet", "spheres-bullet"])
    assert found.over["warm", "engine"] == "parry" and found.ratio["warm", "engine"] == 5
    assert ("warm", "spheres") not in found.index
    assert (found.low == found.high).all(), "paired by block, whose times differ by 16 times"


def test_a_wrong_answer_in_another_cell_leaves_an_engine_in_this_one():
    rows = [times(EACH), times(EACH, situation="deep")]
    said = pd.concat([answers(rows[0], ["bullet"]), answers(rows[1])])
    found = ratios(pd.concat(rows), said)
    over = found[found.against == "engine"].set_index("situation").over
    assert over.to_dict() == {"gap": "parry", "deep": "bullet"}


def test_an_engine_that_refuses_a_block_is_not_put_over():
    rows = times(EACH)
    rows = rows[(rows.engine != "bullet") | (rows.block > 0)]
    assert against(rows).over["warm", "engine"] == "parry"


def test_a_batch_is_put_over_single_calls_and_a_cache_stands_in_coherent_cells():
    batch = times({VERIFIED: 5, SCREENED: 4}, "batch")
    found = against(pd.concat([times(EACH), batch]))
    assert found.ratio["batch", "engine"] == 6 and found.ratio["batch", "screen"] == 0.8
    assert ("batch", "mpr") not in found.index
    kept = {VERIFIED + CACHE: 2, MPR + CACHE: 3, "parry, kept manifold": 8}
    found = against(times({**EACH, **kept}, "coherent"))
    assert found.ratio["coherent", "engine"] == 4 and found.ratio["coherent", "mpr"] == 1.5


@pytest.mark.parametrize("power", [0.0, 0.5, 1.0])
def test_growth_is_the_exponent_of_a_power_of_the_faces(power):
    sizes = [times({VERIFIED: faces**power}, faces=faces) for faces in (12, 80, 1280, 20480)]
    (found,) = growths(pd.concat(sizes)).to_dict("records")
    assert found["exponent"] == pytest.approx(power)
    assert found["low"] <= power <= found["high"]
    assert growths(pd.concat(sizes[:3])).empty, "no 20,480 faces"


def test_targets_count_cells_and_name_the_worst():
    cells = [
        times({VERIFIED: 10, "parry": engine}, faces=faces)
        for faces, engine in ((12, 34), (80, 31), (1280, 70), (5120, 1))
    ]
    rows = pd.concat(cells)
    found = targets.table(ratios(rows, answers(rows)), growths(rows))
    row = found[(found.OFG == "AVX2") & found.target.str.startswith("one call, warm")].iloc[0]
    assert row.reached == "1 of 3", "12 faces ask for 3.5, 1,280 for 8, and 5,120 for nothing"
    assert row["worst cell"] == "hull 1280 gap, parry" and row.ratio == "7.00 (7.00-7.00)"
    others = found[~found.target.str.contains("one call, warm")]
    assert (others.reached == "-").all(), "what was not measured is not reached"


def test_preparation_pays_after_as_many_queries_as_save_its_time():
    rows = times({VERIFIED: 10, MPR: 20, "parry": 5})
    said = answers(rows)
    (row,) = preparation.table(summary(rows, said), ratios(rows, said)).to_dict("records")
    assert row["mpr's queries"] == "25", "1,000 ns, and 4 times 10 saved by the median block"
    assert row["engine"] == "parry" and row["engine's queries"] == "-", "never"
    assert row["KiB per body"] == "2"


def test_verified_ofg_has_an_explanation_of_its_own():
    """It was given that of OFG as written, of workspaces that it does not have."""
    table = pd.DataFrame({"method": ["ofg k=8", VERIFIED, "fcl-convex"], "ratio": [2.0, 2.0, 0.5]})
    lines = lanes.explained(table)
    assert [line.split(" (")[0] for line in lines] == ["- fcl", "- ofg", "- ofg-verified"]
    assert "workspace" in lines[1] and "workspace" not in lines[2]


def test_further_cells_lie_where_they_are_said_to():
    cells = list(further.cells(32, 3))
    labels = {"gap": "clear", "shallow": "hit", "deep": "hit", "apart": "clear"}
    assert all(set(c.labels) == {labels[c.situation]} for c in cells)
    asked = {(c.bodies, c.faces, c.situation) for c in cells}
    assert len(asked) == len(cells) == 14
    assert {("ico", "20480", "deep"), ("hull", "320", "apart")} <= asked
