# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The verdict on a claim turns when the rows do."""

import dataclasses
import re

import numpy as np
import pandas as pd
import pytest

from experiments.publish.findings import ends
from experiments.publish.findings.claims import CLAIMS
from experiments.publish.findings.runs import (
    FAILS,
    HOLDS,
    PART,
    UNMEASURED,
)
from experiments.run import config
from experiments.studies import sizes
from experiments.studies.native.summary import summary
from ofg import Body, Motion, Pose, Query, ask

from .fake_runs import TRIANGLE, Fake, N, of, said

OF_MISSES = [  # the claim; whose answers decide it
    ("Virtual edges prevent", {"ofg k=8"}),
    ("Virtual edges, the start", {"brute-force"}),
    ("Step 1", {"ofg k=8 broad=start"}),
    ("Linearised", {"ofg k=8"}),
    ("The pieces", {"ofg k=8"}),
    ("Faces alone", {"brute-force"}),
    ("Units", {"ofg k=8"}),
    ("With all repairs", {"ofg k=8 repairs=all"}),
]


@pytest.mark.parametrize("title, methods", OF_MISSES)
def test_a_verdict_turns_when_the_rows_do(title, methods):
    assert said(title, Fake()) == HOLDS
    assert said(title, Fake(lambda method, scenario, i: method in methods)) == FAILS
    assert (
        said(title, Fake(lambda method, scenario, i: method not in methods and i < N / 2)) == HOLDS
    ), "others' misses decide nothing"


@pytest.mark.parametrize(
    "title, family",
    [
        ("Linearised", "spin_side"),
        ("The pieces", "linked_tori"),
        ("Units", "sliver"),
        ("Virtual edges prevent", "screw_wall"),
        ("With all repairs", "contained"),
    ],
)
def test_one_bad_family_is_a_part(title, family):
    assert said(title, Fake(lambda method, scenario, i: scenario == family)) == PART


def test_a_higher_k():
    def missed_under(bound):
        return lambda method, scenario, i: (
            method.startswith("ofg k=")
            and " " not in method[4:]
            and i < bound(float(method.split("=")[1]), scenario)
        )

    assert said("A higher k", Fake(missed_under(lambda k, scenario: 64 / k))) == HOLDS
    assert said("A higher k", Fake(missed_under(lambda k, scenario: min(k, 512) / 8))) == FAILS
    assert (
        said(
            "A higher k",
            Fake(
                missed_under(lambda k, scenario: 64 / k + 10 * (scenario == "sliver" and k == 16))
            ),
        )
        == PART
    )


def test_false_alarms():
    assert said("No false", Fake(label="clear")) == HOLDS
    assert (
        said("No false", Fake(lambda method, scenario, i: method == "ofg k=8", label="clear"))
        == FAILS
    )
    assert (
        said(
            "No false",
            Fake(
                lambda method, scenario, i: scenario == "graze" or scenario == "contact",
                label="clear",
            ),
        )
        == PART
    )


def test_false_alarms_of_one_family_are_a_part():
    many = Fake(lambda method, scenario, i: scenario == "graze" and i < N / 4, label="clear")
    assert said("No false", many) == PART, "2 % of all, 25 % of the family"


def test_it_says_which_bodies_the_repairs_were_asked_of():
    text = of("With all repairs", Fake()).text
    assert "convex and mesh" in text
    assert all(c.name in text for c in config.load("repairs").scenarios)


@pytest.mark.parametrize("size", [1e-9, 1.0, 1e9])
@pytest.mark.parametrize(
    "other, meet",
    [
        (TRIANGLE + [0, 0, 1e-6], False),
        (TRIANGLE + [0.3, 0.3, 0], True),
        (TRIANGLE + [0.9, 0.9, 0], False),
        (np.array([[0.1, 0.1, -1], [0.1, 0.1, 1], [2, 2, 2]]), True),
        (np.array([[1.1, 0.1, -1], [1.1, 0.1, 1], [2, 2, 2]]), False),
    ],
)
def test_two_triangles_meet(size, other, meet):
    assert ends.touch(TRIANGLE * size, other * size) == meet
    assert ends.touch(other * size, TRIANGLE * size) == meet


def test_faces_that_are_named_at_the_end_meet_there():
    cube = Body.convex(np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float))
    path = Motion((-1.5, 0, 0))
    query = Query("translation", cube, cube, Pose(position=(2, 0.3, 0.4)), Pose(), path)
    answer = ask(query, k=8)
    assert answer.found == "end" and ends.meets(query, answer)
    swapped = dataclasses.replace(answer, found="start")
    assert not ends.meets(query, swapped), "nothing meets where the step begins"


def test_an_undivided_counterexample_is_one():
    assert said("Some concave", Fake()) == FAILS, "nothing missed: no counterexample"
    assert said("Some concave", Fake(lambda method, scenario, i: i == 7)) == HOLDS


OFF = [(0.0, 1.0, HOLDS), (0.1, 1.0, FAILS), (0.1, 0.3, PART), (0.1, 0.01, HOLDS)]
NEVER = float("nan")


@pytest.mark.parametrize("off, share, verdict", [*OFF, (NEVER, 1.0, FAILS), (NEVER, 0.3, PART)])
def test_times_of_impact(off, share, verdict):
    runs = Fake(late=lambda method, i: off if i < share * N else 0.0)
    assert said("Relative velocity", runs) == said("Halving", runs) == verdict


@pytest.mark.parametrize(
    "title, one, other",
    [
        ("Relative", "ofg k=8", "ofg k=8 order=steps"),
        ("Halving", "ofg k=8 toi=halving", "ofg k=8 toi=bisection"),
    ],
)
def test_one_reading_of_two_is_a_part(title, one, other):
    assert said(title, Fake(late=lambda method, i: 0.1 * (method == one))) == PART
    assert said(title, Fake(late=lambda method, i: 0.1 * (method == other))) == PART
    assert said(title, Fake(late=lambda method, i: 0.1 * (method not in (one, other)))) == HOLDS


def test_hits_at_an_end_are_no_estimates():
    """Half of the times are 1, which is half a step late: of OFG that is where the step ends."""
    late = lambda end: Fake(late=lambda method, i: end if i % 2 else 0.0)  # noqa: E731
    for title in ("Relative velocity", "Halving"):
        assert said(title, late(0.5)) == HOLDS and said(title, late(0.4999)) == PART
    families = len(config.load("impact").scenarios)
    assert f"n={families * N // 2}" in of("Halving", late(0.5)).number


def test_an_estimate_that_comes_out_as_the_end_is_still_one():
    def late(method, i):
        return 0.5 * ("bisection" in method)

    number = of("Halving", Fake(late=late)).number
    hits = len(config.load("impact").scenarios) * N
    assert number.count(f"n={hits}") == 2 and said("Halving", Fake(late=late)) == PART


def test_hits_without_a_time_are_counted_and_shown():
    runs = Fake(late=lambda method, i: NEVER if i < N / 4 else 0.0)
    hits = len(config.load("impact").scenarios) * N
    number = of("Halving", runs).number
    assert number.count(f"{hits // 4} of {hits} hits without a time") == 2


def test_faces_at_an_end_are_known():
    assert said("Faces that meet at the start", Fake(unknown=0)) == HOLDS
    assert said("Faces that meet at the start", Fake(unknown=N // 2)) == FAILS
    late = Fake(late=lambda method, i: 0.5, wrong=lambda method, scenario, i: True)
    assert said("Faces that meet at the start", late) == HOLDS, "how late is no verdict"


@pytest.mark.parametrize(
    "slow, verdict",
    [
        (lambda m, level: 10.0 if m == "brute-force" else 1.0, HOLDS),
        (lambda m, level: 0.5 if m == "brute-force" else 1.0, FAILS),
        (lambda m, level: level / 100 if m == "brute-force" else 1.0, PART),
    ],
)
def test_cheaper_than_all_pairs(slow, verdict):
    assert said("Cheaper", Fake(slow=slow)) == verdict


def test_cells_within_the_noise_decide_nothing():
    def slow(m, level):  # slower than all pairs at the fewest faces
        return 1.0 if m == "brute-force" else 2.0 if level == 20 else 0.5

    def noise(m, level):
        return 2000.0 if m == "ofg k=8" and level == 20 else 0.0

    assert said("Cheaper", Fake(slow=slow)) == PART
    assert said("Cheaper", Fake(slow=slow, noise=noise)) == HOLDS
    number = of("Cheaper", Fake(slow=slow, noise=noise)).number
    assert "2 of 2 cells" in number and "left out: 1 of 3 cells" in number
    assert said("Cheaper", Fake(noise=lambda m, level: 2000.0)) == UNMEASURED


ENGINES = ("fcl-convex", "bullet", "mujoco", "parry", "coal-convex")


def native(own: float, small: float, engines=ENGINES, **named) -> pd.DataFrame:
    """Rows of the native study: ns of `own`, 100 of the engines, times `small` at 12 faces.

    named: another time for an engine.
    """
    ofg = [
        (m, isa, mode, own)
        for isa in ("SSE2", "AVX2")
        for m in ("ofg k=8", "ofg k=8 screen=True")
        for mode in ("cold", "warm", "batch")
    ]
    theirs = [
        (e, isa, mode, named.get(e, 100.0))
        for e in engines
        for isa in ("generic", "x86-64-v3")
        for mode in ("cold", "warm")
    ]
    times = pd.DataFrame(
        [
            {
                "bodies": "hull",
                "faces": f"{f}",
                "question": "overlap",
                "situation": "gap",
                "engine": e,
                "isa": isa,
                "build": "",
                "mode": mode,
                "block": b,
                "build_ns": 1,
                "built": 2,
                "bytes": -1,
                "ns": ns * (s if e in engines else 1),
            }
            for f, s in ((12, small), (320, 1.0))
            for e, isa, mode, ns in (*ofg, *theirs)
            for b in range(3)
        ]
    )
    return summary(times, times.assign(hit=False, label="clear", time=np.nan))


def test_faster_than_the_engines():
    assert said("Faster", Fake(rows=native(50, 1))) == HOLDS
    assert said("Faster", Fake(rows=native(50, 0.1))) == PART
    assert said("Faster", Fake(rows=native(500, 1))) == FAILS


def test_screened_in_batch():
    assert said("At small gaps", Fake(rows=native(15, 1))) == HOLDS
    assert said("At small gaps", Fake(rows=native(15, 0.2))) == PART
    assert said("At small gaps", Fake(rows=native(60, 1))) == FAILS


@pytest.mark.parametrize("engines", [ENGINES[:3], ENGINES[:4]])
def test_an_engine_that_was_not_asked_leaves_a_part(engines):
    assert said("At small gaps", Fake(rows=native(15, 1, engines))) == PART
    assert said("At small gaps", Fake(rows=native(60, 1, engines))) == FAILS
    number = of("At small gaps", Fake(rows=native(15, 1, engines))).number
    assert re.search("without .*Coal", number)


def test_the_fastest_of_all_engines_is_the_measure():
    assert said("At small gaps", Fake(rows=native(15, 1, parry=20.0))) == FAILS
    assert said("Faster", Fake(rows=native(25, 1, parry=20.0))) == FAILS


def hulls(missed, pairs=lambda question, k: k * k, distances=2.0, evaluated=1) -> pd.DataFrame:
    """Rows of the claims run; missed(faces, depth): how many of N."""
    made = []
    for faces in sizes.FACES:
        for k in (*(k for k in sizes.KS if k < faces), faces):
            for question, depth in (
                ("overlap", "shallow"),
                ("overlap", "deep"),
                ("translation", ""),
                ("motion", ""),
            ):
                made += [
                    {
                        "question": question,
                        "faces": faces,
                        "depth": depth,
                        "case": i,
                        "k": k,
                        "repairs": False,
                        "hit": k == faces or i >= missed(faces, depth),
                        "distances": distances * faces,
                        "face_pairs": pairs(question, k),
                        "edge_faces": 0,
                        "full_tests": min(1, pairs(question, k)),
                        "evaluated": evaluated * faces,
                    }
                    for i in range(N)
                ]
    return pd.DataFrame(made)


@pytest.mark.parametrize(
    "title, good, bad",
    [
        ("k of 4 to 8", hulls(lambda f, d: 0), hulls(lambda f, d: 50)),
        (
            "Small faces",
            hulls(lambda f, d: 0 if f < 1000 else 50),
            hulls(lambda f, d: 50 if f < 1000 else 0),
        ),
        (
            "Best for convex",
            hulls(lambda f, d: 0 if f < 1000 else 50),
            hulls(lambda f, d: 50 if f < 1000 else 0),
        ),
        (
            "Once bodies",
            hulls(lambda f, d: 50 * (d == "deep")),
            hulls(lambda f, d: 50 * (d == "shallow")),
        ),
        ("Selecting faces", hulls(lambda f, d: 0), hulls(lambda f, d: 0, distances=2.1)),
        ("At most k^2", hulls(lambda f, d: 0), hulls(lambda f, d: 0, lambda q, k: k * k + 1)),
        ("Selecting faces", hulls(lambda f, d: 0), hulls(lambda f, d: 0, evaluated=5)),
        ("k^2 + 3k", hulls(lambda f, d: 0), hulls(lambda f, d: 0, lambda q, k: 5 * k * k)),
    ],
)
def test_sizes_and_operations(title, good, bad):
    assert said(title, Fake(rows=good)) == HOLDS and said(title, Fake(rows=bad)) == FAILS


def test_sweeps_have_no_part_in_the_count_of_overlap():
    swept = hulls(lambda f, d: 0, lambda q, k: k * k if q == "overlap" else 5 * k * k)
    assert said("k^2 + 3k", Fake(rows=swept)) == HOLDS


def test_every_claim_is_turned_by_some_test():
    tried = [t for t, _ in OF_MISSES] + [
        "A higher k",
        "No false",
        "Faces that meet at the start",
        "Some concave",
        "Relative",
        "Halving",
        "Cheaper",
        "Faster",
        "At small gaps",
        "k of",
        "Small",
        "Best",
        "Once",
        "Selecting",
        "At most",
        "k^2",
        "Verified",  # test_claim_verified.py
    ]
    assert all(any(c.title.startswith(t) for t in tried) for c in CLAIMS)
