# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""What is known of the engines, measured anew: facts that the adapters rely on or that the tables
must show.
"""

import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from baselines import fcl_heap, ipctk, registry
from baselines.contract import Unsupported
from baselines.easy_queries import body, box, sweep
from experiments.cases.families import get
from experiments.truth import label
from ofg import Motion, Pose, Query


def verdict(spec: str, query: Query):
    return registry.make(spec)[0].prepare(query)()


def cubes(gap: float) -> Query:
    return Query("overlap", body("convex"), body("convex"), Pose(position=(2 + gap, 0, 0)))


def test_fcl_signed_distance_aborts_the_process_near_touching():
    """Some pairs of cubes, face to face 1e-8 to 1e-11 deep and turned together, end the process:
    about 1 of 100, by the last bits of the pose, so that another processor's sines choose others.
    """
    program = """
import numpy as np
from scipy.spatial.transform import Rotation
from baselines import registry
from baselines.easy_queries import body
from ofg import Pose, Query
method, cube = registry.make("fcl-distance")[0], body("convex")
for seed in range(2000):
    q = Rotation.random(random_state=seed).as_quat()[[3, 0, 1, 2]]
    gap = 10.0 ** -(8 + seed % 4)
    at = Pose(q).apply(np.array([[2 - gap, 0.3 * (seed % 2), 0.2 * (seed % 2)]]))[0]
    method.prepare(Query("overlap", cube, cube, Pose(q, at), Pose(q)))()
"""
    death = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert death.returncode == -6 and "logic_error" in death.stderr


def test_fcl_mesh_default_request_misses_pass_throughs():
    rng = np.random.default_rng(0)
    missed = 0
    for _ in range(40):
        a = Pose(rng.normal(size=4), (-5, *rng.uniform(-0.5, 0.5, 2)))
        missed += not verdict(
            "fcl-ccd-mesh",
            Query("translation", body("mesh"), body("mesh"), a, Pose(), Motion((10, 0, 0))),
        ).hit
    assert missed >= 36


def test_fcl_meets_a_plate_on_the_linear_path_with_its_own_solver():
    """With libccd some boxes pass a plate unseen; on CCDM_TRANS some that fall obliquely."""
    rng = np.random.default_rng(0)
    best = "fcl-advancement-convex"
    missed = dict.fromkeys(("fcl-ccd-convex", f"{best} path=trans", best), 0)
    for _ in range(100):
        half, thin = rng.uniform(0.2, 1, 3), rng.uniform(0.01, 0.3)
        x, y, z = *rng.uniform(-3, 3, 2), half[2] + thin + rng.uniform(0.1, 2)
        motion = Motion((*rng.uniform(-0.3, 0.3, 2), -2 * z))
        at = Pose(position=(x, y, z))
        query = Query("translation", box(*half), box(4, 4, thin), at, Pose(), motion)
        for name in missed:
            missed[name] += not verdict(name, query).hit
    assert missed.pop(best) == 0 and min(missed.values()) > 0


@pytest.mark.parametrize("name", ["fcl-naive-convex", "fcl-naive-mesh", "fcl-advancement-convex"])
def test_fcl_linear_motion_does_not_depend_on_stale_memory(name):
    query = Query(
        "motion",
        body("convex"),
        body("convex"),
        Pose(position=(-5, 0, 0)),
        Pose(),
        Motion((10, 0, 0), (0, 0, 1), 1.0),
    )
    ask = registry.make(name)[0].prepare(query)
    answers = set()
    for stale in (0, 0x7F, 0xFF, 0x3F):
        fcl_heap.fill_motions(stale)
        answers.add(ask())
    assert len(answers) == 1 and answers.pop().hit


def test_bullet_margin_shows_below_2e_3_and_is_corrected():
    for gap, hit in ((2.1e-3, False), (1.9e-3, True), (1e-6, True), (-1e-6, True)):
        assert verdict("bullet", cubes(gap)).hit == hit
        assert verdict("bullet-no-margin", cubes(gap)).hit == (gap < 0)


def test_bullet_and_its_removal_print_nothing():
    program = (
        "import gc; from baselines import registry; from baselines.easy_queries import overlap; f ="
        " registry.make('bullet')[0].prepare(overlap('union', (3, 0, 0))); f(); del f; gc.collect()"
    )
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert (run.returncode, run.stdout, run.stderr) == (0, "", "")


@settings(max_examples=40, deadline=None)
@given(time=st.floats(0.05, 0.95), speed=st.floats(3, 50), side=st.floats(-1.5, 1.5))
def test_mujoco_speculative_is_early_by_two_percent_of_the_start_distance(time, speed, side):
    query = sweep("translation", "convex", (-2 - time * speed, side, 0), (speed, 0, 0))
    answer = verdict("mujoco-speculative", query)
    assert answer.hit and answer.time == pytest.approx(0.98 * time, abs=1e-5)


@settings(max_examples=40, deadline=None)
@given(
    n=st.integers(1, 40),
    start=st.floats(-9, -2.5),
    reach=st.floats(1, 12),
    name=st.sampled_from(
        ["fcl-convex-substeps", "fcl-mesh-substeps", "bullet-no-margin-substeps", "mujoco-substeps"]
    ),
)
def test_substeps_answer_at_the_first_sample_inside(n, start, reach, name):
    # cubes of 2: in each other where |offset| < 2
    offsets = start + reach * np.arange(1, n + 1) / n
    inside = np.abs(offsets) < 2
    if np.any(np.abs(np.abs(offsets) - 2) < 1e-4):
        return
    answer = verdict(
        f"{name} n={n}", sweep("translation", "convex", (start, 0.3, 0.2), (reach, 0, 0))
    )
    assert answer.hit == inside.any()
    if answer.hit:
        assert answer.time == (np.flatnonzero(inside)[0] + 1) / n


def test_a_surface_method_misses_containment_and_a_solid_one_does_not():
    query = Query("overlap", box(0.2, 0.2, 0.2), body("convex"))
    assert not verdict("fcl-mesh", query).hit
    assert all(verdict(name, query).hit for name in ("fcl-convex", "bullet", "mujoco"))


TURN = Query(
    "motion",
    body("convex"),
    body("convex"),
    Pose(position=(-5, 0, 0)),
    Pose(),
    Motion((10, 0, 0), (0, 0, 1), 1.0),
)


@pytest.mark.parametrize("name", ["fcl-ccd-convex", "fcl-ccd-mesh", "ipctk-ccd"])
def test_a_default_for_straight_paths_refuses_turns(name):
    """Asked all the same, it answers about another motion: all misses of ipctk-ccd were of
    turns.
    """
    assert registry.methods()[name].questions == {"translation"}
    if registry.available(registry.methods()[name]):
        pytest.skip("its engine is not installed")
    with pytest.raises(Unsupported, match="does not answer motion"):
        registry.make(name)[0].ready(TURN)


@pytest.mark.parametrize("name", ["ipctk-ccd", "ipctk-ccd-exact"])
def test_ipctk_answers_turns_in_pieces(name):
    if registry.available(registry.methods()[name]):
        pytest.skip("ipctk is not installed")
    for n, asked in ((1, {"translation"}), (2, {"translation", "motion"})):
        assert registry.make(f"{name} n={n}")[0].questions == asked
    method = registry.make(f"{name} n=16 max_iterations=1000")[0]
    assert method.ready(TURN)().hit
    # the cheapest call, which gives its floor, has to answer whatever the method does
    cheapest = method.floor()
    assert cheapest.questions == method.questions


def test_ipctk_pieces_are_the_fewest_within_the_chord():
    """A chord of 2 pi / n is off its arc by 1 - cos(pi / n) of the radius."""
    n = registry.methods()["ipctk-ccd-exact"].parameters["n"]
    off = [1 - np.cos(np.pi / pieces) for pieces in (n // 2, n)]
    assert np.log2(n) % 1 == 0 and off[0] > ipctk.CHORD >= off[1]


def test_fcl_misses_wedges_between_nearly_parallel_faces():
    """Its GJK ends before the wedge is found: fcl issue 445."""
    cases = [get("near_parallel").case(2004, 1e-8, index) for index in range(20)]
    hits = [case.query for case in cases if label(case.query).label == "hit"]
    assert sum(not verdict("fcl-convex", query).hit for query in hits) > len(hits) / 4
