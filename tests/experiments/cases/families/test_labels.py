# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""What the truth says of the families: they hit what they aim at, sweeps start clear, and both
answers occur.
"""

import pytest

from experiments.cases.families import get, scenarios
from experiments.truth import label
from experiments.truth.audit.aim import survey
from ofg import Body, Query

SWEEPS = [s.name for s in scenarios().values() if s.redraw_if]
ONE_SIDED = {"deep": {"hit"}}  # bodies with nearly the same centre overlap
AIMED = (
    "feature_gap",
    "sliver",
    "scale",
    "tiny_huge",
    "far_from_origin",
    "parallel_faces",
    "hooked_ls",
    "linked_tori",
    "graze",
    "through_hole",
    "spin_clear",
    "face_count",
)


@pytest.mark.parametrize("name", AIMED)
def test_sign_of_the_gap_comes_out_as_aimed(name):
    scenario = get(name)
    for level in scenario.levels:
        for index in range(2):
            case = scenario.case(11, level, index)
            truth = label(case.query)
            if not scenario.useless(truth):
                assert truth.label == ("clear" if case.tags["aim"] > 0 else "hit"), (
                    case.id,
                    case.tags,
                    truth.reason,
                )


def test_end_hit_arrives_on_the_aimed_side_of_the_end():
    for level in get("end_hit").levels:
        truth = label(get("end_hit").case(11, level, 0).query)
        assert truth.label == ("hit" if level > 0 else "clear")
        if level > 0:
            slack = 1e-3 * level  # what moving the contact away from the origin may cost
            assert truth.t_lo - slack <= 1 - level <= truth.t_hi + slack


# A label of large_mesh takes a second and more.
@pytest.mark.parametrize("name", [name for name in scenarios() if name != "large_mesh"])
def test_both_answers_occur_and_few_cases_are_left_open(name):
    scenario = get(name)
    found = [
        survey(scenario, level, max(2, 24 // len(scenario.levels)), seed=5)
        for level in scenario.levels
    ]
    hits, clears, unsure, redrawn = (
        sum(f[k] for f in found) for k in ("hit", "clear", "uncertain", "redrawn")
    )
    total = hits + clears + unsure
    wanted = ONE_SIDED.get(name, {"hit", "clear"})
    assert {k for k, n in (("hit", hits), ("clear", clears)) if n} == wanted
    assert unsure <= 0.1 * total
    assert redrawn <= total, "more than half of what is generated is thrown away"


@pytest.mark.parametrize("name", ["thin_pair", "thin_wall", "spin_side", "full_turn"])
def test_place_is_what_its_name_says(name):
    expected = {
        "through": "hit",
        "past the rim": "clear",
        "in the way": "hit",
        "out of reach": "clear",
    }
    scenario = get(name)
    for level in scenario.levels[:3]:
        for index in range(4):
            case = scenario.case(12, level, index)
            truth = label(case.query)
            assert truth.start == "hit" or truth.label == expected[case.tags["place"]], case.id


def test_thin_pair_is_in_contact_for_its_share_of_the_step_and_at_any_time_of_it():
    begun = []
    for level in get("thin_pair").levels:
        for case in (get("thin_pair").case(14, level, index) for index in range(8)):
            truth = label(case.query)
            if case.tags["place"] == "through":
                assert truth.start == truth.end == "clear", case.id
                # half of 1 / level before the centres meet
                assert 0.4 <= (case.tags["crossing"] - truth.t_lo) * level <= 0.6, case.id
                begun.append(truth.t_lo)
    assert min(begun) < 0.15 and max(begun) > 0.85


@pytest.mark.parametrize("name", ["hooked_ls", "linked_tori"])
def test_hulls_overlap_where_the_solids_are_clear(name):
    scenario = get(name)
    for level in scenario.levels:
        q = scenario.case(13, level, 0).query
        hulls = Query(
            "overlap", Body.convex(q.a.vertices), Body.convex(q.b.vertices), q.pose_a, q.pose_b
        )
        assert label(hulls).label == "hit"


@pytest.mark.parametrize("level", get("near_parallel").levels)
def test_near_parallel_faces_are_certified_and_clear_where_lifted(level):
    """A pressed body may hang over the other's rim with its low side, so that only its label
    tells.
    """
    for case in (get("near_parallel").case(15, level, index) for index in range(12)):
        truth = label(case.query)
        assert truth.label != "uncertain" and not truth.touching
        assert truth.label == "clear" or case.tags["place"] == "pressed"
