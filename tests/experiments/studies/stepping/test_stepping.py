# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The stepping track: its scenes are fair, its count can go both ways, and known remedies show."""

import numpy as np
import pytest
from typer.testing import CliRunner

from baselines import registry
from baselines.contract import Method, Verdict
from experiments.studies.stepping import track
from experiments.studies.stepping.scene import SCENES, TRAVELS, turned
from experiments.studies.stepping.worlds import KinematicWorld, _body, _initial
from ofg import Pose, Query

CONTESTANTS = {c.name: c for c in track.CONTESTANTS}
BALL, BOX, ROD = SCENES


def tunnelled(name: str, scene, travel: float, runs: int = 6) -> int:
    (row,) = track.measure([CONTESTANTS[name]], [scene], [travel], runs)
    return row["tunnelled"]


@pytest.mark.parametrize("scene", SCENES, ids=lambda s: s.name)
def test_no_run_starts_in_touch(scene):
    rng = np.random.default_rng(0)
    (method,) = registry.make("fcl-convex")
    for travel in TRAVELS:
        for phase in (0.0, rng.uniform(), 1.0):
            position, turn, _, _ = _initial(
                scene, 1.0, scene.start(travel, phase), turned(rng, scene)
            )
            query = Query(
                "overlap",
                _body("box", scene.half),
                _body("box", scene.obstacle),
                Pose(turn, position),
                Pose(position=(scene.reach, 0, 0)),
            )
            assert not method.prepare(query)().hit


class Blind(Method):
    name, engine, imports, configuration = "blind", "numpy", "numpy", "article"
    questions, bodies, solid, guarantee = (
        frozenset({"translation", "motion"}),
        frozenset({"convex"}),
        True,
        "none",
    )
    answer = Verdict(False)

    def prepare(self, query):
        return lambda: self.answer


class Cautious(Blind):
    answer = Verdict(True, 0.0)


@pytest.mark.parametrize("scene", SCENES, ids=lambda s: s.name)
@pytest.mark.parametrize("method, past", [(Blind, True), (Cautious, False)])
def test_an_unhindered_body_gets_past_and_a_stopped_one_does_not(scene, method, past, monkeypatch):
    monkeypatch.setattr(registry, "make", lambda spec: [method()])
    contestant = track.Contestant("x", lambda *a: KinematicWorld(*a, method="x"), "")
    monkeypatch.setattr(track, "_dt", lambda c: 1.0)
    for travel in TRAVELS:
        assert track.run(contestant, scene, travel, np.random.default_rng(1)).tunnelled == past


@pytest.mark.parametrize("scene", SCENES, ids=lambda s: s.name)
@pytest.mark.parametrize("name", ["bullet", "bullet maximal", "mujoco"])
def test_engines_without_remedy_hold_slow_bodies_and_lose_fast_ones(name, scene):
    assert tunnelled(name, scene, 0.25) == 0
    assert tunnelled(name, scene, 100.0) > 0


@pytest.mark.parametrize(
    "name, scene",
    [
        ("bullet maximal ccd", BALL),
        ("bullet maximal ccd", BOX),
        ("mujoco speculative", BALL),
        ("ofg k=8 repairs=all", BALL),
        ("ofg k=8 repairs=all", BOX),
        ("ofg k=8 repairs=all", ROD),
    ],
)
def test_remedies_hold_fast_bodies(name, scene):
    assert tunnelled(name, scene, 100.0) == 0


def test_a_swept_sphere_is_ignored_on_multibodies():
    for travel in (10.0, 100.0):
        assert tunnelled("bullet ccd", BALL, travel) == tunnelled("bullet", BALL, travel) > 0


def test_the_same_seed_gives_the_same_count_and_the_interval_holds_the_share():
    rows = [
        next(track.measure([CONTESTANTS["bullet"]], [BOX], [20.0], 10, seed=3)) for _ in range(2)
    ]
    assert rows[0]["tunnelled"] == rows[1]["tunnelled"]
    assert all(
        0 <= r["low"] <= r["share"] <= r["high"] <= 1 and r["high"] - r["low"] > 0.2 for r in rows
    )


def test_the_command_writes_its_tables(tmp_path):
    import typer

    from experiments.studies.stepping.__main__ import main

    app = typer.Typer()
    app.command()(main)
    result = CliRunner().invoke(
        app, ["--runs", "1", "--only", "ofg k=8 repairs", "--scene", "ball", "--out", str(tmp_path)]
    )
    assert result.exit_code == 0, result.output
    assert (tmp_path / "stepping.csv").read_text().count("\n") == len(TRAVELS) + 1
    assert "ball at a wall" in (tmp_path / "stepping.md").read_text()
    assert CliRunner().invoke(app, ["--only", "nobody"]).exit_code == 2
