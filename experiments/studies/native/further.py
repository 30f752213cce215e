# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Warm cells beyond those of synthetic.py, from streams of numbers of their own: bodies of 20,480
faces, by which growth is fitted, and pairs that are farther apart.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import trimesh

import ofg
from ofg import Body

from . import synthetic
from .cell import Cell, unit_hull
from .synthetic import DISTANCES, LARGE

HUGE = 20480  # faces from which on there are a sixteenth of the poses
APART = (0.3, 3.0)  #: distance along a direction, in radii, drawn log-uniformly
FEWEST = 320  #: faces, from which on pairs are asked farther apart


def cells(poses: int, seed: int) -> Iterator[Cell]:
    """Bodies of HUGE faces at each of DISTANCES, and all from FEWEST faces on at APART.

    poses: as of synthetic.cells.
    """
    pairs = synthetic.bodies(np.random.default_rng(seed))
    large = huge(np.random.default_rng([seed, 2]))
    for name, (a, b) in large.items():
        for at, (situation, distances) in enumerate(DISTANCES.items()):
            rng = np.random.default_rng([seed, 3, at, len(name)])
            yield _cell(rng, name, a, b, situation, distances, poses)
    for name, (a, b) in (pairs | large).items():
        if len(a.faces) >= FEWEST:
            rng = np.random.default_rng([seed, 4, len(a.faces), len(name)])
            yield _cell(rng, name, a, b, "apart", APART, poses)


def huge(rng: np.random.Generator) -> dict[str, tuple[Body, Body]]:
    """Pairs of HUGE faces: random hulls, and an icosphere with itself."""
    ico = Body.from_trimesh(trimesh.creation.icosphere(subdivisions=5))
    hulls = unit_hull(rng, HUGE), unit_hull(rng, HUGE)
    return {f"hull {HUGE}": hulls, f"ico {HUGE}": (ico, ico)}


def _cell(rng, name: str, a: Body, b: Body, situation: str, distances, poses: int) -> Cell:
    faces = len(a.faces)
    n = poses // 16 if faces >= HUGE else poses // 4 if faces >= LARGE else poses
    return synthetic.posed(rng, name, a, b, situation, distances, max(n, 1), _meet)


def _meet(a: Body, b: Body, poses_a: np.ndarray, poses_b: np.ndarray) -> np.ndarray:
    return ofg.verified_many(a, b, poses_a, poses_b).hit
