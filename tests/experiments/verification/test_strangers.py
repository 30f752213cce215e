# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""A stranger's files are data: nothing crashes on them, runs them, or writes outside their
folder.
"""

import json
import shutil
import subprocess
import sys
from pathlib import Path

import pandas as pd
import pytest

from experiments.cli import runner
from experiments.run.config import RunConfig
from experiments.run.folder import rows
from ofg import Body
from tests.experiments.verification import strange_meshes, strangers

ROOT = Path(__file__).parents[3]
MINE = """
import ofg
from baselines.contract import Method, Tolerance, Verdict
class Mine(Method):
    name, engine, imports, configuration, guarantee = "mine", "ofg", "ofg", "default", "none"
    questions, bodies = frozenset(ofg.QUESTIONS), frozenset(["convex", "mesh", "union"])
    solid, tolerance = True, Tolerance(0.25)
    def prepare(self, query):
        return lambda: Verdict(False)
METHODS = [Mine]
"""


@pytest.fixture(scope="module")
def run(tmp_path_factory) -> Path:
    """A small run with a method of its own, whose file has been exchanged for one that leaves a
    mark.
    """
    folder = tmp_path_factory.mktemp("right")
    (folder / "mine.py").write_text(MINE)
    config = RunConfig(
        seed=3,
        methods=["ofg k=8", "mine"],
        method_files=[str(folder / "mine.py")],
        timing={"cases": 0},
        tables=[{"name": "by-level", "title": "@@SCRIPT@@ [/red]", "value": "wrong"}],
        scenarios=[
            {"name": "feature_gap", "cases": 2, "levels": [1e-2]},
            {"name": "hooked_ls", "cases": 1},
            {"name": "thin_wall", "cases": 2, "levels": [10.0]},
        ],
    )
    runner.run(config, folder / "run", workers=1)
    (folder / "mine.py").write_text(f"open({str(folder / 'RAN')!r}, 'w')\n{MINE}")
    return folder / "run"


def said(jobs, folder: Path) -> list[dict]:
    """What came of each job, in a process of their own. It fails if that crashes."""
    folder.mkdir(exist_ok=True)
    (folder / "jobs.json").write_text(json.dumps([list(map(str, job)) for job in jobs]))
    done = subprocess.run(
        [
            sys.executable,
            ROOT / "tests/experiments/verification/strangers_batch.py",
            folder / "jobs.json",
            folder / "results",
        ],
        cwd=folder,
        capture_output=True,
        text=True,
        env={"PYTHONPATH": str(ROOT), "PATH": "/usr/bin:/bin", "COLUMNS": "160"},
    )
    found = [json.loads(line) for line in (folder / "results").read_text().splitlines()]
    assert done.returncode == 0, (
        f"{done.returncode} at"
        f" {jobs[len(found)] if len(found) < len(jobs) else ''}\n{done.stderr[-3000:]}"
    )
    for result in found:
        assert not result["trace"], f"{result['words']}\n{result['trace']}"
        assert result["code"] in (0, 1, 2) and "Traceback" not in result["err"], result
        # the net under the command line
        assert "are inconsistent" not in result["err"], result
    return found


def refused(results) -> None:
    """Each with a paragraph that says why, and code 2."""
    for result in results:
        assert result["code"] == 2 and result["err"].strip(), result
        assert "\n\n" not in result["err"].strip() and len(result["err"]) < 3000, result


def test_malformed_meshes(tmp_path):
    paths = strange_meshes.meshes(tmp_path)
    assert len(paths) >= strangers.LEAST["mesh"]
    found = said([("mesh", path) for path in paths], tmp_path / "said")
    fine = [Path(r["words"][1]).name for r in found if r["code"] == 0]
    refused(r for r in found if r["code"])
    assert len(fine) <= 12, fine  # a reader may take an unused vertex or a count for what was meant


def test_malformed_configurations(tmp_path):
    paths = strangers.configurations(tmp_path)
    assert len(paths) >= strangers.LEAST["configuration"]
    refused(
        said(
            [("run", path, "--out", tmp_path / "out", "--workers", 1) for path in paths],
            tmp_path / "said",
        )
    )
    assert not (tmp_path / "out").exists()


def test_malformed_cases(tmp_path):
    paths = strangers.cases(tmp_path)
    assert len(paths) >= strangers.LEAST["case"]
    found = said(
        [("explain", "--file", path, "--out", tmp_path / "page.html") for path in paths],
        tmp_path / "said",
    )
    for result in found:
        assert result["code"] in (0, 2) and (result["code"] == 0 or result["err"].strip()), result
        assert ": certified" not in result["out"], result


@pytest.mark.timeout(900)  # hundreds of commands; each verify decomposes and proves pieces too
def test_malformed_runs(run, tmp_path):
    """`verify`, `tables`, `report`, `figures`, `explain`, `compare` and `findings` on runs with one
    file changed.
    """
    folders = strangers.runs(tmp_path / "runs", run)
    assert len(folders) >= strangers.LEAST["run"]
    outside = tmp_path / "said"
    before = sorted(p for p in tmp_path.rglob("*") if tmp_path / "runs" not in p.parents)
    for_all = (
        [("verify", f) for f in folders]
        + [("tables", f) for f in folders]
        + [("explain", "thin_wall/10/0000", "--run", f, "--out", f / "page.html") for f in folders]
    )
    some = [(command, f) for f in folders[::4] for command in ("report", "figures")]
    both = [("compare", run, f) for f in folders[::3]] + [("findings", tmp_path / "runs")]
    said([*for_all, *some, *both], outside)
    after = sorted(
        p
        for p in tmp_path.rglob("*")
        if tmp_path / "runs" not in p.parents and outside not in (p, *p.parents)
    )
    assert after == before
    assert not (run.parent / "RAN").exists()


def bench(folder, *words):
    (result,) = said([words], folder)
    return result


def copied(run: Path, to: Path) -> Path:
    return Path(shutil.copytree(run, to))


def test_a_run_is_read_without_its_code_and_with_what_it_declared(run, tmp_path):
    """`tables` ran what config.json names; without that, what the method declares is not to be
    lost.
    """
    here = copied(run, tmp_path / "run")
    result = bench(tmp_path / "a", "tables", here)
    assert (
        result["code"] == 0
        and "they are not run" in result["err"]
        and not (run.parent / "RAN").exists()
    )
    methods = pd.read_csv(here / "tables/methods.csv").set_index("method")
    assert methods.tolerance["mine"] == "0.25" and methods.guarantee["mine"] == "none"
    assert (here / "tables/by-level.csv").read_bytes() == (run / "tables/by-level.csv").read_bytes()


def test_a_run_that_recorded_no_declaration_says_so(run, tmp_path):
    here = copied(run, tmp_path / "run")
    facts = json.loads((here / "manifest.json").read_text())
    del facts["declared"]
    (here / "manifest.json").write_text(json.dumps(facts))
    for command in ("tables", "report", "figures", "verify"):
        result = bench(tmp_path / command, command, here)
        assert result["code"] == 0 and not (run.parent / "RAN").exists(), result
        assert (
            command == "verify"
            or "Method 'mine' is not known here; its declaration is unknown" in result["err"]
        )


def test_trust_runs_what_the_run_names(run, tmp_path):
    here = copied(run, tmp_path / "run")
    (tmp_path / "mine.py").write_text(f"open({str(tmp_path / 'RAN')!r}, 'w')\n{MINE}")
    config = json.loads((here / "config.json").read_text())
    (here / "config.json").write_text(
        json.dumps({**config, "method_files": [str(tmp_path / "mine.py")]})
    )
    assert bench(tmp_path / "a", "tables", here)["code"] == 0 and not (tmp_path / "RAN").exists()
    assert (
        bench(tmp_path / "b", "tables", here, "--trust")["code"] == 0
        and (tmp_path / "RAN").exists()
    )


@pytest.mark.parametrize(
    "name, command",
    [
        ("tables", "tables"),
        ("figures", "figures"),
        ("tables/leaderboard.csv", "tables"),
        ("tables/by-level.md", "tables"),
        ("report.html", "report"),
        ("figures/by-level.svg", "figures"),
    ],
)
def test_links_in_a_run_are_not_followed(run, tmp_path, name, command):
    """`tables` removed files in the target of a link, and wrote there."""
    here, outside = copied(run, tmp_path / "run"), tmp_path / "outside"
    outside.mkdir()
    for file in ("old.csv", "old.md", "leaderboard.csv"):
        (outside / file).write_text("mine")
    at, folder = here / name, "." not in name
    if at.is_dir():
        shutil.rmtree(at)
    at.unlink(missing_ok=True)
    at.parent.mkdir(exist_ok=True)
    at.symlink_to(outside if folder else outside / "old.csv")
    result = bench(tmp_path / "said", command, here)
    if name not in (
        "figures/by-level.svg",
        "figures",
        "tables/leaderboard.csv",
    ):  # some of these are not made of this run
        assert result["code"] == 2 and "symbolic link" in result["err"], result
    assert sorted(p.name for p in outside.iterdir()) == ["leaderboard.csv", "old.csv", "old.md"]
    assert all(p.read_text() == "mine" for p in outside.iterdir())


def test_a_scene_may_not_lead_out_of_the_run(run, tmp_path):
    """A table was written to ../../x.csv."""
    here = copied(run, tmp_path / "in" / "run")
    config = json.loads((here / "config.json").read_text())
    (here / "config.json").write_text(json.dumps({**config, "stepping": {"runs": 1}}))
    row = {
        "scene": "../../x",
        "contestant": "a",
        "travel": 1.0,
        "runs": 1,
        "tunnelled": 1,
        "share": 1.0,
        "low": 0.1,
        "high": 1.0,
        "us_per_step": 1.0,
        "detail": "",
    }
    for scene, words in (
        ("../../x", "stepping.parquet"),
        ("a/b", "not a valid file name"),
        ("x" * 195, "not a valid file name"),
    ):
        pd.DataFrame([{**row, "scene": scene}]).to_parquet(here / "stepping.parquet")
        result = bench(tmp_path / "said", "tables", here)
        assert result["code"] == 2 and words in " ".join(result["err"].split()), result
    assert not list(tmp_path.rglob("*x.csv"))


def test_what_is_stated_is_not_said_to_be_certified(run, tmp_path):
    """`explain --file` said "certified clear" of a label without a certificate."""
    (tmp_path / "case.json").write_text(json.dumps(strangers.case()))
    result = bench(
        tmp_path / "a", "explain", "--file", tmp_path / "case.json", "--out", tmp_path / "p.html"
    )
    assert result["code"] == 0 and "stated, not certified" in result["out"], result
    assert "one case, not certified" in (tmp_path / "p.html").read_text()
    name = pd.read_parquet(run / "cases.parquet").case[0]
    result = bench(
        tmp_path / "b",
        "explain",
        name,
        "--run",
        run,
        "--save",
        tmp_path / "good.json",
        "--out",
        tmp_path / "q.html",
    )
    assert result["code"] == 0 and f"{name}: certified " in result["out"], result
    result = bench(
        tmp_path / "c", "explain", "--file", tmp_path / "good.json", "--out", tmp_path / "q.html"
    )
    assert result["code"] == 0 and f"{name}: certified " in result["out"], result


def test_marks_and_markup_in_a_title_are_words(run, tmp_path):
    """@@SCRIPT@@ in a title was expanded, and [/red] raised MarkupError."""
    here = copied(run, tmp_path / "run")
    config = json.loads((here / "config.json").read_text())
    (here / "config.json").write_text(json.dumps({**config, "title": "@@SCRIPT@@ [/red]"}))
    assert bench(tmp_path / "a", "report", here)["code"] == 0
    assert "<title>@@SCRIPT@@ [/red]: collision" in (here / "report.html").read_text()
    result = bench(tmp_path / "b", "tables", here)
    assert result["code"] == 0 and "@@SCRIPT@@ [/red]" in result["out"]


def test_an_open_mesh_is_refused_when_it_is_read_back(run, tmp_path):
    """A cube without its top was read back, and a body inside it certified clear."""
    here = copied(run, tmp_path / "run")
    bodies, cases = (pd.read_parquet(here / f"{name}.parquet") for name in ("bodies", "cases"))
    open_ = Body.unchecked("mesh", strange_meshes.CUBE, strange_meshes.FACES[2:], (), "open")
    row = rows.body_row(open_)
    pd.concat([bodies, pd.DataFrame([row])]).to_parquet(here / "bodies.parquet")
    cases.assign(body_a=open_.digest).to_parquet(here / "cases.parquet")
    result = bench(tmp_path / "said", "verify", here)
    assert result["code"] == 1 and "0 labels verified" in " ".join(result["out"].split()), result
    result = bench(tmp_path / "again", "report", here)
    words = " ".join(result["err"].split())
    assert result["code"] == 2 and "bodies.parquet (" in words and "the mesh is open" in words, (
        result
    )
