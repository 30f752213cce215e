# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The native study of concave bodies: its cells and its page."""

from itertools import islice

import numpy as np
import pandas as pd
import pytest

from baselines import native
from baselines.native import casefile
from experiments.studies.native import concave
from experiments.studies.native.summary import summary

CELLS = concave.cells


def test_the_cells_are_where_they_say():
    cells = list(islice(concave.cells(3, 1), 6)) + list(islice(concave.cells(3, 1), 30, 33))
    assert concave.CELLS == 48 and [c.situation for c in cells] == ["gap", "shallow", "deep"] * 3
    assert [(c.bodies, c.faces) for c in cells[::3]] == [
        ("bumpy", "80"),
        ("bumpy", "320"),
        ("pieces of 12", "2"),
    ]
    for cell in cells:
        if cell.bodies == "bumpy":  # other shapes may part and meet again
            assert set(cell.labels) == {"clear" if cell.situation == "gap" else "hit"}
        for query in cell.queries:
            size = len(query.a.pieces) or len(query.a.faces)
            assert size == int(cell.faces)
            assert np.array_equal(query.a.vertices, np.float32(query.a.vertices))


def test_the_same_seed_draws_the_same_bodies(tmp_path):
    for name in ("one", "two"):
        casefile.write(tmp_path / name, next(concave.cells(2, 7)).queries)
    assert (tmp_path / "one").read_bytes() == (tmp_path / "two").read_bytes()


def test_the_page_puts_verified_ofg_over_the_fastest_library():
    cell = {"bodies": "bumpy", "faces": "80", "question": "overlap", "situation": "gap"}
    engines = (("ofg-verified", "SSE2", 100.0), ("fcl-mesh", "generic", 400.0))
    engines += (("coal-mesh", "as shipped", 300.0), ("ofg-verified", "AVX2", 75.0))
    who = [
        cell | {"engine": e, "isa": isa, "build": "here", "mode": "cold", "block": b}
        for e, isa, _ in engines
        for b in range(4)
    ]
    taken = pd.DataFrame(who)
    taken["ns"] = np.repeat([ns for _, _, ns in engines], 4)
    answers = taken.assign(case=taken.block, hit=taken.engine == "coal-mesh", label="clear")
    page = concave.page(summary(taken.assign(build_ns=1, built=2, bytes=-1), answers), ["Made up."])
    generic, v3 = page.split("## ")[1:]
    assert "| 100 | 400 fcl-mesh | - | - | 300 coal-mesh [4/4] | - | 0.33" in generic
    assert "| 75 |" in v3 and "0.25" in v3


@pytest.mark.skipif(not native.building.standing(), reason="the native lane is not built")
def test_the_study_is_written_with_its_page(tmp_path, monkeypatch):
    monkeypatch.setattr(concave, "cells", lambda cases, seed: islice(CELLS(cases, seed), 1))
    concave.study(2, 1, 1, None, tmp_path)
    assert (tmp_path / "native.md").read_text().startswith("# Concave bodies")
    assert "ofg-verified" in set(pd.read_parquet(tmp_path / "rows.parquet").engine)
