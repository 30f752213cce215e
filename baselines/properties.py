# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Properties required of every method.

Each is a function of the method that yields a sentence for each fault. They pose easy queries only:
accuracy on hard ones is measured, not required.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ofg import QUESTIONS, Motion, Pose, Query

from .contract import Method, Tolerance, Unsupported, Verdict
from .easy_queries import KINDS, bar, body, hooked, overlap, sweep
from .frames import product

CONFIGURATIONS = ("default", "best effort", "alternative", "article")
UNDECLARED_TIME_ERROR = 0.05  #: bound applied to a head-on sweep if a method documents none


def asked(method: Method, query: Query) -> Verdict:
    return method.ready(query)()


def kinds(method: Method, question: str = "overlap") -> list[str]:
    return [k for k in KINDS if k in method.kinds(question)]


def sweeps(method: Method) -> list[tuple[str, str]]:
    return [(q, k) for q in QUESTIONS[1:] if q in method.questions for k in kinds(method, q)]


def easy(method: Method) -> list[tuple[str, Query, bool]]:
    """(description, query, whether the surfaces intersect) of everything that the method
    declares to answer.
    """
    queries = []
    for kind in kinds(method) if "overlap" in method.questions else ():
        queries.append((f"overlap of {kind} bodies far apart", overlap(kind, (7, 1, 2)), False))
        queries.append(
            (
                f"overlap of {kind} bodies 0.25 apart",
                Query("overlap", body(kind), body(kind), Pose(position=(2.25, 0.5, 0.25))),
                False,
            )
        )
        queries.append(
            (
                f"overlap of {kind} bodies that penetrate deeply",
                overlap(kind, (0.9, 0.7, 0.5)),
                True,
            )
        )
    for question, kind in sweeps(method):
        queries.append(
            (
                f"{question} of {kind} bodies, passing at a distance of 0.5",
                sweep(question, kind, (-4, 2.5, 0), (8, 0, 0)),
                False,
            )
        )
        queries.append(
            (
                f"{question} of {kind} bodies, moving away",
                sweep(question, kind, (-3, 0.1, 0.2), (-8, 0, 0)),
                False,
            )
        )
    return queries


def declaration(method: Method) -> Iterator[str]:
    for field in ("name", "engine", "imports", "guarantee"):
        if not isinstance(getattr(method, field, None), str) or not getattr(method, field).strip():
            yield f"{field} must be a string, not {getattr(method, field, None)!r}"
    if " " in method.name or method.name != method.name.lower():
        yield f"name '{method.name}' must be lower case without spaces"
    if method.configuration not in CONFIGURATIONS:
        yield f"configuration '{method.configuration}' must be one of {', '.join(CONFIGURATIONS)}"
    if not method.questions or not method.questions <= set(QUESTIONS):
        yield f"questions {set(method.questions)} must be some of {', '.join(QUESTIONS)}"
    if not method.bodies or not method.bodies <= set(KINDS):
        yield f"bodies {set(method.bodies)} must be some of {', '.join(KINDS)}"
    if not isinstance(method.solid, bool):
        yield "solid must be True or False"
    if method.precision not in ("double", "single"):
        yield f"precision '{method.precision}' must be double or single"
    if not isinstance(method.tolerance, Tolerance):
        yield f"tolerance {method.tolerance!r} must be a baselines.contract.Tolerance"
    if any(" " in str(v) or "," in str(v) for v in method.parameters.values()):
        yield "a parameter's value contains a space or a comma, so the label cannot be parsed"


def far_and_near(method: Method) -> Iterator[str]:
    for what, query, hit in easy(method):
        verdict = asked(method, query)
        if verdict.hit != hit:
            yield f"{what}: answered {_word(verdict)}"


def contained(method: Method) -> Iterator[str]:
    """A cube well inside another, at rest or moving a little: a solid method detects it, a surface
    method does not.

    It stays on one side of x = 0, where the pieces of a union meet in an inner wall that a surface
    method does detect.
    """
    queries = [
        (f"overlap, {k}", Query("overlap", body(k, 0.25), body(k), Pose(position=(0.3, 0.1, 0.3))))
        for k in kinds(method)
        if "overlap" in method.questions
    ]
    queries += [
        (f"{q}, {k}", sweep(q, k, (0.3, 0.1, 0.3), (0.3, 0, 0), half=0.25))
        for q, k in sweeps(method)
    ]
    for what, query in queries:
        verdict = asked(method, query)
        if method.solid and not verdict.hit:
            yield f"{what}: declared solid, but a contained body is not detected"
        if not method.solid and verdict.hit:
            yield f"{what}: declared a surface method, but a contained body is detected"


def notch(method: Method) -> Iterator[str]:
    """A small cube in the notch of an L: inside its hull, outside its solid."""
    for kind in kinds(method):
        if kind == "convex" or "overlap" not in method.questions:
            continue
        for at, hit in (((1.75, 1.75, 0), False), ((0.9, 2, 0), True)):
            if (
                asked(
                    method, Query("overlap", body(kind, 0.3), hooked(kind), Pose(position=at))
                ).hit
                != hit
            ):
                yield (
                    f"{kind}: a cube {'across the arm' if hit else 'in the notch'} of an L is "
                    f"reported as {'clear' if hit else 'a hit'}"
                )


def beyond_tolerance(method: Method) -> Iterator[str]:
    """Cubes separated by the declared tolerance plus 0.002 are clear."""
    allowed = (
        float(method.tolerance.reach(body("convex").size, 0.0))
        if method.tolerance.covers("alarms")
        else 0.0
    )
    gap = allowed + 0.002
    for kind in kinds(method):
        if (
            "overlap" in method.questions
            and asked(
                method, Query("overlap", body(kind), body(kind), Pose(position=(2 + gap, 0.3, 0.2)))
            ).hit
        ):
            yield (
                f"{kind}: cubes {gap:g} apart are reported as a hit, but the declared tolerance "
                f"is {method.tolerance}"
            )


def head_on(method: Method) -> Iterator[str]:
    """A cube that passes through another, hitting it at t = 0.3, then one that stops inside it;
    three lateral offsets.
    """
    for (question, kind), side, far in itertools.product(
        sweeps(method), (0.0, 0.3, 0.7), (10.0, 5.0)
    ):
        verdict = asked(method, sweep(question, kind, (-5, side, side / 2), (far, 0, 0)))
        exact = 3 / far
        fault = _time_fault(method, verdict, exact) if verdict.hit else "missed"
        # A method that tests only the end pose may miss the pass through.
        if fault and not (_blind(method, 0.4) and not verdict.hit):
            yield f"{question}, {kind}, offset {side}, hits at {exact:g}: {fault}"


def _time_fault(method: Method, verdict: Verdict, exact: float) -> str:
    if not method.gives_time:
        return (
            ""
            if math.isnan(verdict.time)
            else f"gives the time {verdict.time}, but declares no times"
        )
    bound = UNDECLARED_TIME_ERROR if math.isnan(method.time_error) else method.time_error
    if not 0 <= verdict.time <= 1:
        return f"time {verdict.time} is not in [0, 1]"
    off = verdict.time - exact
    return (
        ""
        if abs(off) <= bound + 1e-6
        else f"time {verdict.time:.6g} is off by {off:+.2g}, more than {bound:.2g}"
    )


def same_again(method: Method) -> Iterator[str]:
    """The same callable twice, after others, and prepared again: one answer."""
    queries = [query for _, query, _ in easy(method)] + [
        sweep(q, k, (-5, 0.3, 0.1), (10, 0, 0)) for q, k in sweeps(method)
    ]
    calls = [method.ready(query) for query in queries]
    first = [call() for call in calls]
    for what, again in (
        ("repeated in reverse order", [call() for call in reversed(calls)][::-1]),
        ("prepared again", [asked(method, query) for query in queries]),
        ("repeated after others were prepared", [call() for call in calls]),
    ):
        for query, a, b in zip(queries, first, again):
            if repr(a) != repr(b):
                yield f"{query.question} {what}: first {_word(a)}, then {_word(b)}"


def moved_together(method: Method) -> Iterator[str]:
    """Rotating and moving the whole query changes no verdict."""
    frame = Pose((0.8, 0.1, 0.5, -0.3), (3, -2, 1))

    def moved(pose: Pose) -> Pose:
        return Pose(product(frame.quaternion, pose.quaternion), frame.apply(pose.position[None])[0])

    for what, query, hit in easy(method):
        poses = {"pose_a": moved(query.pose_a), "pose_b": moved(query.pose_b)}
        motion = Motion(frame.rotation @ query.motion.displacement)
        verdict = asked(method, replace(query, **poses, motion=motion))
        if verdict.hit != hit:
            yield f"{what}, moved together: answered {_word(verdict)}"


def refuses(method: Method) -> Iterator[str]:
    for question, kind in itertools.product(QUESTIONS, KINDS):
        if question in method.questions and kind in method.kinds(question):
            continue
        query = (
            overlap(kind, (3, 0, 0))
            if question == "overlap"
            else sweep(question, kind, (-5, 0, 0), (1, 0, 0))
        )
        try:
            method.prepare(query)
            yield (
                f"{question} of {kind} bodies is not declared, but prepare does not raise"
                " Unsupported"
            )
        except Unsupported as refusal:
            if not str(refusal).strip():
                yield f"{question} of {kind} bodies: Unsupported without a reason"


def translation_is_motion(method: Method) -> Iterator[str]:
    if not {"translation", "motion"} <= set(method.questions):
        return
    for kind, side in itertools.product(kinds(method, "motion"), (0.2, 2.5)):
        a, b = (
            asked(method, sweep(q, kind, (-5, side, 0.1), (10, 0, 0)))
            for q in ("translation", "motion")
        )
        if a.hit != b.hit or (a.hit and method.gives_time and abs(a.time - b.time) > 1e-3):
            yield (
                f"{kind}, offset {side}: translation is {_word(a)}, the same as a motion with angle"
                f" 0 is {_word(b)}"
            )


def turns(method: Method) -> Iterator[str]:
    """A bar of length 6 that rotates in place by 170 degrees hits a cube beside its path; the
    same bar at rest misses it.
    """
    if "motion" not in method.questions:
        return
    for kind in kinds(method, "motion"):
        for angle, hit in ((math.radians(170), True), (0.0, False)):
            at, motion = Pose(position=(0, 2, 0)), Motion((0, 0, 0.01), (0, 0, 1), angle)
            verdict = asked(method, Query("motion", bar(kind), body(kind, 0.4), Pose(), at, motion))
            if verdict.hit != hit and not _blind(method, 0.1):
                yield (
                    f"{kind}: a bar rotating by {math.degrees(angle):.0f} degrees "
                    f"{'into' if hit else 'beside'} a cube: {_word(verdict)}"
                )


def both_translate(method: Method) -> Iterator[str]:
    """Cubes that meet at t = 0.3 at their combined speed, and cubes that move side by side."""
    for (question, kind), far_b in itertools.product(sweeps(method), (-5.0, -10.0, 10.0)):
        query = sweep(question, kind, (-5, 0.3, 0.15), (10 + far_b, 0, 0))
        verdict = _unless_refused(method, replace(query, motion_b=Motion((far_b, 0, 0))))
        if verdict and (fault := _time_fault(method, verdict, 0.3) if verdict.hit else "missed"):
            if verdict.hit or not _blind(method, 0.4):
                yield f"{question}, {kind}, B moves by {far_b:g}, hits at 0.3: {fault}"
        along = sweep(question, kind, (-5, 0.3, 0.15), (far_b, 0, 0))
        verdict = _unless_refused(method, replace(along, motion_b=along.motion))
        if verdict and verdict.hit:
            yield f"{question}, {kind}, side by side by {far_b:g}: answered {_word(verdict)}"


def b_turns(method: Method) -> Iterator[str]:
    """A bar as B that rotates by 60 degrees past a cube, which rests or rotates in place."""
    at = Pose(position=(2.25, 1.3, 0))
    for kind, spin in itertools.product(_turned_kinds(method), (0.0, 1.0)):
        for angle, hit in ((math.pi / 3, True), (0.0, False)):
            motions = Motion(angle=spin), Motion((0, 0, 0.01), angle=angle)
            query = Query("motion", body(kind, 0.4), bar(kind), at, Pose(), *motions)
            what = f"{kind}, A rotates by {spin:g}, B by {angle:g}"
            yield from _turn_fault(method, what, query, hit)


def turn_together(method: Method) -> Iterator[str]:
    """A bar and a cube rotate together about the bar's centre: they never meet."""
    at, turn = np.array([2.25, 1.3, 0]), math.pi / 3
    for kind in _turned_kinds(method):
        motions = Motion(angle=turn), Motion(angle=turn, about=-at)
        query = Query("motion", bar(kind), body(kind, 0.4), Pose(), Pose(position=at), *motions)
        yield from _turn_fault(method, f"{kind}, as one body", query, False)
        yield from _turn_fault(method, f"{kind}, as one body, exchanged", query.swapped(), False)


def about_a_point(method: Method) -> Iterator[str]:
    """A bar rotates about a point ten lengths away, which carries it through a cube; and about
    its centre.
    """
    for kind, (about, hit) in itertools.product(_turned_kinds(method), ((-10, True), (0, False))):
        motion = Motion(angle=0.3, about=(about, 0, 0))
        at, where = Pose(position=(0.5, 1.5, 0)), f"rotates about ({about}, 0, 0)"
        query = Query("motion", bar(kind), body(kind, 0.4), Pose(), at, motion)
        yield from _turn_fault(method, f"{kind}, A {where}", query, hit)
        yield from _turn_fault(method, f"{kind}, B {where}", query.swapped(), hit)


def _turn_fault(method: Method, what: str, query: Query, hit: bool) -> Iterator[str]:
    verdict = _unless_refused(method, query)
    if verdict and verdict.hit != hit and not _blind(method, 0.1):
        yield f"{what}: answered {_word(verdict)}"


def _unless_refused(method: Method, query: Query) -> Verdict | None:
    try:
        return asked(method, query)
    except Unsupported:
        return None


def _blind(method: Method, longest: float) -> bool:
    """Whether the method samples times that are further apart than this share of the step."""
    return not math.isnan(method.time_error) and method.time_error > longest


def _turned_kinds(method: Method) -> list[str]:
    return kinds(method, "motion") if "motion" in method.questions else []


def _word(verdict: Verdict) -> str:
    return (
        f"hit at {verdict.time:.6g}"
        if verdict.hit and not math.isnan(verdict.time)
        else "hit"
        if verdict.hit
        else "clear"
    )
