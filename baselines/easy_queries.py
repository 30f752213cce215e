# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Easy queries: bodies and poses about which every method that answers must be right."""

from __future__ import annotations

import itertools

import numpy as np

from ofg import Body, Motion, Pose, Query

KINDS = ("convex", "union", "mesh")


def box(*half: float, at=(0, 0, 0), name: str = "box") -> Body:
    """A box of these half-extents."""
    return Body.convex(np.array(list(itertools.product(*((-h, h) for h in half)))) + at, name)


def body(kind: str, half: float = 1.0) -> Body:
    """A cube of one kind."""
    cube = box(half, half, half, name=f"cube {kind}")
    if kind == "mesh":
        return Body.mesh(cube.vertices, cube.faces, cube.name)
    if kind == "union":
        return Body.union(
            [box(half / 2, half, half, at=(s * half / 2, 0, 0)) for s in (-1, 1)], cube.name
        )
    return cube


def bar(kind: str) -> Body:
    """A bar of length 6 along x."""
    made = box(3, 0.4, 0.4, name="bar")
    if kind == "mesh":
        return Body.mesh(made.vertices, made.faces)
    return Body.union([made]) if kind == "union" else made


def hooked(kind: str) -> Body:
    """An L in the xy plane: arms of width 1 and length 3 from the corner (0, 0); the notch is 1
    < x, y < 3.
    """
    if kind == "union":
        return Body.union(
            [box(1.5, 0.5, 0.5, at=(1.5, 0.5, 0)), box(0.5, 1, 0.5, at=(0.5, 2, 0))], "L"
        )
    outline = np.array([(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)], float)
    v = np.concatenate([np.c_[outline, np.full(6, z)] for z in (-0.5, 0.5)])
    cap = np.array([(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 5)])
    wall = [
        t
        for i in range(6)
        for t in ((i, (i + 1) % 6, (i + 1) % 6 + 6), (i, (i + 1) % 6 + 6, i + 6))
    ]
    return Body.mesh(v, np.concatenate([cap[:, ::-1], cap + 6, wall]), "L")


TURNED = Pose((0.9, 0.2, -0.3, 0.25), (0, 0, 0))
SWEEP = Motion((8, 0, 0))


def overlap(kind: str, offset, half: float = 1.0) -> Query:
    return Query("overlap", body(kind, half), body(kind), Pose(TURNED.quaternion, offset), Pose())


def sweep(question: str, kind: str, start, displacement, half: float = 1.0) -> Query:
    return Query(
        question, body(kind, half), body(kind), Pose(position=start), Pose(), Motion(displacement)
    )
