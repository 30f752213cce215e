# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Both bodies move and turn: swapping changes nothing, instants agree, and the bound on the second
derivative is a bound.
"""

from __future__ import annotations

import importlib.util
import sys
from dataclasses import replace
from pathlib import Path

import flint
import numpy as np
import pytest
from scipy.optimize import linprog

from experiments.truth import check_many, label, label_many
from experiments.truth.check import float_filter, proof
from experiments.truth.check import obligations as owed
from experiments.truth.check.balls import BITS, number
from experiments.truth.check.geometry import Pair
from ofg import Body, Motion, Pose, Query

from .draw import moved_together, reversed_in_time, scaled, two_movers

# What the second-order bound must not lose: the way of B's point from where it stood at the start
# of the interval (a maximum at the ends alone is sound only while B rests), and B's rate in the
# Coriolis term.
MUTANTS = {
    "maximum at the ends": {
        "proof": (" + wQ * h * own\n", "\n"),
        "float_filter": ("(arm + (e - s)[q_of] * spun)", "arm"),
    },
    "Coriolis without B's rate": {
        "proof": ("2 * wP * (slide + wQ * own)", "2 * wP * slide"),
        "float_filter": ("2 * wP[q_of] * (slide[q_of] + spun)", "2 * wP[q_of] * slide[q_of]"),
    },
}


def mutant(module, old, new):
    source = Path(module.__file__).read_text()
    assert source.count(old) == 1, f"the mutation does not fit {module.__name__} any more"
    spec = importlib.util.spec_from_loader(module.__name__, loader=None, origin=module.__file__)
    made = importlib.util.module_from_spec(spec)
    exec(compile(source.replace(old, new), module.__file__, "exec"), made.__dict__)
    return made


def test_two_thousand_labels_are_settled_and_do_not_change_when_the_bodies_are_swapped():
    rng = np.random.default_rng(20)
    queries = [two_movers(rng) for _ in range(2000)]
    first, second = label_many(queries), label_many(q.swapped() for q in queries)
    assert [(t.label, t.start, t.end) for t in first] == [(t.label, t.start, t.end) for t in second]
    labels = [t.label for t in first]
    assert labels.count("uncertain") == 0 and min(labels.count("hit"), labels.count("clear")) > 300
    for one, two in zip(first, second):
        if one.label == "hit":
            assert one.t_lo <= two.t_hi and two.t_lo <= one.t_hi


def test_common_motion_scaling_and_time_reversal_change_no_verdict():
    rng = np.random.default_rng(21)
    for i in range(30):
        query = two_movers(rng)
        truth = label(query)
        for other in (moved_together(query, i % 3), scaled(query, 20), scaled(query, -30)):
            again = label(other)
            assert (again.label, again.start, again.end) == (truth.label, truth.start, truth.end)
        again = label(reversed_in_time(query))
        assert (again.label, again.start, again.end) == (truth.label, truth.end, truth.start)


def test_a_displacement_common_to_both_bodies_changes_no_verdict():
    rng = np.random.default_rng(22)
    for _ in range(40):
        query = two_movers(rng)
        shift = rng.integers(-8, 8, 3).astype(float)
        motions = [
            replace(m, displacement=m.displacement + shift) for m in (query.motion, query.motion_b)
        ]
        one, two = label(query), label(replace(query, motion=motions[0], motion_b=motions[1]))
        assert (one.label, one.start, one.end) == (two.label, two.start, two.end)
        if one.label == "hit":
            assert one.t_lo <= two.t_hi and two.t_lo <= one.t_hi


def test_a_turn_about_a_point_is_that_of_the_body_framed_there():
    rng = np.random.default_rng(23)
    for _ in range(20):
        a, b = (Body.convex(rng.integers(-9, 10, (12, 3)).astype(float)) for _ in range(2))
        c = rng.integers(-9, 10, 3).astype(float)
        pose_a, pose_b = Pose(), Pose(rng.integers(1, 5, 4).astype(float), [30.0, 2, 1])
        turn = Motion([25, 0, 0], rng.normal(size=3), 2.0, c)
        about = Query("motion", a, b, pose_a, pose_b, turn)
        framed = Query(
            "motion",
            Body.convex(a.vertices - c),
            b,
            Pose(position=c),
            pose_b,
            replace(turn, about=np.zeros(3)),
        )
        one, two = label(about), label(framed)
        assert (one.label, one.start, one.end) == (two.label, two.start, two.end)
        if one.label == "hit":
            assert one.t_lo <= two.t_hi and two.t_lo <= one.t_hi


def gap_at(query, t) -> float:
    """> 0 apart, < 0 overlapping, as a share of the size: the widest plane by a linear program,
    which asks nothing of ours.
    """
    (a, b), size = (
        [
            m.pose_at(p, t).apply(x.vertices)
            for x, p, m in (
                (query.a, query.pose_a, query.motion),
                (query.b, query.pose_b, query.motion_b),
            )
        ],
        max(query.a.size, query.b.size),
    )
    centre = a.mean(axis=0)
    a, b = (a - centre) / size, (b - centre) / size
    rows = np.concatenate(
        [np.c_[-b, np.ones((len(b), 2))], np.c_[a, -np.ones(len(a)), np.ones(len(a))]]
    )
    r = linprog(
        [0, 0, 0, 0, -1],
        A_ub=rows,
        b_ub=np.zeros(len(rows)),
        bounds=[(-1, 1)] * 3 + [(None, None)] * 2,
        method="highs",
        options={"primal_feasibility_tolerance": 1e-10},
    )
    return r.x[4] if r.x[4] > 1e-9 else -1.0


def test_instants_agree_with_a_linear_program():
    """The full one, 2,000 cases by an exact kernel, is `python -m
    experiments.truth.audit.crosscheck --scenarios both_moving`.
    """
    rng = np.random.default_rng(24)
    for _ in range(60):
        query = two_movers(rng)
        truth = label(query)
        until = truth.t_lo if truth.label == "hit" else 1.0
        if truth.start == "clear":
            assert all(gap_at(query, t) > 0 for t in np.linspace(0, until * (1 - 1e-3), 12))
        if truth.label == "hit" and truth.gap < -1e-3:
            assert any(gap_at(query, t) < 0 for t in np.linspace(truth.t_hi, 1, 200))


def obligations(rng, count):
    """Planes between single points in random motion, in every frame: what the bound must hold for,
    near its limits too.
    """
    for i in range(count):
        kA, kB = rng.normal(size=(2, 3))
        if i % 3 == 0:
            kB = kA * rng.choice([-1, 1])
        n = np.cross(kA, rng.normal(size=3)) if i % 2 else rng.normal(size=3)
        points = rng.normal(size=(2, 4, 3)) * rng.choice([0.1, 1], (2, 1, 1))
        place = rng.normal(size=3) * rng.choice([0, 1, 3])
        # Where B's point starts at A's centre, what it moves by is all there is of the arm.
        if i % 4 == 0:
            place = -points[1].mean(axis=0)
        motions = [
            Motion(
                rng.normal(size=3) * rng.choice([0, 1]),
                k,
                rng.uniform(-8, 8),
                rng.normal(size=3) * rng.choice([0, 0.5]),
            )
            for k in (kA, kB)
        ]
        bodies = [Body.convex(p) for p in points]
        query = Query("motion", *bodies, Pose(), Pose(position=place), *motions)
        with flint.ctx.workprec(BITS):
            pair = Pair(query)
        s, e = sorted(rng.uniform(0, 1, 2))
        frame = owed.FRAMES[i % 3]
        yield owed.Apart(
            pair, bodies[0].vertices, bodies[1].vertices, s, e, frame, n.tolist(), 0.0, False
        )


def second_derivatives(o) -> np.ndarray:
    """Largest |f''| over the interval for each vertex of Q, over all of P: by differences of the
    motion itself.
    """
    q, n, h = o.pair.query, np.array(o.n), 1e-4

    def turn(motion, t):
        return Motion(axis=motion.axis, angle=motion.angle).pose_at(Pose(), t).rotation

    def f(t):
        x = q.motion.pose_at(q.pose_a, t).apply(o.A)
        y = q.motion_b.pose_at(q.pose_b, t).apply(o.B)
        if o.frame == "W":
            return (y @ n)[None, :] - (x @ n)[:, None]
        if o.frame == "A":
            m = turn(q.motion, t) @ n
            return (y @ m)[None, :] - (x @ m)[:, None]
        m = turn(q.motion_b, t) @ n
        return (y @ m)[None, :] - (x @ m)[:, None]

    times = np.linspace(o.s, o.e, 25)
    bend = np.array([np.abs(f(t + h) - 2 * f(t) + f(t - h)) / h**2 for t in times]).max(axis=0)
    return bend.max(axis=0) if o.frame == "A" else bend.max(axis=1)


def shortfall(bounds, wanted) -> float:
    """By how much the bounds are too low, at worst, as a share."""
    return float(np.max((wanted - bounds) / (1e-3 + wanted)))


def by_balls(module, o):
    on_b = o.frame == "A"
    P, Q = (o.A, o.B) if on_b else (o.B, o.A)
    with flint.ctx.workprec(BITS):
        n, times = [number(c) for c in o.n], (number(o.s), number(o.e))
        bound = module._bend(o, n, times, P.tolist(), on_b)
        return np.array([float(module.arb(bound(module.vector(v)))) for v in Q.tolist()])


def by_doubles(module, o):
    N = float_filter.Numbers([o.pair])
    on_b, fixed = np.array([o.frame == "A"]), np.array([o.frame == "W"])
    P, Q = N.a.where(on_b, N.b), N.b.where(on_b, N.a)
    p, q = (o.A, o.B) if on_b[0] else (o.B, o.A)
    one = [np.array([x]) for x in (o.s, o.e, 1.0 if on_b[0] else -1.0)]
    sides = (p, np.array([0]), np.zeros(len(p), int)), (q, np.zeros(len(q), int))
    return module._bend(N, P, Q, np.array([o.n]), *one, fixed, *sides)


@pytest.mark.parametrize("arithmetic", ("proof", "float_filter"))
def test_the_second_derivative_never_exceeds_its_bound(arithmetic):
    bounds = by_balls if arithmetic == "proof" else by_doubles
    module = proof if arithmetic == "proof" else float_filter
    worst = max(
        shortfall(bounds(module, o), second_derivatives(o))
        for o in obligations(np.random.default_rng(30), 300)
    )
    assert worst < 1e-3


@pytest.mark.parametrize("name", MUTANTS)
@pytest.mark.parametrize("arithmetic", ("proof", "float_filter"))
def test_a_bound_that_forgets_that_b_turns_is_found_out(name, arithmetic):
    bounds = by_balls if arithmetic == "proof" else by_doubles
    broken = mutant(
        sys.modules[f"experiments.truth.check.{arithmetic}"], *MUTANTS[name][arithmetic]
    )
    worst = max(
        shortfall(bounds(broken, o), second_derivatives(o))
        for o in obligations(np.random.default_rng(30), 300)
    )
    assert worst > 0.05


@pytest.mark.parametrize("angles", ((1.0, -1.0), (0.5, -1.5), (1.0, -0.8)))
def test_a_false_plane_that_the_coriolis_mutant_accepts_is_refused(angles):
    """The two turn against each other about one axis. B's arm passes the plane that turns with A
    half way through the step.
    """
    of_a, of_b = angles
    normal = np.array([-np.cos(of_a / 2), np.sin(of_a / 2), 0.0])  # against B's arm at t = 1/2
    tiny = 1e-3 * np.array([(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)])
    a, b = Body.convex(tiny - 0.95 * normal), Body.convex(tiny + [1, 0, 0])
    pose_b = Pose([np.cos(of_b / 4), 0, 0, -np.sin(of_b / 4)])
    query = Query(
        "motion", a, b, Pose(), pose_b, *(Motion(axis=[0, 0, 1], angle=w) for w in angles)
    )
    broken = mutant(proof, *MUTANTS["Coriolis without B's rate"]["proof"])
    with flint.ctx.workprec(BITS):
        o = owed.Apart(
            Pair(query), a.vertices, b.vertices, 0.0, 1.0, "A", normal.tolist(), 0.0, False
        )
        assert _dips(o), "the plane is false"
        assert _holds(broken, o)
        assert not _holds(proof, o) and float_filter.settle([o])


def _holds(module, o) -> bool:
    try:
        module.apart(o)
        return True
    except module.Refused:
        return False


def _dips(o) -> bool:
    q, n = o.pair.query, np.array(o.n)
    for t in np.linspace(0, 1, 101):
        m = Motion(axis=q.motion.axis, angle=q.motion.angle).pose_at(Pose(), t).rotation @ n
        x, y = (
            mo.pose_at(p, t).apply(b.vertices)
            for mo, p, b in ((q.motion, q.pose_a, q.a), (q.motion_b, q.pose_b, q.b))
        )
        if (y @ m).min() - (x @ m).max() < -1e-6:
            return True
    return False


def test_balls_alone_agree_with_the_doubles():
    rng = np.random.default_rng(32)
    asked = []
    for _ in range(15):
        query = two_movers(rng)
        truth = label(query)
        asked.append((query, truth))
        if truth.gap > 0:
            asked += [(query, replace(truth, gap=truth.gap * (1 + x))) for x in (1e-12, 1e-3, 0.1)]
    assert [c.ok for c in check_many(asked)] == [c.ok for c in check_many(asked, doubles=False)]
