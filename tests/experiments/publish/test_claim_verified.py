# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The verdict on verified OFG turns when the rows of the native study do."""

import numpy as np
import pandas as pd

from experiments.publish.findings.runs import FAILS, HOLDS, PART, UNMEASURED
from experiments.studies.native.ratios import CACHE, MPR, VERIFIED, ratios
from experiments.studies.native.summary import summary

from .fake_runs import Fake, of, said

TITLE = "Verified OFG never misses"
CELL = {"bodies": "hull", "question": "overlap", "situation": "gap"}
OURS = ("SSE2", "AVX2", "AVX-512")
THEIRS = ("generic", "x86-64-v3")


def study(own: dict, wrong: str = "", engine: float = 100.0) -> Fake:
    """own: ns of verified OFG by faces; of mpr 60. parry takes `engine`, bullet 1 but is wrong in
    every cell; wrong: another method that is.
    """
    rows = []
    for faces, ns in own.items():
        each = [(VERIFIED, OURS, ns), (MPR, OURS, 60.0)]
        each += [("parry", THEIRS, engine), ("bullet", THEIRS, 1.0)]
        each += [("spheres-parry", THEIRS, 2.0)]
        for name, builds, took in each:
            for isa in builds:
                for mode in ("cold", "coherent"):
                    kept = CACHE if mode == "coherent" and isa in OURS else ""
                    row = {**CELL, "faces": str(faces), "engine": name + kept, "isa": isa}
                    row |= {"build": "", "mode": mode, "build_ns": 1, "built": 2, "bytes": -1}
                    rows += [{**row, "block": b, "ns": took * (1 + b)} for b in range(3)]
    times = pd.DataFrame(rows)
    bad = times.engine.isin(["bullet", wrong])
    answers = times.assign(hit=bad, label="clear", time=np.nan, case="x")
    return Fake(rows=summary(times, answers), ratios=ratios(times, answers))


def test_it_holds_where_it_is_faster_everywhere_and_never_wrong():
    """Neither bullet, which is wrong, nor an engine behind OFG's spheres is what it is put over."""
    found = of(TITLE, study({12: 20.0, 80: 20.0}))
    assert found.verdict == HOLDS
    assert "0 wrong answers of 36" in found.number and "geometric mean 5" in found.number
    assert "12 of 12 cells" in found.number
    assert "spheres are faster than it in 12 of 12 cells" in found.number
    assert "bullet" not in found.text and "0.1, above 1 in 0 and below 1 in 4" in found.text
    assert "without them: SSE2: 3," in found.text, "what opposing faces bring"


def test_it_holds_in_part_where_it_is_faster_in_most_cells():
    found = of(TITLE, study({12: 20.0, 80: 20.0, 320: 200.0}))
    assert found.verdict == PART and "0.5 [0.5, 0.5] (hull 320 gap cold" in found.text
    assert said(TITLE, study({12: 20.0, 80: 200.0})) == FAILS, "half is not most"


def test_a_wrong_answer_turns_it():
    assert said(TITLE, study({12: 20.0}, wrong=VERIFIED)) == FAILS
    assert said(TITLE, study({12: 20.0}, wrong=VERIFIED + CACHE)) == FAILS


def test_without_a_study_it_is_not_measured():
    assert said(TITLE, Fake()) == UNMEASURED
