# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Twins answer alike: the native lane, asked the cases of the run quick, beside the run's rows.

Of the engines that are built here (ofg-bench native --build); OFG_NATIVE=required demands all.
"""

import os
from pathlib import Path

import pandas as pd
import pytest

from baselines import native
from experiments.run.folder.store import Store
from experiments.studies.native import certified, measuring, synthetic, twins
from experiments.studies.native.classes import V3
from ofg.verification import prepare_verified

QUICK = Store(Path(__file__).parents[3] / "results" / "quick")
MOST = 20  # cases of a cell
REQUIRED = os.environ.get(native.REQUIRED) == "required"


@pytest.fixture(scope="module")
def answers() -> pd.DataFrame:
    if not (native.FOLDER / "lane").is_file():
        if REQUIRED:
            pytest.fail("the native lane is not built; build it with: ofg-bench native --build")
        pytest.skip("built by: ofg-bench native --build")
    cells = certified.cells(QUICK, MOST)
    return pd.concat([measuring.measure(cell, 1, 0, None)[1] for cell in cells])


def test_twins_answer_the_same_cases_alike(answers):
    """Builds for x86-64-v3 round otherwise, by fused multiply-adds: they are not compared here."""
    observed = QUICK.read("observations.parquet")
    told = twins.disagreements(answers[answers.isa != V3], observed)
    assert not told.differ.any(), told[told.differ > 0].to_string()
    assert {"ofg k=4", "ofg k=8", "ofg k=16", "ofg k=8 repairs=all"} <= set(told.engine)
    assert (told.cases >= 50).all()


def test_every_engine_with_a_method_in_the_run_is_joined(answers):
    """FCL, Bullet and MuJoCo: a method of the run has a twin wherever its plugin is built."""
    built, wanted = (
        set(native.building.standing()),
        {
            "fcl": {"fcl-convex", "fcl-convex-exact", "fcl-convex-indep", "fcl-mesh"},
            "fcl_casts": {"fcl-ccd-convex", "fcl-advancement-convex"},
            "bullet": {"bullet", "bullet-no-margin"},
            "mujoco": {"mujoco", "mujoco-exact", "mujoco-libccd"},
        },
    )
    assert not REQUIRED or set(wanted) <= built
    labels = QUICK.read("observations.parquet").method.unique()
    joined = set(twins.pairs(answers.engine.unique(), labels))
    for plugin in built & set(wanted):
        assert wanted[plugin] <= joined


@pytest.mark.parametrize("name, selection", [("ofg-verified", True), ("ofg-mpr", False)])
def test_verified_ofg_answers_as_from_python(answers, name, selection):
    """In every instruction set, and never wrongly."""
    own = answers[answers.engine == name]
    cells = [c for c in certified.cells(QUICK, MOST) if c.question == "overlap"]
    cells = [c for c in cells if selection or c.bodies == "convex"]
    queries = {case: query for cell in cells for case, query in zip(cell.cases, cell.queries)}
    assert set(own.isa) >= {"SSE2"} and set(own.case) == set(queries)
    there = {
        case: prepare_verified(query, selection=selection)()[0] for case, query in queries.items()
    }
    assert (own.hit == own.case.map(there)).all()
    assert (own.hit == (own.label == "hit")).all()


@pytest.mark.usefixtures("answers")
def test_neither_a_batch_nor_a_cache_changes_an_answer():
    cell = synthetic.coherent(80, "contact", 64, seed=3)
    taken = native.run(cell.queries, ("warm", "batch", "coherent"), cell.block, 1, 0)
    found = taken.answers.join(taken.contestants, on="id")
    found = found[found.engine.str.match("ofg-verified|ofg-mpr")]
    assert set(found["mode"]) == {"warm", "batch", "coherent"}
    assert "ofg-verified, cache" in set(found.engine)
    wanted = [label == "hit" for label in cell.labels]
    for _, rows in found.groupby("id"):
        assert list(rows.sort_values("case").hit.astype(bool)) == wanted


def test_spheres_settle_what_they_settle_rightly(answers):
    """An engine behind them answers as it does alone, or as certified."""
    behind = answers[answers.engine.str.startswith("spheres-")]
    assert twins.key("spheres-fcl-convex-exact"), "named as the method of the Python lane"
    behind = behind.assign(engine=behind.engine.str.removeprefix("spheres-"))
    key = ["engine", "isa", "build", "mode", "case"]
    both = behind.merge(answers, on=key, suffixes=("", "_alone"))
    assert len(both) == len(behind) > 0
    other = both[both.hit != both.hit_alone]
    assert (other.hit == (other.label == "hit")).all()


def test_answers_do_not_hang_on_what_the_memory_held(answers, monkeypatch):
    """FCL's interpolated motions read a point before it is written: they got blocks of a size
    that FCL does not ask for, and answered by what was freed before."""
    monkeypatch.setenv("GLIBC_TUNABLES", "glibc.malloc.perturb=128")
    cells = [cell for cell in certified.cells(QUICK, MOST) if cell.question == "motion"]
    again = pd.concat([measuring.measure(cell, 1, 0, None)[1] for cell in cells])
    key = ["engine", "isa", "build", "case"]
    both = answers.merge(again, on=key, suffixes=("", "_again"))
    assert len(both) == len(again) and (both.hit == both.hit_again).all()
    pd.testing.assert_series_equal(both.time, both.time_again, check_names=False)
