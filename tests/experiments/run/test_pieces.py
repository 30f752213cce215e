# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Methods on pieces are judged by the pieces; the pieces' own error has a row; a forged truth is
refused.
"""

from __future__ import annotations

import json

import numpy as np
import pandas as pd
import pytest

import ofg
from experiments.analysis import compare as comparing
from experiments.analysis import outcome, tables
from experiments.cli import runner
from experiments.run import piece_truth
from experiments.run.config import RunConfig
from experiments.run.folder import rows
from experiments.run.folder.record import RecordError
from experiments.run.folder.store import Store
from experiments.truth import check_many, label
from experiments.verification import verify
from ofg import Body
from tests.experiments.verification.test_forgery import forged, put

SCENARIOS = [
    {"name": "hooked_ls", "cases": 3, "levels": [0.001, -0.001]},
    {"name": "linked_tori", "cases": 8, "levels": [1e-5, -1e-5]},
]
CONFIG = RunConfig(
    seed=2004,
    timing={"cases": 0},
    scenarios=SCENARIOS,
    methods=["ofg k=8", "ofg k=8 repairs=all", "bullet-coacd", "mujoco-coacd"],
)
ON_PIECES = {"ofg k=8", "bullet-coacd", "mujoco-coacd"}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    made = tmp_path_factory.mktemp("pieces") / "run"
    runner.run(CONFIG, made, 2)
    return made


@pytest.fixture(scope="module")
def found(folder):
    return outcome.outcomes(Store(folder))


def test_each_case_about_a_mesh_is_certified_of_its_pieces_too(folder):
    store = Store(folder)
    cases, bodies, pieces = (
        store.read(f"{name}.parquet") for name in ("cases", "bodies", "pieces")
    )
    kind = bodies.set_index("body").kind
    about = cases[(cases.body_a.map(kind) == "mesh") | (cases.body_b.map(kind) == "mesh")]
    assert 0 < len(about) < len(cases) and pieces.case.tolist() == about.case.tolist()
    given = {case.id: case.query for case, _ in rows.cases_of(about, bodies)}
    made = piece_truth.as_cases(about, pieces)
    proved = list(rows.cases_of(made, store.read("pieces-bodies.parquet")))
    assert all(v.ok for v in check_many([(case.query, truth) for case, truth in proved]))
    for case, _ in proved:
        for side in ("a", "b"):
            body = getattr(given[case.id], side)
            assert getattr(case.query, side).digest == ofg.decompose(body).digest


def test_engines_are_right_about_the_pieces_they_were_given(found):
    """CoACD's error was booked to them: both answered hit at four linked tori that are clear."""
    engines = found[found.method.isin(["bullet-coacd", "mujoco-coacd"])]
    assert not engines.outcome.isin(["miss", "false alarm"]).any()


def test_the_truth_is_the_pieces_where_a_method_decomposes_and_the_case_has_a_mesh(folder, found):
    pieces = Store(folder).read("pieces.parquet").set_index("case")
    on = found.truth == "pieces"
    assert (on == (found.method.isin(ON_PIECES) & found.case.isin(pieces.index))).all()
    assert (found[on].label.to_numpy() == pieces.label[found[on].case].to_numpy()).all()
    cases = Store(folder).read("cases.parquet").set_index("case")
    assert (found[~on].label.to_numpy() == cases.label[found[~on].case].to_numpy()).all()


def test_a_run_without_pieces_is_judged_by_its_meshes(folder):
    store = Store(folder)
    said, cases = store.read("observations.parquet"), store.read("cases.parquet")
    before = outcome.judge(said, cases)
    assert set(before.truth) == {"mesh"}
    after = outcome.judge(said, cases, store.read("pieces.parquet"))
    same = after.truth == "mesh"
    columns = ["label", "outcome", "can_tunnel", "tunnelled", "relative_gap"]
    pd.testing.assert_frame_equal(before[same][columns], after[same][columns])
    assert (before.outcome != after.outcome).any()


def test_the_pieces_own_error_is_counted_by_the_mesh_and_is_no_method(folder, found):
    store = Store(folder)
    cases = store.read("cases.parquet").set_index("case").label
    pieces = store.read("pieces.parquet").set_index("case").label
    mesh = cases[pieces.index]
    wanted = (
        int(((mesh == "hit") & (pieces == "clear")).sum()),
        int(((mesh == "clear") & (pieces == "hit")).sum()),
    )
    assert sum(wanted) > 0
    made = {table.name: table for table in tables.build(store)}
    own = made["accuracy-overlap"].numbers.set_index("method").loc[piece_truth.NAME]
    assert (own.misses, own.false_alarms) == wanted
    assert own.hits + own.clears == len(pieces)
    assert piece_truth.NAME not in set(found.method)
    assert piece_truth.NAME not in set(made["methods"].text.method)
    assert f"{piece_truth.NAME} is not an engine" in made["accuracy-overlap"].caption


def test_an_uncertain_truth_of_the_pieces_is_in_no_rate(folder):
    store = Store(folder)
    pieces = store.read("pieces.parquet")
    pieces.loc[:, "label"] = "uncertain"
    said, cases = store.read("observations.parquet"), store.read("cases.parquet")
    judged = outcome.judge(said, cases, pieces)
    assert set(judged[judged.truth == "pieces"].outcome) == {"no label"}
    assert piece_truth.own_error(cases, pieces).empty


def test_a_run_where_nothing_decomposes_has_no_such_files(tmp_path):
    config = CONFIG.model_copy(update={"methods": ("ofg k=8 repairs=all", "fcl-mesh")})
    runner.run(config, tmp_path / "run", 2)
    assert not any(Store(tmp_path / "run").has(name) for name in piece_truth.FILES)
    assert verify(Store(tmp_path / "run"), workers=1).ok


def test_an_untouched_run_is_accepted_and_lists_its_pieces(folder, tmp_path):
    store = forged(folder, tmp_path / "f")
    said = verify(store, workers=2)
    assert said.ok, str(said)
    assert said.pieces.total() == len(store.read("pieces.parquet"))
    assert set(piece_truth.FILES) <= store.facts["sha256"].keys()


def other(label_):
    return {"hit": "clear", "clear": "hit"}[label_]


def turned(frame):
    """Label, start and end of the first row are another's, as if its engine had been wrong."""
    for column in ("label", "start", "end"):
        frame.loc[0, column] = other(frame.loc[0, column])


def unsure(frame):
    frame.loc[0, ["label", "start", "end"]] = "uncertain"
    frame.loc[0, ["t_lo", "t_hi", "gap"]] = np.nan
    frame.loc[0, ["reason", "certificate"]] = ["?", "{}"]


FORGERIES = {
    "label": turned,
    "uncertain": unsure,
    "deleted": lambda t: t.iloc[1:],
    "doubled": lambda t: t.iloc[[0, *range(len(t))]],
    "order": lambda t: t.iloc[::-1],
    "gap": put("gap", lambda gap: 3 * gap),
    "touching": put("touching", lambda x: not x),
    "certificate": put("certificate", "{}"),
    "precision": put("precision", lambda p: {"float32": "float64"}.get(p, "float32")),
    "another body": put("body_a", "0" * 24),
}


@pytest.mark.parametrize("name", FORGERIES)
def test_a_forged_truth_of_the_pieces_is_refused(folder, tmp_path, name):
    """Every hash is recomputed."""
    assert not verify(forged(folder, tmp_path / "f", FORGERIES[name], "pieces"), workers=2).ok


@pytest.mark.parametrize(
    "change",
    [lambda t: t.iloc[1:], put("name", "other"), put("vertices", lambda v: 1.1 * np.array(v))],
)
def test_forged_bodies_of_the_pieces_are_refused(folder, tmp_path, change):
    assert not verify(forged(folder, tmp_path / "f", change, "pieces-bodies"), workers=2).ok


@pytest.mark.parametrize("name", piece_truth.FILES)
def test_one_file_without_the_other_is_refused(folder, tmp_path, name):
    store = forged(folder, tmp_path / "f")
    store.path(name).unlink()
    assert any(
        said.startswith(name)
        for said in verify(forged(store.folder, tmp_path / "g"), workers=2).refused
    )


def test_a_run_from_before_is_accepted_with_a_note(folder, tmp_path):
    store = forged(folder, tmp_path / "f")
    for name in piece_truth.FILES:
        store.path(name).unlink()
    said = verify(forged(store.folder, tmp_path / "g"), workers=2)
    assert said.ok and any("judged by the meshes" in note for note in said.notes)


def test_other_pieces_with_a_true_proof_are_refused(folder, tmp_path):
    """A forger grows the pieces of a case, and proves the truth of what he made of them."""
    store = forged(folder, tmp_path / "f")
    pieces, bodies = (store.read(name) for name in piece_truth.FILES)
    cases = piece_truth.as_cases(store.read("cases.parquet"), pieces.iloc[:1])
    ((case, _),) = rows.cases_of(cases, bodies)
    q = case.query
    grown = Body.union([Body.convex(1.2 * p.vertices) for p in q.a.pieces], q.a.name)
    truth = label(type(q)(q.question, grown, q.b, q.pose_a, q.pose_b))
    made = {"body_a": grown.digest, **rows.truth_row(truth)}
    pieces.loc[0, list(made)] = list(made.values())
    store.write(pieces, piece_truth.FILES[0])
    store.write(pd.concat([bodies, pd.DataFrame([rows.body_row(grown)])]), piece_truth.FILES[1])
    said = verify(forged(store.folder, tmp_path / "g"), workers=2).refused
    assert any("differs from that of the pieces" in words for words in said), said


def test_an_interrupted_run_goes_on_and_ends_the_same(folder, tmp_path, monkeypatch):
    """Stopped after the pieces were certified, and once more with a part of them lost."""

    def stop(*_):
        raise KeyboardInterrupt

    made = tmp_path / "run"
    with monkeypatch.context() as m, pytest.raises(KeyboardInterrupt):
        m.setattr(runner.answering, "ask", stop)
        runner.run(CONFIG, made, 2)
    parts = {kind: sorted(made.glob(f"parts/{kind}/*")) for kind in ("decompositions", "pieces")}
    assert all(parts.values())
    times = {path: path.stat().st_mtime_ns for path in parts["decompositions"]}
    parts["pieces"][0].write_bytes(b"half")
    (made / piece_truth.FILES[0]).write_bytes(b"")
    with monkeypatch.context() as m, pytest.raises(KeyboardInterrupt):
        m.setattr(runner.answering, "ask", stop)
        runner.run(CONFIG, made, 1)
    assert times == {path: path.stat().st_mtime_ns for path in parts["decompositions"]}
    runner.run(CONFIG, made, 1)
    for name in ("cases.parquet", "observations.parquet", *piece_truth.FILES):
        assert (made / name).read_bytes() == (folder / name).read_bytes(), name


def test_a_mesh_without_pieces_leaves_its_cases_uncertain(folder, tmp_path, monkeypatch):
    """Its methods are `unsupported` there, and the run goes on."""
    from experiments.run import decomposing

    monkeypatch.setattr(decomposing, "open_mesh", failing)
    store = Store(tmp_path / "run")
    for name in ("cases.parquet", "bodies.parquet"):
        store.write(Store(folder).read(name), name)
    decomposing.make(store, CONFIG, 1)
    pieces = store.read("pieces.parquet")
    assert set(pieces.label) == {"uncertain"}
    assert all(reason == "no convex pieces: too thin" for reason in pieces.reason)
    assert {json.loads(c) == {} for c in pieces.certificate} == {True}


def failing(_):
    return lambda mesh: (mesh, "too thin")


def test_a_run_and_its_reference_from_before_compare_as_identical(folder, tmp_path, capfd):
    """Judged by pieces in one and by meshes in the other, answers would seem to move."""
    before = forged(folder, tmp_path / "before")
    for name in piece_truth.FILES:
        before.path(name).unlink()
    assert comparing.compare(before, Store(folder)).identical
    assert "judged by the labels of the meshes" in " ".join(capfd.readouterr().err.split())


def test_a_reference_keeps_the_truth_of_the_pieces(folder, tmp_path):
    kept = Store(tmp_path / "reference")
    comparing.reference(Store(folder), kept)
    assert comparing.compare(kept, Store(folder)).identical
    pieces = kept.read("pieces.parquet")
    turned(pieces)
    kept.write(pieces, "pieces.parquet")
    assert set(comparing.compare(kept, Store(folder)).answers.method) == ON_PIECES


def test_pieces_that_lack_a_column_are_refused_in_a_sentence(folder, tmp_path):
    """Columns that older cases.parquet may lack were excused here too: KeyError."""
    for column in Store(folder).read("pieces.parquet").columns:
        store = Store(tmp_path / column)
        store.write(Store(folder).read("pieces.parquet").drop(columns=column), "pieces.parquet")
        with pytest.raises(RecordError, match=f"pieces.parquet.*lacks the column '{column}'"):
            piece_truth.read(store)
