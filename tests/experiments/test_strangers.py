"""A stranger's files are data: nothing crashes on them, runs them, or writes outside their folder."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from experiments import runner
from experiments.config import RunConfig

from tests.experiments import strangers

ROOT = Path(__file__).parents[2]
MINE = '''
import ofg
from baselines.contract import Method, Verdict
class Mine(Method):
    name, engine, imports, configuration, guarantee = "mine", "ofg", "ofg", "default", "none"
    questions, bodies, solid, margin = frozenset(ofg.QUESTIONS), frozenset(["convex", "mesh", "union"]), True, 0.25
    def prepare(self, query):
        return lambda: Verdict(False)
METHODS = [Mine]
'''


@pytest.fixture(scope="module")
def run(tmp_path_factory) -> Path:
    """A small run with a method of its own, whose file has been exchanged for one that leaves a mark."""
    folder = tmp_path_factory.mktemp("right")
    (folder / "mine.py").write_text(MINE)
    config = RunConfig(seed=3, methods=["ofg k=8", "mine"], method_files=[str(folder / "mine.py")], timing={"cases": 0},
                       tables=[{"name": "by-level", "title": "@@SCRIPT@@ [/red]", "value": "wrong"}],
                       scenarios=[{"name": "feature_gap", "cases": 2, "levels": [1e-2]}, {"name": "hooked_ls", "cases": 1},
                                  {"name": "thin_wall", "cases": 2, "levels": [10.0]}])
    runner.run(config, folder / "run", workers=1)
    (folder / "mine.py").write_text(f"open({str(folder / 'RAN')!r}, 'w')\n{MINE}")
    return folder / "run"


def said(jobs, folder: Path) -> list[dict]:
    """What came of each job, in a process of their own. It fails if that crashes."""
    folder.mkdir(exist_ok=True)
    (folder / "jobs.json").write_text(json.dumps([list(map(str, job)) for job in jobs]))
    done = subprocess.run([sys.executable, ROOT / "tests/experiments/strangers_batch.py", folder / "jobs.json", folder / "results"], cwd=folder,
                          capture_output=True, text=True, env={"PYTHONPATH": str(ROOT), "PATH": "/usr/bin:/bin", "COLUMNS": "160"})
    found = [json.loads(line) for line in (folder / "results").read_text().splitlines()]
    assert done.returncode == 0, f"{done.returncode} at {jobs[len(found)] if len(found) < len(jobs) else ''}\n{done.stderr[-3000:]}"
    for result in found:
        assert not result["trace"], f"{result['words']}\n{result['trace']}"
        assert result["code"] in (0, 1, 2) and "Traceback" not in result["err"], result
    return found


def refused(results) -> None:
    """Each with a paragraph that says why, and code 2."""
    for result in results:
        assert result["code"] == 2 and result["err"].strip(), result
        assert "\n\n" not in result["err"].strip() and len(result["err"]) < 3000, result


def test_malformed_meshes(tmp_path):
    paths = strangers.meshes(tmp_path)
    assert len(paths) >= strangers.LEAST["mesh"]
    found = said([("mesh", path) for path in paths], tmp_path / "said")
    fine = [Path(r["words"][1]).name for r in found if r["code"] == 0]
    refused(r for r in found if r["code"])
    assert len(fine) <= 12, fine  # a reader may take an unused vertex or a count for what was meant


def test_malformed_configurations(tmp_path):
    paths = strangers.configurations(tmp_path)
    assert len(paths) >= strangers.LEAST["configuration"]
    refused(said([("run", path, "--out", tmp_path / "out", "--workers", 1) for path in paths], tmp_path / "said"))
    assert not (tmp_path / "out").exists()


def test_malformed_cases(tmp_path):
    paths = strangers.cases(tmp_path)
    assert len(paths) >= strangers.LEAST["case"]
    found = said([("explain", "--file", path, "--out", tmp_path / "page.html") for path in paths], tmp_path / "said")
    for result in found:
        assert result["code"] in (0, 2) and (result["code"] == 0 or result["err"].strip()), result
        assert ": certified" not in result["out"], result


def test_malformed_runs(run, tmp_path):
    """`verify`, `tables`, `report`, `figures`, `explain`, `compare` and `findings` on runs with one file changed."""
    folders = strangers.runs(tmp_path / "runs", run)
    assert len(folders) >= strangers.LEAST["run"]
    outside = tmp_path / "said"
    before = sorted(p for p in tmp_path.rglob("*") if tmp_path / "runs" not in p.parents)
    for_all = [("verify", f) for f in folders] + [("tables", f) for f in folders] + [("explain", "thin_wall/10/0000", "--run", f, "--out", f / "page.html") for f in folders]
    some = [(command, f) for f in folders[::4] for command in ("report", "figures")]
    both = [("compare", run, f) for f in folders[::3]] + [("findings", tmp_path / "runs")]
    said([*for_all, *some, *both], outside)
    after = sorted(p for p in tmp_path.rglob("*") if tmp_path / "runs" not in p.parents and outside not in (p, *p.parents))
    assert after == before
    assert not (run.parent / "RAN").exists()
