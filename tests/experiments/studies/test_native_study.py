# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The native study: its cells, what stands in which class, and the quotients."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from typer.testing import CliRunner

from baselines import native
from experiments.cli.app import app
from experiments.publish.report import lanes
from experiments.run.folder.store import Store, StoreError
from experiments.studies.native import certified, saving, synthetic, twins
from experiments.studies.native.classes import CLASSES, CONTROL, V3, library, standing
from experiments.studies.native.page import overview, page
from experiments.studies.native.ratios import growths, ratios
from experiments.studies.native.summary import interval, steps, summary

QUICK = Store(Path(__file__).parents[3] / "results" / "quick")
ENGINES = {"fcl-convex": ("generic", V3), "coal-convex": ("as shipped",)}
OFG = (
    "ofg k=8",
    "ofg k=8 screen=True",
    "ofg k=8 to step 1",
    "ofg k=8 to step 3",
    "ofg k=8 to step 6",
    "ofg-verified",
)


def times(ns, modes=("warm", "batch")) -> pd.DataFrame:
    """ns(engine, isa, mode, block): of one cell."""
    who = [(e, isa) for e in OFG for isa in CLASSES.values()]
    who += [(e, isa) for e, builds in ENGINES.items() for isa in builds]
    rows = [
        {
            "bodies": "hull",
            "faces": "80",
            "question": "overlap",
            "situation": "gap",
            "engine": e,
            "isa": isa,
            "build": "here",
            "mode": mode,
            "block": b,
            "ns": ns(e, isa, mode, b),
            "build_ns": 1,
            "built": 2,
            "bytes": -1,
        }
        for e, isa in who
        for mode in modes
        for b in range(6)
        if mode != "batch" or "screen" in e or "verified" in e
    ]
    return pd.DataFrame(rows)


def answers(rows: pd.DataFrame, hit, label) -> pd.DataFrame:
    """hit(engine, block), label(block), a case for each block."""
    return rows.assign(
        case=rows.block.map(str),
        time=np.nan,
        hit=[hit(e, b) for e, b in zip(rows.engine, rows.block)],
        label=rows.block.map(label),
    )


def made(ns=lambda e, isa, mode, b: 10.0 + b) -> pd.DataFrame:
    return study(ns)[0]


def study(ns=lambda e, isa, mode, b: 10.0 + b) -> tuple:
    """Rows, ratios and growths."""
    rows = times(ns)
    said = answers(rows, lambda e, b: False, lambda b: "clear")
    return summary(rows, said), ratios(rows, said), growths(rows)


def test_an_engine_stands_with_the_build_of_the_class_or_the_only_one():
    rows = times(lambda *_: 1.0)
    for name, own, fcl in (("generic", "SSE2", "generic"), (V3, "AVX2", V3)):
        found = standing(rows, name).groupby("engine").isa.unique()
        assert list(found["ofg k=8"]) == [own]
        assert list(found["fcl-convex"]) == [fcl] and list(found["coal-convex"]) == ["as shipped"]


def test_every_engine_of_the_plugins_belongs_to_a_library():
    for engine in ("fcl-convex-indep, cached guess", "parry", "parry, kept manifold", "mujoco"):
        assert library(engine) != "OFG"
    assert library("ofg k=8 to step 3") == library("ofg-verified, cache") == "OFG"
    assert library("spheres-fcl-convex-exact") == CONTROL, "no engine, and not OFG"


def test_quotients_are_of_the_same_class_and_block():
    def ns(engine, isa, mode, block):
        weight = {"SSE2": 4, "AVX2": 2, "generic": 3, V3: 1.5}.get(isa, 12)
        return weight * 2.0**block  # blocks differ much more than engines do

    rows = made(ns)
    ratio = rows.set_index(["class", "engine", "mode"]).ratio
    assert ratio["generic", "fcl-convex", "warm"] == pytest.approx(3 / 4)
    assert ratio[V3, "fcl-convex", "warm"] == pytest.approx(1.5 / 2)
    assert ratio[V3, "ofg k=8", "warm"] == pytest.approx(2 / 1.5)
    assert ratio["AVX-512", "ofg k=8", "warm"] == pytest.approx(12 / 1.5)


def test_a_batch_is_put_over_single_calls_of_the_same_poses():
    """Cells of other modes may bear the same name: what is quickest there is another question."""
    rows = times(
        lambda e, isa, mode, b: {"batch": 5.0, "cold": 1.0}.get(mode, 20.0),
        ("warm", "batch", "cold"),
    )
    found = summary(rows, answers(rows, lambda e, b: False, lambda b: "clear"))
    found = found[(found.engine == "ofg k=8 screen=True") & (found["class"] == V3)]
    assert found.set_index("mode").ratio.to_dict() == {"warm": 1.0, "batch": 0.25, "cold": 1.0}


@settings(deadline=None, max_examples=30)
@given(st.lists(st.floats(0.1, 10), min_size=1, max_size=12))
def test_an_interval_holds_its_median(values):
    found = interval(pd.Series(values))
    rounding = 1e-12
    assert found["low"] * (1 - rounding) <= found["ratio"] <= found["high"] * (1 + rounding)
    assert np.isnan(interval(pd.Series([np.nan]))["ratio"])


def test_wrong_answers_are_counted_of_certified_cases():
    rows = times(lambda *_: 1.0)
    said = answers(
        rows,
        lambda e, b: e == "fcl-convex",
        lambda b: ("hit", "hit", "hit", "clear", "clear", "uncertain")[b],
    )
    found = summary(rows, said).set_index(["class", "engine", "mode"])
    wrong = found[["misses", "hits", "false_alarms", "clears"]]
    assert list(wrong.loc[(V3, "fcl-convex", "warm")]) == [0, 3, 2, 2]
    assert list(wrong.loc[(V3, "ofg k=8", "warm")]) == [3, 3, 0, 2]


def test_steps_sum_up():
    last = {"ofg k=8 to step 1": 1.0, "ofg k=8 to step 3": 3.0, "ofg k=8 to step 6": 7.0}
    rows = made(lambda e, isa, mode, b: last.get(e, 20.0))
    (row,) = steps(rows, V3).to_dict("records")
    assert (row["1 spheres"], row["2-3 select A"], row["4-6 select B"]) == (1, 2, 4)
    assert row["7-8 face pairs"] == 13 and row["all"] == 20


def test_the_page_has_a_row_for_each_cell_and_mode_and_marks_single_calls():
    rows, over, grown = study()
    text = page(rows, ["facts"], over, grown)
    for name in CLASSES:
        assert f"OFG with {CLASSES[name]}" in text
    grid = overview(rows[rows["class"] == V3], over[over["class"] == V3])
    assert list(grid["ofg-verified"]) == ["12", "12"]
    assert list(grid["engine / verified"]) == ["1.00 (1.00-1.00)"] * 2
    assert list(grid["mode"]) == ["warm", "batch"]
    assert list(grid.FCL.str.contains(r"\*")) == [False, True] and set(grid.Bullet) == {"-"}


def test_what_is_written_is_what_was_found(tmp_path):
    found, over, grown = study(lambda e, isa, mode, b: 1234.567 + b)
    rows = saving.small(found)
    assert np.allclose(rows.ns, found.ns, rtol=5e-4) and np.allclose(rows.low, found.low, rtol=5e-3)
    written = page(rows, ["facts"], over, grown)
    saving.save(tmp_path, rows, written, {}, ratios=over, growths=grown)
    names = ("rows", "ratios", "growths")
    back, over, grown = (pd.read_parquet(tmp_path / f"{name}.parquet") for name in names)
    assert page(back, ["facts"], over, grown) == written == (tmp_path / "native.md").read_text()


def test_twins_are_told_by_all_parameters():
    engines = [
        "fcl-advancement-convex",
        "ofg k=8",
        "ofg k=8 to step 3",
        "parry-cast",
        "coal-convex, cached guess",
    ]
    labels = [
        "fcl-advancement-convex toc_err=0.0001",
        "ofg k=8 broad=start",
        "ofg k=8 repairs=none",
        "coal-convex",
    ]
    assert twins.pairs(engines, labels) == {
        "fcl-advancement-convex": "fcl-advancement-convex toc_err=0.0001",
        "ofg k=8": "ofg k=8 repairs=none",
    }
    assert twins.alone(engines, labels)[1] == ["ofg k=8 broad=start", "coal-convex"]


def test_the_certified_cases_of_a_run_are_each_in_one_cell():
    cells = list(certified.cells(QUICK))
    names = [case for cell in cells for case in cell.cases]
    cases = QUICK.read("cases.parquet")
    sure = cases[cases.label != "uncertain"]
    assert len(names) == len(set(names)) == len(sure) - certified.left_out(QUICK)
    labels = dict(zip(sure.case, sure.label))
    assert all(
        labels[case] == label for cell in cells for case, label in zip(cell.cases, cell.labels)
    )
    assert max(len(cell.cases) for cell in certified.cells(QUICK, 3)) == 3


SAID = [("gap", "clear"), ("shallow", "hit"), ("deep", "hit")]


@pytest.mark.parametrize("situation, label", SAID)
def test_pairs_by_size_lie_where_they_are_said_to(situation, label):
    cell = synthetic.cold(80, situation, 6, seed=3)
    assert set(cell.labels) == {label} and len(cell.queries) == 6
    assert len({q.a.digest for q in cell.queries}) == 6, "every body another"


def test_trajectories_take_small_steps():
    cell = synthetic.coherent(12, "contact", 64, seed=3)
    assert len(cell.queries) == 64 and cell.block == 8 and set(cell.labels) == {"hit", "clear"}
    places = np.array([q.pose_a.position for q in cell.queries]).reshape(8, 8, 3)
    assert np.linalg.norm(np.diff(places, axis=1), axis=2).max() < 0.2


def test_a_missing_engine_is_an_error_where_it_is_required(monkeypatch):
    monkeypatch.delenv(native.REQUIRED, raising=False)
    native.building.demand(["fcl: install it"])
    monkeypatch.setenv(native.REQUIRED, "required")
    native.building.demand([])
    with pytest.raises(native.NativeError, match="OFG_NATIVE=required.*fcl: install it"):
        native.building.demand(["fcl: install it"])


def test_the_command_says_in_a_line_what_it_lacks(monkeypatch):
    monkeypatch.setattr(native.building.shutil, "which", lambda *_, **__: None)
    done = CliRunner().invoke(app, ["native", "--build"])
    assert done.exit_code == 1 and "pip install cmake" in done.output


def test_a_folder_that_is_no_run_is_named():
    """It was said to be a run that is not finished, after everything had been built."""
    done = CliRunner().invoke(app, ["native", "nowhere"])
    assert isinstance(done.exception, StoreError) and "not a run folder" in str(done.exception)


def test_the_report_shows_what_the_study_found_of_a_run(tmp_path):
    rows = made().assign(bodies="convex", faces="25-150")
    store = Store(tmp_path)
    table = saving.for_report(rows, {"fcl-convex": "fcl-convex", "ofg k=8": "ofg k=8"})
    store.write_text(table.to_csv(index=False), "tables", "native.csv")
    shown = lanes.native(store, {"fcl-convex"})
    assert shown == {
        "native": {"fcl-convex": {"cases": [], "bins": [["overlap", "gap", "25-150", 12.5]]}}
    }
    (tmp_path / "tables" / "native.csv").write_text("nothing")
    with pytest.raises(StoreError, match="ofg-bench native"):
        lanes.native(store, {"fcl-convex"})
