# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""What every family must keep: the same case for the same arguments, float32 inputs, bodies that
are what they say.
"""

from pathlib import Path

import numpy as np
import pytest

import experiments.cases.families.feature_gap
from experiments.cases.families import get, load_file, scenarios
from experiments.cases.label import Truth
from experiments.cases.scenario import Draft, Scenario, ScenarioError, snap
from experiments.cases.shapes import box
from ofg import Body, Pose

FAMILIES = scenarios()
EVERY_LEVEL = [
    pytest.param(s, level, id=f"{s.name}/{level:g}")
    for s in FAMILIES.values()
    for level in s.levels
]


def parts(query):
    """Every number of a query, to compare two."""
    arrays = [
        query.pose_a.quaternion,
        query.pose_a.position,
        query.pose_b.quaternion,
        query.pose_b.position,
    ]
    for m in (query.motion, query.motion_b):
        arrays += [m.displacement, m.axis, [m.angle], m.about]
    return query.question, query.a.digest, query.b.digest, np.concatenate(arrays).tolist()


@pytest.mark.parametrize("scenario, level", EVERY_LEVEL)
def test_case_is_float32_and_its_bodies_are_sound(scenario, level):
    for index in range(3):
        case = scenario.case(7, level, index)
        numbers = np.array(parts(case.query)[3])
        assert np.array_equal(numbers, snap(numbers))
        for body in (case.query.a, case.query.b):
            assert np.array_equal(body.vertices, snap(body.vertices))
            for piece in body.pieces or (body,):
                mesh = piece.to_trimesh()
                assert mesh.is_watertight and mesh.is_winding_consistent and mesh.volume > 0


@pytest.mark.parametrize("scenario", FAMILIES.values(), ids=FAMILIES)
def test_case_depends_on_its_arguments_alone(scenario):
    levels = list(scenario.levels)
    wanted = [
        (3, level, index, attempt)
        for level in (levels[0], levels[-1])
        for index in range(2)
        for attempt in range(2)
    ]
    first = [parts(scenario.case(*w).query) for w in wanted]
    again = [parts(scenario.case(*w).query) for w in reversed(wanted)][::-1]
    assert first == again
    assert len({str(p) for p in first}) == len(first), (
        "seed, level, index and attempt must each make a difference"
    )
    assert parts(scenario.case(4, levels[0], 0).query) != first[0]


@pytest.mark.parametrize("scenario", FAMILIES.values(), ids=FAMILIES)
def test_scenario_says_what_it_is(scenario):
    assert scenario.exposes and scenario.axis and "\n" not in scenario.exposes
    assert len({f"{v:g}" for v in scenario.levels}) == len(scenario.levels), (
        "two levels would share their cases' ids"
    )


def test_ids_are_unique_over_all_families():
    ids = [
        s.case(0, level, i).id
        for s in FAMILIES.values()
        for level in s.levels[:2]
        for i in range(2)
    ]
    assert len(set(ids)) == len(ids)


@pytest.mark.parametrize(
    "word, truth",
    [
        ("touching", Truth("clear", touching=True)),
        ("clear", Truth("clear", touching=True)),
        ("hit", Truth("hit")),
        ("start-overlap", Truth("hit", start="hit")),
        ("uncertain", Truth("uncertain")),
    ],
)
def test_what_is_drawn_again(word, truth):
    assert Scenario("mine", "overlap", "e", "a", (1.0,), None, (word,)).useless(truth)
    assert not Scenario("mine", "overlap", "e", "a", (1.0,), None, (word,)).useless(
        Truth("clear" if word != "clear" else "hit")
    )
    with pytest.raises(ValueError, match="redraw_if accepts"):
        Scenario("mine", "overlap", "e", "a", (1.0,), None, ("touch",))


def test_unknown_level_and_name_say_what_there_is():
    with pytest.raises(ValueError, match="has no level 0.123"):
        FAMILIES["thin_wall"].case(0, 0.123, 0)
    with pytest.raises(ValueError, match="did you mean thin_wall"):
        get("thinwall")


def test_load_file_reads_a_scenario_of_ones_own(tmp_path):
    path = tmp_path / "mine.py"
    path.write_text(
        "from experiments.cases.scenario import Draft, Scenario\nfrom experiments.cases.shapes"
        " import box\nfrom ofg import Pose\ndef generate(rng, level):\n    return Draft(box(),"
        " box(), Pose(), Pose(position=[1 + level, 0, 0]))\nSCENARIO = Scenario('mine', 'overlap',"
        " 'nothing', 'gap', (0.5, -0.5), generate)\n"
    )
    (mine,) = load_file(path)
    assert isinstance(mine, Scenario) and mine.case(0, 0.5, 0).query.pose_b.position[0] == 1.5


def test_a_family_copied_elsewhere_and_renamed_is_a_scenario(tmp_path):
    path = tmp_path / "my_gap.py"
    path.write_text(
        Path(experiments.cases.families.feature_gap.__file__)
        .read_text()
        .replace('"feature_gap"', '"my_gap"')
    )
    (mine,) = load_file(path)
    assert mine.case(0, 0.1, 0).query.question == "overlap" and get("my_gap") is mine
    scenarios().pop("my_gap")


@pytest.mark.parametrize("text", ["", "SCENARIO = 3", "SCENARIOS = [1]"])
def test_load_file_refuses_a_file_without_one(tmp_path, text):
    path = tmp_path / "empty.py"
    path.write_text(text)
    with pytest.raises(ValueError, match="defines no scenario"):
        load_file(path)
    with pytest.raises(ValueError, match="does not exist"):
        load_file(tmp_path / "missing.py")


@pytest.mark.parametrize(
    "draw, said",
    [
        (lambda rng, level: None, "NoneType, not a Draft"),
        (
            lambda rng, level: Draft(Body.convex(np.full((4, 3), np.nan)), None, Pose(), Pose()),
            "finite",
        ),
        (
            lambda rng, level: Draft(box(1, 1, 1), box(1, 1, 1), Pose(position=(0, 0)), Pose()),
            "position must have shape",
        ),
    ],
)
def test_what_draws_no_case_is_named(draw, said):
    """A reader's mistake in `generate` once ended in the words of a body that nobody could
    place.
    """
    mistaken = Scenario("mine", "overlap", "mistakes", "none", (3.0,), draw)
    with pytest.raises(
        ScenarioError, match=rf"'mine' drew no valid case at level 3, index 7, seed 5: .*{said}"
    ):
        mistaken.case(5, 3.0, 7)
