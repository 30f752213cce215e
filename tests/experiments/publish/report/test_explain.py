# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""ofg-bench explain: from a run, from its file, from a file written by hand; errors name the
remedy.
"""

import json

import numpy as np
import pandas as pd
import pytest
from typer.testing import CliRunner

from experiments.cases.case import Case
from experiments.cases.label import Truth
from experiments.cli.app import app
from experiments.publish.report import explain
from experiments.run.config import ConfigError
from experiments.run.folder.rows import case_row
from experiments.run.folder.store import StoreError
from ofg import Body, Motion, Pose, Query

CUBE = [[x, y, z] for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)]
HAND = {
    "case": {
        "question": "translation",
        "body_a": "cube",
        "body_b": "cube",
        "position_a": [0, 0, 5],
        "displacement": [0, 0, -8],
    },
    "bodies": [{"body": "cube", "kind": "convex", "vertices": np.ravel(CUBE).tolist()}],
}


def test_a_case_comes_back_from_its_file_as_it_was(run, tmp_path):
    for name in run.read("cases.parquet").case[::4]:
        made = explain.from_run(run, name)
        explain.save(made, tmp_path / "case.json")
        back = explain.from_file(tmp_path / "case.json")
        assert explain._listed({**back.row, "attempt": 0}) == explain._listed(
            {**made.row, "attempt": 0}
        ), name
        pd.testing.assert_frame_equal(explain.verdicts(back), explain.verdicts(made))


def test_a_file_by_hand_is_certified_and_asked(tmp_path):
    (tmp_path / "mine.json").write_text(json.dumps(HAND))
    result = CliRunner().invoke(
        app,
        [
            "explain",
            "--file",
            str(tmp_path / "mine.json"),
            "--method",
            "ofg k=12",
            "--method",
            "fcl-convex-substeps n=4",
            "--out",
            str(tmp_path / "mine.html"),
        ],
    )
    assert result.exit_code == 0, result.output
    found = explain.from_file(tmp_path / "mine.json")
    assert found.truth.label == "hit" and found.truth.t_lo <= 3 / 8 <= found.truth.t_hi
    lines = [line.split() for line in result.output.splitlines()]
    assert ["ofg", "k=12", "right", "0.375", "0"] in lines
    assert "certified hit" in result.output and "0.125" in next(
        line for line in lines if line[:1] == ["fcl-convex-substeps"]
    )
    assert "content-security-policy" in (tmp_path / "mine.html").read_text().lower()


def test_asked_anew_a_run_says_the_same(run, tmp_path):
    before = explain.from_run(run, run.read("cases.parquet").case.iloc[-1])
    again = explain.ask(before, run.config, tmp_path / "workers.log")
    pd.testing.assert_frame_equal(explain.verdicts(again), explain.verdicts(before))


@pytest.mark.parametrize(
    "change, words",
    [
        (lambda c: c["case"].pop("question"), "lacks the field 'question'"),
        (lambda c: c["case"].update(body_a="sphere"), "lacks the field 'sphere'"),
        (lambda c: c["bodies"][0].update(vertices=5), "wrong form"),
        (lambda c: c.pop("bodies"), "lacks the field 'bodies'"),
    ],
)
def test_a_wrong_file_is_told_what_it_lacks(tmp_path, change, words):
    content = json.loads(json.dumps(HAND))
    change(content)
    (tmp_path / "case.json").write_text(json.dumps(content))
    with pytest.raises(ValueError, match=words):
        explain.from_file(tmp_path / "case.json")


def test_what_is_not_there_is_said(run, tmp_path):
    with pytest.raises(StoreError, match="did you mean"):
        explain.from_run(run, run.read("cases.parquet").case.iloc[0] + "0")
    with pytest.raises(ConfigError, match="--save"):
        explain.from_file(tmp_path / "none.json")
    (tmp_path / "bad.json").write_text("{")
    with pytest.raises(ConfigError, match="not valid JSON"):
        explain.from_file(tmp_path / "bad.json")


def test_a_motion_in_words():
    assert explain.motion_words(Motion()) == "is at rest"
    turning = Motion((0, 0, -2), (0, 0, 1), 1.5, (1, 0, 0))
    assert (
        explain.motion_words(turning)
        == "translates by (0, 0, -2), rotates by 1.5 rad about the axis (0, 0, 1) through its point"
        " (1, 0, 0)"
    )


def test_a_file_keeps_both_motions(tmp_path):
    cube, turning = (
        Body.convex(np.array(list(np.ndindex(2, 2, 2)), float)),
        Motion((1, 0, 0), angle=2.0, about=(0, 1, 0)),
    )
    query = Query(
        "motion", cube, cube, Pose(), Pose(position=(5, 0, 0)), Motion((0, 1, 0)), turning
    )
    case, truth = (
        Case("mine/1/0000", "mine", 1.0, 0, query),
        Truth("clear", start="clear", end="clear"),
    )
    said = pd.DataFrame(columns=explain.COLUMNS).astype({"hit": "boolean", "time": float})
    explain.save(
        explain.Explained(case, truth, case_row(case, truth, 0), said), tmp_path / "case.json"
    )
    back = explain.from_file(tmp_path / "case.json").case.query
    assert explain.motion_words(back.motion) == explain.motion_words(query.motion)
    assert explain.motion_words(back.motion_b) == explain.motion_words(query.motion_b)


def test_pieces_of_a_wrong_form_are_refused_by_their_field(run, tmp_path):
    name = run.read("pieces.parquet").case.iloc[0]
    explain.save(explain.from_run(run, name), tmp_path / "case.json")
    content = json.loads((tmp_path / "case.json").read_text())
    row = content["pieces"][0]
    for wrong in (
        row,
        [1],
        [{**row, "label": "maybe"}],
        [{**row, "case": "x/1/0000"}],
        [{"case": name}],
        [row, row],
        [{**row, "touching": None}],
        [{**row, "gap": "far"}],
    ):
        (tmp_path / "wrong.json").write_text(json.dumps({**content, "pieces": wrong}))
        with pytest.raises(ConfigError, match="pieces"):
            explain.from_file(tmp_path / "wrong.json")
