# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Bullet's convex casts: known facts of each, and what is said where they are not built."""

import math
from dataclasses import replace

import pytest

from baselines import native, registry
from baselines.contract import MissingEngine
from baselines.easy_queries import bar, body, sweep
from baselines.native import library
from ofg import Motion, Pose, Query

CASTS = ("subsimplex", "gjk", "continuous")
built = pytest.mark.skipif(
    bool(library.missing("libbullet")), reason="built by: ofg-bench native --build"
)


def verdict(name: str, query: Query):
    (method,) = registry.make(name)
    return method.ready(query)()


@built
@pytest.mark.parametrize("cast", CASTS)
@pytest.mark.parametrize("kind", ["convex", "union"])
def test_the_best_effort_meets_a_cube_at_the_exact_time(cast, kind):
    query = sweep("translation", kind, (-5, 0.3, 0.1), (10, 0, 0))
    assert verdict(f"bullet-{cast}-cast-exact", query).time == pytest.approx(0.3, abs=1e-6)


@built
@pytest.mark.parametrize("cast", CASTS)
def test_hulls_as_bullet_makes_them_meet_early_by_two_margins(cast):
    query = sweep("translation", "convex", (-5, 0.3, 0.1), (10, 0, 0))
    found = verdict(f"bullet-{cast}-cast", query)
    assert 0.3 - found.time == pytest.approx(0.008, abs=1.1e-4)


@built
@pytest.mark.parametrize("cast", CASTS)
def test_both_bodies_move(cast):
    alone = sweep("translation", "convex", (-5, 0.3, 0.1), (4, 0, 0))
    query = replace(alone, motion_b=Motion((-6, 0, 0)))
    assert verdict(f"bullet-{cast}-cast-exact", query).time == pytest.approx(0.3, abs=1e-6)


@built
def test_bullet_turns_no_further_than_45_degrees_in_one_cast():
    """btTransformUtil::integrateTransform limits the turn, so legs are needed: a known fact."""
    at, motion = Pose(position=(0, 2, 0)), Motion((0, 0, 0.01), (0, 0, 1), math.radians(90))
    query = Query("motion", bar("convex"), body("convex", 0.4), Pose(), at, motion)
    (exact,) = registry.make("bullet-continuous-cast-exact")
    found = exact.ready(query)()
    exact.legs = lambda query: 1
    assert found.hit and not (exact.ready(query)().hit and exact.ready(query)().time == found.time)


@built
def test_a_cast_that_does_not_converge_is_halved():
    """A bar creeps up to a cube: the 64 iterations of one cast do not do, and Bullet says clear."""
    at, motion = Pose(position=(0, 0.804, 0)), Motion((0, 0, 0), (0, 0, 1), 0.02)
    query = Query("motion", bar("convex"), body("convex", 0.4), Pose(), at, motion)
    (exact,) = registry.make("bullet-continuous-cast-exact")
    halved = exact.ready(query)()
    exact.halvings = 0
    assert halved.hit and not exact.ready(query)().hit


def test_what_is_not_built_says_how_to_build_it(monkeypatch, tmp_path):
    monkeypatch.setattr(library, "FOLDER", tmp_path)
    cls = registry.methods()["bullet-continuous-cast"]
    assert "native --build" in registry.available(cls) and registry.version(cls) == "absent"
    with pytest.raises(MissingEngine, match="libbullet-dev"):
        library.load.__wrapped__("libbullet")


def test_a_plugin_that_does_not_open_says_so(monkeypatch, tmp_path):
    monkeypatch.setattr(library, "FOLDER", tmp_path)
    (tmp_path / "plugins").mkdir()
    (tmp_path / "plugins" / "bullet_casts.so").write_text("no library")
    with pytest.raises(MissingEngine, match="does not open"):
        library.load.__wrapped__("libbullet")


@built
def test_the_version_names_bullet_and_the_plugin():
    number, digest = library.version("libbullet").split("+")
    assert float(number) > 2 and len(digest) == 8


@built
@pytest.mark.parametrize("place", [(-5, 0.3, 0.1), (-4, 2.5, 0), (0.9, 0.7, 0.5)])
@pytest.mark.parametrize("question, angle", [("translation", 0), ("motion", 2.5)])
def test_the_native_lane_says_the_same(place, question, angle):
    straight = sweep("translation", "convex", place, (8, 0, 0))
    query = replace(straight, question=question, motion=Motion((8, 0, 0), (0, 1, 2), angle))
    taken = native.run([query], rounds=1, warmup=0)
    rows = taken.answers.join(taken.contestants, on="id")
    rows = rows[rows.engine.str.startswith("bullet") & (rows.isa == "generic")].set_index("engine")
    assert len(rows) == (6 if question == "translation" else 2)
    for name, said in rows.iterrows():
        expected = verdict(name, query)
        assert bool(said.hit) == expected.hit
        assert said.time == pytest.approx(expected.time, abs=1e-6, nan_ok=True)
