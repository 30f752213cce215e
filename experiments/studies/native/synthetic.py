# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Cells by size: pairs of hulls, cubes and icospheres, placed at gaps and depths, and flown."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import trimesh

import ofg
from experiments.cases import shapes
from experiments.cases.placement import any_direction, touching
from experiments.cases.scenario import snap
from experiments.truth import label_many
from ofg import Body, Motion, Pose, Query

from .cell import BLOCK, Cell, unit_hull

FACES = (12, 80, 320, 1280)
#: of pairs of their own, as (how they are drawn, question). The order is part of the draws.
DRAWS = {
    "gap": "overlap",
    "shallow": "overlap",
    "translation": "translation",
    "deep": "overlap",
    "motion": "motion",
}
#: of many poses of one pair: distance along a direction in radii, drawn log-uniformly; the first
#: two come out of one stream of numbers, pair by pair
DISTANCES = {"gap": (1e-3, 1e-1), "shallow": (-1e-3, -3e-2), "deep": (-1e-1, -5e-1)}
LARGE = 1280  # faces from which on there are a quarter of the poses: engines take a millisecond
STEP = 0.002  # radii, and radians, from one pose of a trajectory to the next


def cells(cases: int, poses: int, seed: int) -> Iterator[Cell]:
    """Every synthetic cell.

    cases: pairs of a cold cell. poses: of a warm or coherent cell, a multiple of 4 blocks; a
    quarter of them from LARGE faces on.
    """
    for faces in FACES:
        for situation in DRAWS:
            yield cold(faces, situation, cases, seed)
    yield from warm(poses, seed)
    for faces in FACES:
        for situation in ("gap", "contact"):
            yield coherent(faces, situation, poses if faces < LARGE else poses // 4, seed)


def cold(faces: int, situation: str, n: int, seed: int) -> Cell:
    """n pairs of random hulls, every body another, which no cache holds when it is asked about.

    Gap: 1e-3 to 1e-1 of the radius apart along a contact normal. Shallow: 1e-3 to 3e-2 deep; deep:
    0.1 to 0.3. Translation: 0.5 to 2 apart, about to fly into each other. Motion: turning, too.
    """
    rng = np.random.default_rng([seed, faces, list(DRAWS).index(situation)])
    queries = [_pair(rng, faces, situation, i) for i in range(n)]
    return _cell("hull", faces, situation, ("cold",), queries, 1)


def _pair(rng: np.random.Generator, faces: int, situation: str, i: int) -> Query:
    a, b = shapes.hull(faces, 2 * i), shapes.hull(faces, 2 * i + 1)
    gap = {
        "gap": lambda: 10 ** rng.uniform(-3, -1),
        "shallow": lambda: -(10 ** rng.uniform(-3, -1.5)),
        "deep": lambda: -(10 ** rng.uniform(-1, -0.5)),
    }.get(situation, lambda: rng.uniform(0.5, 2))()
    turn, position, normal = touching(rng, a, b, gap)
    motion = Motion()
    if DRAWS[situation] != "overlap":
        way = snap(-(gap + rng.uniform(0.1, 0.5)) * normal + 0.2 * any_direction(rng))
        angle = rng.uniform(0.1, 1.5) if situation == "motion" else 0.0
        motion = Motion(way, any_direction(rng) if angle else (0, 0, 1), angle)
    return Query(DRAWS[situation], a, b, Pose(turn, snap(position)), Pose(), motion)


def bodies(rng: np.random.Generator) -> dict[str, tuple[Body, Body]]:
    """Pairs by shape and faces: cubes, icospheres and random hulls of 12 to 5,120 faces."""
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
    cube = Body.convex(corners / np.sqrt(3))
    ico = {
        20 * 4**i: Body.from_trimesh(trimesh.creation.icosphere(subdivisions=i))
        for i in (1, 2, 3, 4)
    }
    pairs = {"cube 12": (cube, cube), "hull 12": (unit_hull(rng, 12), unit_hull(rng, 12))}
    for faces in (80, 320, 1280, 5120):
        pairs[f"hull {faces}"] = unit_hull(rng, faces), unit_hull(rng, faces)
        pairs[f"ico {faces}"] = ico[faces], ico[faces]
    return pairs


def warm(poses: int, seed: int) -> Iterator[Cell]:
    """Many poses of one pair of each of `bodies`, which are in the caches: call by call, in one."""
    rng, deep = np.random.default_rng(seed), np.random.default_rng([seed, 1])
    for name, (a, b) in bodies(rng).items():
        n = poses if len(a.faces) < LARGE else poses // 4
        for situation, distances in DISTANCES.items():
            stream = deep if situation == "deep" else rng
            yield posed(stream, name, a, b, situation, distances, n, _meet)


def posed(rng, name: str, a: Body, b: Body, situation: str, distances, n: int, meet) -> Cell:
    """The cell of n poses of a pair at distances within two bounds. meet: as _poses."""
    placed = _poses(rng, a, b, *distances, n, meet)
    queries = [Query("overlap", a, b, Pose(p[:4], p[4:7]), Pose(p[7:11], p[11:])) for p in placed]
    shape, faces = name.split()
    return _cell(shape, int(faces), situation, ("warm", "batch"), queries, _block(n))


def _meet(a: Body, b: Body, poses_a: np.ndarray, poses_b: np.ndarray) -> np.ndarray:
    """Which of the pairs meet, by OFG in full."""
    return ofg.discrete_many(a, b, poses_a, poses_b, adaptive_k=True, containment=True).hit


def _poses(rng, a: Body, b: Body, low: float, high: float, n: int, meet) -> np.ndarray:
    """(n, 14): random orientations and directions, B at a distance along the direction.

    meet(a, b, poses_a, poses_b): which pairs meet. By it contact along the direction is found by
    bisection: it places, and judges nothing.
    """
    pa, pb = (np.column_stack([rng.normal(size=(n, 4)), np.zeros((n, 3))]) for _ in range(2))
    d = rng.normal(size=(n, 3))
    d /= np.linalg.norm(d, axis=1)[:, None]
    near, far = np.zeros(n), np.full(n, 2.01 * (a.radius + b.radius) / 2)
    for _ in range(40):
        middle = (near + far) / 2
        pb[:, 4:] = d * middle[:, None]
        hit = meet(a, b, pa, pb)
        near, far = np.where(hit, middle, near), np.where(hit, far, middle)
    gap = np.exp(rng.uniform(np.log(abs(low)), np.log(abs(high)), n)) * np.sign(low)
    pb[:, 4:] = d * (far + gap)[:, None]
    return np.hstack([pa, pb])


def coherent(faces: int, situation: str, poses: int, seed: int) -> Cell:
    """Trajectories of small steps: A turns and drifts along B, one block each.

    Gap: from 0.03 to 0.1 radii apart. Contact: from as far apart into B, and out again.
    """
    rng = np.random.default_rng([seed, faces, len(situation)])
    length = _block(poses)
    a, b = shapes.hull(faces, 0), shapes.hull(faces, 1)
    queries = []
    for _ in range(poses // length):
        turn, position, normal = touching(rng, a, b, rng.uniform(0.03, 0.1))
        axis, drift = any_direction(rng), any_direction(rng)
        drift -= (drift @ normal) * normal
        step = Motion(drift * STEP * length, axis, STEP * length)
        start = Pose(turn, position)
        for t in np.arange(length) / length:
            pose = step.pose_at(start, t)
            inward = 0.15 * np.sin(np.pi * t) * normal if situation == "contact" else 0
            at = Pose(pose.quaternion, pose.position - inward)
            queries.append(Query("overlap", a, b, at, Pose()))
    return _cell("hull", faces, situation, ("coherent",), queries, length)


def _block(poses: int) -> int:
    """Blocks are of BLOCK poses, or smaller where that leaves fewer than eight."""
    return min(BLOCK, max(1, poses // 8))


def _cell(shape, faces: int, situation: str, modes, queries: list[Query], block: int) -> Cell:
    labels = [truth.label for truth in label_many(queries)]
    names = [f"{i:04d}" for i in range(len(queries))]
    question = queries[0].question
    return Cell(shape, f"{faces}", question, situation, modes, queries, labels, names, block)
