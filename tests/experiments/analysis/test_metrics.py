# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The counts of a table, worked out by hand on a dozen observations."""

import numpy as np
import pandas as pd
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from baselines import registry
from baselines.easy_queries import box
from baselines.tolerance import Tolerance
from experiments.analysis import costs, metrics, outcome
from experiments.cases.case import Case
from experiments.cases.label import Truth
from experiments.run.folder import rows
from ofg import Motion, Pose, Query

nan = np.nan


def case(
    name,
    question="overlap",
    label="hit",
    start="uncertain",
    end="uncertain",
    gap=nan,
    t_lo=nan,
    t_hi=nan,
):
    return {
        "case": name,
        "scenario": "s",
        "level": 1.0,
        "question": question,
        "label": label,
        "start": start,
        "end": end,
        "gap": gap,
        "t_lo": t_lo,
        "t_hi": t_hi,
        "size": 2.0,
        "faces": 12,
        "certificate": "{}",
        "body_a": "x",
        "body_b": "x",
    }


def seen(name, hit=None, status="ok", time=nan, method="probe"):
    return {
        "case": name,
        "method": method,
        "status": status,
        "hit": hit,
        "time": time,
        "detail": "",
    }


def judged(cases, observations):
    return outcome.judge(pd.DataFrame(observations).astype({"hit": "boolean"}), pd.DataFrame(cases))


class Tables:
    """A run of two tables in memory."""

    def __init__(self, cases, observations):
        self.frames = {
            "cases.parquet": pd.DataFrame(cases),
            "observations.parquet": pd.DataFrame(observations).astype({"hit": "boolean"}),
        }

    def read(self, name):
        return self.frames[name]

    def has(self, name):
        return name in self.frames


@pytest.fixture
def tolerant(monkeypatch):
    """Every method tests solids, to 0.01."""
    monkeypatch.setattr(
        outcome, "_declared", lambda labels: {label: (True, Tolerance(0.01)) for label in labels}
    )


def came(cases, observations):
    return dict(zip([o["case"] for o in observations], judged(cases, observations).outcome))


def test_outcomes(tolerant):
    cases = [
        case("a"),
        case("b"),
        case("c", label="clear", gap=0.5),
        case("d", label="clear", gap=0.005),
        case("e", label="uncertain"),
        case("f"),
        case("g"),
        case("h", label="clear", gap=0.5),
    ]
    observations = [
        seen("a", True),
        seen("b", False),
        seen("c", True),
        seen("d", True),
        seen("e", True),
        seen("f", status="error"),
        seen("g", status="unsupported"),
        seen("h", False),
    ]
    assert came(cases, observations) == {
        "a": "right",
        "b": "miss",
        "c": "false alarm",
        "d": "false alarm",
        "e": "no label",
        "f": "error",
        "g": "unsupported",
        "h": "right",
    }


def test_nothing_unanswered_is_a_miss(tolerant):
    cases = [case(n) for n in "abc"]
    table = judged(
        cases,
        [seen("a", status="error"), seen("b", status="timeout"), seen("c", status="unsupported")],
    )
    (row,) = metrics.rates(table, ["method"]).to_dict("records")
    assert (
        row["asked"],
        row["answered"],
        row["hits"],
        row["misses"],
        row["failed"],
        row["unsupported"],
    ) == (3, 0, 0, 0, 2, 1)
    assert np.isnan(row["miss_rate"])


def test_tunnelling_needs_both_ends_clear(tolerant):
    cases = [
        case("a", "translation", start="clear", end="clear"),
        case("b", "translation", start="clear", end="hit"),
        case("c", "translation", start="clear", end="uncertain"),
    ]
    table = judged(cases, [seen(n, False) for n in "abc"])
    assert list(table.tunnelled) == [True, False, False] and list(table.outcome) == ["miss"] * 3


@pytest.mark.parametrize(
    "time, error", [(0.45, -0.05), (0.5, 0.0), (0.55, 0.0), (0.6, 0.0), (0.7, 0.1), (nan, nan)]
)
def test_time_errors_are_beyond_the_bracket(tolerant, time, error):
    table = judged(
        [case("a", "translation", start="clear", end="hit", t_lo=0.5, t_hi=0.6)],
        [seen("a", True, time=time)],
    )
    assert table.error.iloc[0] == pytest.approx(error, nan_ok=True)


def test_a_hit_at_the_start_has_no_time_error(tolerant):
    table = judged(
        [case("a", "translation", start="hit", end="hit", t_lo=0.0, t_hi=0.0)],
        [seen("a", True, time=0.3)],
    )
    assert np.isnan(table.error.iloc[0])


@given(st.integers(0, 50), st.integers(1, 50))
def test_wilson_holds_the_rate_and_stays_in_0_1(count, more):
    low, high = metrics.wilson(count, count + more)
    assert 0 <= low <= count / (count + more) <= high <= 1


def test_wilson_of_nothing_is_no_number():
    assert np.isnan(metrics.wilson(0, 0)).all()


def test_touching_is_nobodys_error(tolerant):
    cases = [{**case(n, label="clear", gap=0.0), "touching": n != "c"} for n in "abcd"]
    observations = [seen("a", True), seen("b", False), seen("c", True), seen("d", status="error")]
    table = judged(cases, observations)
    assert list(table.outcome) == ["touching", "touching", "false alarm", "error"]
    (row,) = metrics.rates(table, ["method"]).to_dict("records")
    assert (
        row["answered"],
        row["clears"],
        row["beyond"],
        row["touching"],
        row["touching_hits"],
    ) == (3, 1, 0, 2, 1)


def test_a_run_from_before_touching_was_known_has_none(tolerant):
    table = judged([case("a", label="clear", gap=0.5)], [seen("a", True)])
    assert list(table.outcome) == ["false alarm"] and not table.touching.any()


def clocked(own, other, floor=(100, 100, 100)):
    """Rows of timings.parquet: a floor of two methods, and a case for each net time of theirs."""
    times = {"ofg k=8": own, "brute-force": other}
    rows = [("overlap", "to 24", "near", m, "(floor)", 0, list(floor)) for m in times]
    rows += [
        ("overlap", "to 24", "near", m, str(i), 0, [100 + net] * 3)
        for m, nets in times.items()
        for i, net in enumerate(nets)
    ]
    columns = ["question", "faces", "situation", "method", "case", "build_ns", "rounds_ns"]
    run = Tables([], [seen("a")])
    run.frames["timings.parquet"] = pd.DataFrame(rows, columns=columns)
    return run


def ratio_of(run):
    found = costs.ratios(costs.case_costs(run), "ofg k=8", ["question"])
    return found[found.method == "brute-force"].iloc[0]


def test_a_net_time_within_the_noise_of_its_floor_is_no_denominator():
    quiet, loud = (100, 100, 100), (60, 100, 140)  # interquartile ranges of 0 and 40
    nets = (1, 100, 200), (1000, 1000, 1000)
    assert ratio_of(clocked(*nets, quiet)).ratio == 10
    row = ratio_of(clocked(*nets, loud))
    assert (row.ratio, row.pairs, row.in_noise) == (7.5, 2, 1)


def test_where_half_lies_within_the_noise_there_is_no_ratio():
    run = clocked((1, 2, 100, 200), [1000] * 4, (60, 100, 140))
    row = ratio_of(run)
    assert np.isnan(row.ratio) and (row.pairs, row.in_noise) == (2, 2)
    assert costs.paired_ratios(run, "ofg k=8").empty


@pytest.mark.parametrize(
    "tolerance, label, gap, hit, within",
    [
        (Tolerance(0.01), "clear", 0.009, True, True),
        (Tolerance(0.01), "clear", 0.011, True, False),
        (Tolerance(0.01), "hit", -0.009, False, True),
        (Tolerance(0.01), "hit", -0.011, False, False),
        (Tolerance(0.01, sides="alarms"), "hit", -0.009, False, False),
        (Tolerance(0.01, sides="misses"), "clear", 0.009, True, False),
        (Tolerance(relative=0.01), "clear", 0.019, True, True),
        (Tolerance(relative=0.01), "clear", 0.021, True, False),
        (Tolerance(step=0.01), "clear", 0.049, True, True),
        (Tolerance(step=0.01), "clear", 0.051, True, False),
        (Tolerance(0.01), "hit", nan, False, False),
    ],
)
def test_a_wrong_answer_is_credited_up_to_the_declared_tolerance(
    monkeypatch, tolerance, label, gap, hit, within
):
    """The same rule for all, on both sides: Bullet's margin alone was credited."""
    monkeypatch.setattr(
        outcome, "_declared", lambda labels: dict.fromkeys(labels, (True, tolerance))
    )
    table = judged(
        [{**case("a", "translation", label, gap=gap), "displacement": [3.0, 4.0, 0.0]}],
        [seen("a", hit)],
    )
    assert list(table.wrong) == [True] and list(table.within) == [within]
    (row,) = metrics.rates(table, ["method"]).to_dict("records")
    assert (row["wrong"], row["beyond"]) == (1, int(not within))


@pytest.mark.parametrize(
    "solid, hit, what", [(False, False, "contained"), (False, True, "right"), (True, False, "miss")]
)
def test_what_no_test_of_surfaces_can_see_is_in_no_rate(monkeypatch, solid, hit, what):
    """73 of the 77 errors of fcl-mesh were contained bodies."""
    monkeypatch.setattr(
        outcome, "_declared", lambda labels: {name: (solid, Tolerance()) for name in labels}
    )
    table = judged([{**case("a", gap=-0.5), "nested": True}], [seen("a", hit)])
    (row,) = metrics.rates(table, ["method"]).to_dict("records")
    assert list(table.outcome) == [what]
    assert (row["contained"], row["misses"], row["judged"]) == (
        what == "contained",
        what == "miss",
        what != "contained",
    )


@given(st.floats(0, 1), st.floats(0, 1), st.floats(0, 1), st.floats(0, 10), st.floats(0, 10))
def test_a_tolerance_is_a_sum_and_grows_with_what_it_is_of(length, relative, step, size, path):
    made = Tolerance(length, relative, step)
    assert made.reach(size, path) == pytest.approx(length + relative * size + step * path)
    assert made.reach(2 * size, 2 * path) >= made.reach(size, path) >= length


@pytest.mark.parametrize(
    "wrong", [{"length": -1.0}, {"step": nan}, {"relative": np.inf}, {"sides": "all"}]
)
def test_what_is_no_tolerance_is_refused(wrong):
    with pytest.raises(ValueError, match="not a tolerance"):
        Tolerance(**wrong)


@pytest.mark.parametrize(
    "name, length",
    [
        ("coal-convex-exact", 1e-12),
        ("mujoco-exact", 1e-12),
        ("parry-exact", 10 * 2.0**-52),
        ("rapier-exact", 10 * 2.0**-23),
        ("bullet-no-margin", 0.0),
        ("bullet-gjk-cast-exact", 0.003),
        ("bullet-continuous-cast-exact", 0.001),
        ("fcl-convex-exact", 1e-6),
    ],
)
def test_a_tolerance_of_best_effort_is_in_its_own_unit(name, length):
    """One that was in the query's unit credited an engine with errors a thousand times what it
    declares.
    """
    (method,) = registry.make(name)
    assert method.tolerance.length == 0
    assert method.tolerance.relative * method.length == pytest.approx(length)


@settings(max_examples=60, deadline=None)
@given(
    st.tuples(*[st.floats(-3, 3)] * 3),
    st.tuples(*[st.floats(-3, 3)] * 3),
    st.floats(-7, 7),
    st.floats(-7, 7),
)
def test_the_path_bounds_what_the_distance_of_two_points_changes_by(
    about, displacement, angle, angle_b
):
    a, b = box(1, 2, 3), box(0.5, 1, 1)
    query = Query(
        "motion",
        a,
        b,
        Pose((1, 2, 3, 4)),
        Pose((1, 0, 1, 0), (4, 0, 0)),
        Motion(displacement, (1, 1, 0), angle, about),
        Motion((1, 0, 0), (0, 0, 1), angle_b, about),
    )
    row = rows.case_row(Case("c", "s", 1.0, 0, query), Truth("hit"), 0)
    (path,) = outcome._path(pd.DataFrame([row]))
    for t in (0.25, 0.5, 1.0):
        pose_a, pose_b = (
            query.motion.pose_at(query.pose_a, t),
            query.motion_b.pose_at(query.pose_b, t),
        )
        start = query.pose_a.apply(a.vertices)[:, None] - query.pose_b.apply(b.vertices)
        now = pose_a.apply(a.vertices)[:, None] - pose_b.apply(b.vertices)
        assert np.linalg.norm(now - start, axis=2).max() <= path * (1 + 1e-12) + 1e-12
