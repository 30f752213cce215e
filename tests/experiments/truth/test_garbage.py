# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""A certificate that cannot be read is refused by itself, and what is beside it is checked."""

from __future__ import annotations

import json
from dataclasses import replace
from math import inf, nan

import pytest

from experiments.run.folder.rows import _certificate
from experiments.truth import label, verify
from ofg import Body, Motion, Pose, Query

CUBE = Body.convex([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)])
FAR = Body.convex(CUBE.vertices - [3, 0, 0])
MOVE = Motion((3, 0, 0))
SWEEP = Query("translation", CUBE, CUBE, Pose(), Pose(position=(2, 0.25, 0)), MOVE)
TRUTH = label(SWEEP)
HUGE = ("9" * 400, "-" + "9" * 400, 10**400, "9" * 5000, "1/0", "1/" + "9" * 400)
WORDS = (nan, inf, -inf, None, True, "x", "\ud800", "１", "1_0", [], {}, [[]])


def edited(change):
    certificate = json.loads(json.dumps(TRUTH.certificate))
    change(certificate)
    return certificate


def planes(value):
    return [edited(lambda c, i=i: c["clear"]["tree"][0][0].__setitem__(i, value)) for i in range(5)]


def points(value):
    places = [(where, i) for where, n in (("point", 3), ("a", 5), ("b", 5)) for i in range(n)]
    return [edited(lambda c, w=w, i=i: c["hit"][w].__setitem__(i, value)) for w, i in places]


def fields(value):
    return [edited(lambda c, key=key: c.__setitem__(key, value)) for key in TRUTH.certificate]


@pytest.mark.parametrize("value", [*HUGE, *WORDS], ids=lambda v: ascii(v)[:12])
def test_a_number_that_is_none_never_ends_the_checking(value):
    """A rational of 400 digits overflowed in the doubles, outside what refuses one certificate."""
    garbage = planes(value) + points(value) + fields(value)
    labelled = [(SWEEP, TRUTH)]
    labelled += [(SWEEP, replace(TRUTH, certificate=c)) for c in garbage] + [(SWEEP, TRUTH)]
    result = verify(labelled)
    refused = {i for i, *_ in result.refused}
    assert not refused & {0, len(labelled) - 1}
    assert len(refused) + result.verified["hit"] == len(labelled)
    assert len(refused) >= len(fields(value))


def test_deep_nesting_is_refused():
    """json.loads raises RecursionError, which is no ValueError."""
    deep = [_certificate("[" * n + "]" * n) for n in (500, 100_000)]
    result = verify([(SWEEP, replace(TRUTH, certificate=c)) for c in (*deep, TRUTH.certificate)])
    assert [i for i, *_ in result.refused] == [0, 1]


@pytest.mark.parametrize("gap", [nan, inf, -inf])
def test_a_gap_is_a_number(gap):
    """`not gap < 0` is true of NaN."""
    resting = Query("overlap", CUBE, CUBE, Pose(), Pose(position=(2, 0, 0)))
    assert verify([(resting, replace(label(resting), gap=gap))]).refused
    assert verify([(SWEEP, replace(TRUTH, gap=gap))]).refused


def test_an_uncertain_label_claims_nothing():
    claim = replace(TRUTH, label="uncertain", reason="?")
    assert verify([(SWEEP, claim), (SWEEP, replace(claim, certificate={}))]).refused[1:]


def test_an_exact_time_of_a_union_is_refused():
    """The plane met one piece at t*, and another was met before: a wrong time was accepted."""
    a = Body.union([FAR, CUBE])
    query = Query("translation", a, CUBE, Pose(), Pose(position=(2, 0.25, 0)), MOVE)
    late = json.loads(json.dumps(TRUTH.certificate["exact"]))
    late["a"]["piece"] = 0
    late["time"] = "4/3"
    proved = label(query)
    for exact in (late, {**TRUTH.certificate["exact"], "a": {**late["a"], "piece": 1}}):
        certificate = {**proved.certificate, "exact": exact}
        assert verify([(query, replace(proved, certificate=certificate))]).refused
