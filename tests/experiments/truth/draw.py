# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Random cases and queries for the tests of the truth."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import trimesh

from ofg import Body, Motion, Pose, Query


def single(x):
    return np.float32(x).astype(np.float64)


def hull(rng, n=12, scale=1.0) -> Body:
    return Body.convex(single(rng.normal(size=(n, 3)) * scale), "hull")


def convex_query(rng, question: str, a: Body | None = None, b: Body | None = None) -> Query:
    a, b = (
        a or hull(rng, int(rng.integers(4, 30))),
        b or hull(rng, int(rng.integers(4, 30)), rng.choice([0.1, 1.0])),
    )
    away = rng.normal(size=3)
    away /= np.linalg.norm(away)
    reach = a.radius + b.radius
    pose_b = Pose(single(rng.normal(size=4)), single(away * rng.uniform(0.2, 1.3) * reach))
    pose_a = Pose(single(rng.normal(size=4)), single(rng.normal(size=3) * 0.1))
    motion = Motion()
    if question != "overlap":
        angle = float(np.float32(rng.uniform(-6, 6))) if question == "motion" else 0.0
        motion = Motion(
            single((away + 0.3 * rng.normal(size=3)) * rng.uniform(0.2, 3) * reach),
            single(rng.normal(size=3)),
            angle,
        )
    return Query(question, a, b, pose_a, pose_b, motion)


def two_movers(rng) -> Query:
    """Both bodies translate and turn, about any of their points; about three in four of them
    meet.
    """
    q = convex_query(rng, "motion")

    def motion(displacement):
        about = single(0.3 * rng.normal(size=3)) if rng.random() < 0.3 else np.zeros(3)
        return Motion(
            displacement, single(rng.normal(size=3)), float(single(rng.uniform(-6, 6))), about
        )

    return replace(
        q, motion=motion(q.motion.displacement), motion_b=motion(single(0.5 * rng.normal(size=3)))
    )


def moved_together(q: Query, half_turn: int) -> Query:
    """Both bodies carried by one rigid motion that doubles hold exactly: a half turn about an axis
    and an integer shift.
    """
    h = np.zeros(4)
    h[1 + half_turn] = 1.0
    shift = np.array([3.0, -5.0, 7.0])
    flip = np.where(np.arange(3) == half_turn, 1.0, -1.0)

    def move(pose):
        w, x, y, z = pose.quaternion
        v = np.array([x, y, z])
        u = h[1:]
        return Pose(
            np.concatenate([[-u @ v], w * u + np.cross(u, v)]), flip * pose.position + shift
        )

    motions = [
        Motion(flip * m.displacement, flip * m.axis, m.angle, m.about)
        for m in (q.motion, q.motion_b)
    ]
    return replace(
        q, pose_a=move(q.pose_a), pose_b=move(q.pose_b), motion=motions[0], motion_b=motions[1]
    )


def scaled(q: Query, power: int) -> Query:
    """Every length times 2**power, exactly."""
    f = 2.0**power
    a, b = (Body.unchecked("convex", x.vertices * f, x.faces, (), x.name) for x in (q.a, q.b))
    pose_a, pose_b = (Pose(p.quaternion, p.position * f) for p in (q.pose_a, q.pose_b))
    motions = [
        Motion(m.displacement * f, m.axis, m.angle, m.about * f) for m in (q.motion, q.motion_b)
    ]
    return Query(q.question, a, b, pose_a, pose_b, *motions)


def reversed_in_time(q: Query) -> Query:
    """The motion run backwards from its end pose (rounded to double where it turns)."""
    motions = [Motion(-m.displacement, m.axis, -m.angle, m.about) for m in (q.motion, q.motion_b)]
    ends = q.motion.pose_at(q.pose_a, 1.0), q.motion_b.pose_at(q.pose_b, 1.0)
    return replace(q, pose_a=ends[0], pose_b=ends[1], motion=motions[0], motion_b=motions[1])


def composite_query(rng, question: str) -> Query:
    """Unions, closed concave meshes and hulls against each other, near enough to hit about as often
    as not.
    """

    def body():
        kind = rng.integers(3)
        if kind == 0:
            return hull(rng, 10)
        if kind == 1:
            return Body.union(
                [
                    Body.convex(single(rng.normal(size=(8, 3)) * 0.4 + rng.normal(size=3)))
                    for _ in range(4)
                ],
                "union",
            )
        torus = trimesh.creation.torus(1.0, 0.35, major_sections=10, minor_sections=6)
        return Body.mesh(single(torus.vertices), torus.faces, "torus")

    return convex_query(rng, question, body(), body())
