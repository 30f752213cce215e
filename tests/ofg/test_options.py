# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Bad input is refused in words that help; the grammar of repairs."""

import numpy as np
import pytest

import ofg
from ofg import Pose
from ofg.options import REPAIRS, core_options, repair_options


@pytest.mark.parametrize(
    "options, word",
    [
        ({"k": 0}, "k = 0"),
        ({"k": 2.5}, "k = 2.5"),
        ({"toi": "newton"}, "velocity"),
        ({"broad": "sap"}, "swept"),
        ({"concave": "hull"}, "undivided"),
        ({"nearest": "nearest"}, "centroid"),
        ({"selection_times": 4}, "from 1 to 3"),
        ({"iterations": 0}, "iterations"),
        ({"arc_tolerance": -1.0}, "arc_tolerance"),
        ({"repairs": "all-but-k"}, "adaptive-k"),
        ({"repairs": "arcs+magic"}, "magic"),
        ({"precision": "half"}, "double"),
    ],
)
def test_unknown_values_name_the_option_and_what_there_is(cube, options, word):
    with pytest.raises(ValueError, match=word):
        ofg.discrete(cube, cube, **options)


def test_unknown_options_are_refused(cube):
    with pytest.raises(TypeError, match="adaptive_k"):
        ofg.discrete(cube, cube, adaptive=True)


@pytest.mark.parametrize(
    "poses, word",
    [
        (np.zeros((3, 6)), "shape"),
        (np.full((3, 7), np.nan), "finite"),
        (np.zeros((3, 7)), "zero quaternion"),
        ([(1, 2)], "Pose"),
    ],
)
def test_bad_poses_are_refused(cube, poses, word):
    with pytest.raises((ValueError, TypeError), match=word):
        ofg.discrete_many(cube, cube, poses, Pose())


def test_arrays_of_different_lengths_are_refused(cube):
    with pytest.raises(ValueError, match="3 and 4 rows|4 and 3 rows"):
        ofg.discrete_many(cube, cube, [Pose()] * 3, [Pose()] * 4)


def test_no_poses_give_no_answers(cube):
    assert len(ofg.discrete_many(cube, cube, np.zeros((0, 7)), np.zeros((0, 7)))) == 0


def test_every_repair_is_a_switch_of_its_own():
    article = core_options()
    fields = (
        "broad",
        "concave",
        "nearest",
        "selection_times",
        "arc_tolerance",
        "adaptive_k",
        "both_vertices",
        "edge_edge",
        "containment",
        "end_moment",
        "piece_times",
        "earliest",
    )
    for name in REPAIRS:
        alone = core_options(repairs=name)
        changed = [f for f in fields if getattr(alone, f) != getattr(article, f)]
        # swept spheres are the default reading of step 1
        assert len(changed) == (0 if name == "swept-spheres" else 1), name
        all_but = core_options(repairs=f"all-but-{name}")
        assert (
            sum(getattr(all_but, f) != getattr(core_options(repairs="all"), f) for f in fields) == 1
        ), name
    assert repair_options("arcs+containment") == {"arc_tolerance": 1e-6, "containment": True}
