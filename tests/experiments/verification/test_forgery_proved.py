# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""A forger who also proves again what he changed: the package's cases are drawn anew, own ones with
--trust.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from experiments.cli import runner
from experiments.run.config import RunConfig
from experiments.run.folder import rows
from experiments.run.folder.store import Store
from experiments.truth import label
from experiments.verification import verify
from ofg import Body, Query

from .test_forgery import forged, run  # noqa: F401 (run is a fixture)

CLAIMS = (
    "label",
    "t_lo",
    "t_hi",
    "start",
    "end",
    "gap",
    "touching",
    "reason",
    "certificate",
    "size",
    "faces",
)
OWN = """
from experiments.cases.scenario import Draft, Scenario
from experiments.cases.shapes import box
from ofg import Pose

def generate(rng, level):
    at = Pose(position=(1.0 + level, *rng.uniform(-0.1, 0.1, 2)))
    return Draft(box(1, 1, 1), box(1, 1, 0.5), Pose(), at)

SCENARIO = Scenario("own", "overlap", "nothing", "gap", (0.1, -0.1), generate)
"""


def proved(frames: dict, i: int, query: Query) -> None:
    """Write the query into row i of the cases with its bodies and a true proof."""
    case = next(
        case
        for j, (case, _) in enumerate(rows.cases_of(frames["cases"], frames["bodies"]))
        if j == i
    )
    made = rows.case_row(
        type(case)(
            case.id, case.scenario, case.level, case.index, query, case.tags, case.precision
        ),
        label(query),
        int(frames["cases"].attempt[i]),
    )
    for column, value in made.items():
        frames["cases"][column] = [
            value if k == i else v for k, v in enumerate(frames["cases"][column])
        ]


def easier(body: Body) -> Body:
    """The same, a tenth larger."""
    return Body.convex(1.1 * body.vertices, body.name)


def replaced(frames, old_digest: bool) -> None:
    """The first convex body of a case, under its old digest or under its own, with the cases about
    it proved again.
    """
    cases, bodies = frames["cases"], frames["bodies"]
    at = bodies.index[bodies.kind == "convex"][0]
    digest = bodies.body[at]
    queries = {i: case.query for i, (case, _) in enumerate(rows.cases_of(cases, bodies))}
    other = easier(next(b for q in queries.values() for b in (q.a, q.b) if b.digest == digest))
    for i, q in queries.items():
        if digest in (q.a.digest, q.b.digest):
            a, b = (other if x.digest == digest else x for x in (q.a, q.b))
            proved(frames, i, Query(q.question, a, b, q.pose_a, q.pose_b, q.motion, q.motion_b))
    row = {**rows.body_row(other), **({"body": digest} if old_digest else {})}
    for column, value in row.items():
        bodies[column] = [value if k == at else v for k, v in enumerate(bodies[column])]
    if old_digest:
        for side in ("body_a", "body_b"):
            cases[side] = cases[side].replace(other.digest, digest)


def forged_both(run, folder, change) -> Store:  # noqa: F811
    store = forged(run, folder)
    frames = {name: store.read(f"{name}.parquet") for name in ("cases", "bodies")}
    change(frames)
    for name, frame in frames.items():
        store.write(frame, f"{name}.parquet")
    return forged(folder, folder.with_name(f"{folder.name}-hashed"))


@pytest.mark.parametrize("old_digest", [True, False])
def test_a_body_replaced_with_its_cases_proved_again_is_found(run, tmp_path, old_digest):  # noqa: F811
    found = verify(forged_both(run, tmp_path / "f", lambda f: replaced(f, old_digest)), workers=1)
    assert any("not what the scenario draws" in words for words in found.refused), str(found)
    assert not any("is refused" in words for words in found.refused), (
        "its proofs hold: only the drawing finds it"
    )


@pytest.fixture(scope="module")
def own(tmp_path_factory) -> Path:
    """A run of a scenario of a reader's own."""
    folder = tmp_path_factory.mktemp("own")
    (folder / "own.py").write_text(OWN)
    config = RunConfig(
        seed=3,
        methods=["ofg k=4"],
        timing={"cases": 0},
        scenario_files=[str(folder / "own.py")],
        scenarios=[{"name": "own", "cases": 2}],
    )
    from experiments.run.config import load_files

    load_files(config)
    runner.run(config, folder / "run", 1)
    return folder / "run"


def bench(*words) -> subprocess.CompletedProcess:
    """In a process of its own, which has not loaded the scenario's file."""
    return subprocess.run(
        [sys.executable, "-m", "experiments.cli", *map(str, words)], capture_output=True, text=True
    )


def test_own_cases_are_proved_and_with_trust_drawn_again(own):
    said = bench("verify", own, "--workers", 1)
    assert (
        said.returncode == 0
        and "4 labels verified" in said.stdout
        and "add --trust" in " ".join(said.stdout.split())
    ), said
    said = bench("verify", own, "--trust", "--ask", "all", "--workers", 1)
    assert (
        said.returncode == 0 and "4 labels verified" in said.stdout and "--trust" not in said.stdout
    ), said


def test_an_own_case_moved_and_proved_again_is_found_with_trust_alone(own, tmp_path):
    def moved(frames):
        case, _ = next(iter(rows.cases_of(frames["cases"], frames["bodies"])))
        q = case.query
        pose = type(q.pose_b)(q.pose_b.quaternion, q.pose_b.position + np.array([0.01, 0, 0]))
        proved(frames, 0, Query(q.question, q.a, q.b, q.pose_a, pose))

    store = forged_both(own, tmp_path / "f", moved)
    assert bench("verify", store.folder, "--workers", 1).returncode == 0
    said = bench("verify", store.folder, "--trust", "--workers", 1)
    assert said.returncode == 1 and "not what the scenario draws" in " ".join(
        said.stdout.split()
    ), said


def test_an_open_mesh_in_an_own_case_is_refused(own, tmp_path):
    """A cube without its top was read back, and a body inside it certified clear."""

    def opened(frames):
        bodies = frames["bodies"]
        cube = rows.body_of(next(bodies.itertuples()))
        row = rows.body_row(Body.unchecked("mesh", cube.vertices, cube.faces[2:], (), cube.name))
        for side in ("body_a", "body_b"):
            frames["cases"][side] = frames["cases"][side].replace(cube.digest, row["body"])
        frames["bodies"] = pd.concat([pd.DataFrame([row]), bodies.iloc[1:]], ignore_index=True)

    store = forged_both(own, tmp_path / "f", opened)
    said = bench("verify", store.folder, "--workers", 1)
    assert said.returncode == 1 and "is open" in " ".join(said.stdout.split()), said


def test_a_case_drawn_at_a_later_attempt_is_accepted(tmp_path):
    """Its scenario rejects the first draw, which verify draws and labels again."""
    config = RunConfig(
        seed=3,
        methods=["ofg k=4"],
        timing={"cases": 0},
        scenarios=[{"name": "spin_clear", "cases": 2, "levels": [-1.0]}],
    )
    runner.run(config, tmp_path / "run", 1)
    store = Store(tmp_path / "run")
    assert max(store.read("cases.parquet").attempt) > 0
    assert verify(store, workers=1).ok
    for attempt in (0, 1, 2):
        forged_ = forged(
            tmp_path / "run", tmp_path / f"f{attempt}", lambda t: t.assign(attempt=attempt)
        )
        assert not verify(forged_, workers=1).ok


def test_the_exit_code_says_whether_anything_is_refused(run, tmp_path):  # noqa: F811
    assert bench("verify", run, "--workers", 1).returncode == 0
    store = forged(run, tmp_path / "f", lambda t: t.iloc[1:])
    said = bench("verify", store.folder, "--workers", 1)
    assert said.returncode == 1 and "refused" in said.stdout
    assert bench("verify", store.folder, "--ask", "some").returncode == 2
