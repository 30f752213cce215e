# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Cells of concave bodies by size: closed meshes and unions, placed at gaps and depths."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pandas as pd
import trimesh

import ofg
from experiments.cases.placement import any_direction
from experiments.cases.scenario import snap
from experiments.run.progress import stage
from experiments.truth import label_many
from ofg import Body, Pose, Query

from . import saving
from .cell import Cell
from .classes import CLASSES, LIBRARIES, library
from .measuring import CELL, measure
from .page import builds, markdown, ordered, quotient, shown, title
from .summary import summary
from .synthetic import DISTANCES

OURS = "ofg-verified"
FACES = (80, 320, 1280, 5120, 20480)
PIECES = (2, 8, 64)
LARGE = 5120  # faces from which on there are a third of the pairs


SHAPES = {"bumpy": FACES, "torus": FACES, "pieces of 12": PIECES, "pieces of 80": PIECES}
CELLS = len(DISTANCES) * sum(map(len, SHAPES.values()))


def cells(cases: int, seed: int) -> Iterator[Cell]:
    """Pairs of bumpy spheres and of tori by their faces, and of unions of hulls of 12 and 80 faces
    by their pieces: CELLS. cases: pairs of a cell, each of its own bodies.
    """
    for kind, (shape, sizes) in enumerate(SHAPES.items()):
        for size in sizes:
            n = cases if size < LARGE else max(1, cases // 3)
            for place, (situation, span) in enumerate(DISTANCES.items()):
                rng = np.random.default_rng([seed, kind, size, place])
                queries = [_pair(rng, shape, size, *span) for _ in range(n)]
                yield _cell(shape, size, situation, queries)


def _cell(shape: str, size: int, situation: str, queries: list[Query]) -> Cell:
    labels = [truth.label for truth in label_many(queries)]
    names = [f"{i:04d}" for i in range(len(queries))]
    return Cell(shape, f"{size}", "overlap", situation, ("cold",), queries, labels, names)


def _pair(rng: np.random.Generator, shape: str, size: int, low: float, high: float) -> Query:
    """B at a distance from where it touches A along a direction; contact is found by bisection with
    what is timed, which places and judges nothing.
    """
    a, b = (_body(rng, shape, size) for _ in range(2))
    turns, way = [snap(rng.normal(size=4)) for _ in range(2)], any_direction(rng)
    near, far = 0.0, a.radius + b.radius
    for _ in range(40):
        middle = (near + far) / 2
        hit = ofg.verified(a, b, Pose(turns[0]), Pose(turns[1], way * middle)).hit
        near, far = (middle, far) if hit else (near, middle)
    gap = np.exp(rng.uniform(np.log(abs(low)), np.log(abs(high)))) * np.sign(low)
    return Query("overlap", a, b, Pose(turns[0]), Pose(turns[1], snap(way * (far + gap))))


def _body(rng: np.random.Generator, shape: str, size: int) -> Body:
    if shape == "torus":
        rings = round(np.sqrt(size * 5 / 4))
        mesh = trimesh.creation.torus(0.7, 0.3, rings, size // 2 // rings)
        return Body.mesh(snap(mesh.vertices), mesh.faces, shape)
    if shape == "bumpy":
        mesh = trimesh.creation.icosphere(subdivisions=round(np.log(size / 20) / np.log(4)))
        waves = np.sin(mesh.vertices @ rng.normal(0, 3, (3, 6)) + rng.uniform(0, 6, 6))
        return Body.mesh(snap(mesh.vertices * (1 + 0.05 * waves.sum(axis=1))[:, None]), mesh.faces)
    faces, pieces = int(shape.split()[-1]), []
    for _ in range(size):
        v = rng.normal(size=(faces // 2 + 2, 3))
        v *= rng.uniform(0.5, 0.9) / np.sqrt(size) / np.linalg.norm(v, axis=1)[:, None]
        pieces.append(Body.convex(snap(v + 0.75 * any_direction(rng))))
    return Body.union(pieces, shape)


def study(cases: int, rounds: int, seed: int, core: int | None, out: Path | None) -> None:
    """Measure, print the page, and write it into `out`, if that is given.

    NativeError where the lane is not built or fails.
    """
    made = saving.facts(asked=f"Concave bodies by size, labels certified, seed {seed}.")
    parts = []
    with stage("time in C++", CELLS) as advance:
        for cell in cells(cases, seed):
            parts.append(measure(cell, rounds, 2, core))
            advance(1)
    times, answers = (pd.concat([p[i] for p in parts], ignore_index=True) for i in (0, 1))
    rows = saving.small(summary(times, answers))
    noise = float(np.nanmax([p[2] for p in parts]))
    text = page(rows, [made["asked"], f"{rounds} rounds."])
    print(text)
    if out:
        saving.save(out, rows, text, made | {"noise": round(noise, 4), "rounds": rounds})


def page(rows: pd.DataFrame, facts: list[str]) -> str:
    """Markdown. rows: as `summary` gives them."""
    rows = ordered(rows).assign(single=False)
    lines = ["# Concave bodies", "", *facts, builds(rows), "", *LEGEND]
    for name in CLASSES:
        if (rows["class"] == name).any() and name != "AVX-512":
            lines += ["", f"## {title(name)}", "", markdown(overview(rows[rows["class"] == name]))]
    return "\n".join(lines) + "\n"


LEGEND = [
    (
        "Nanoseconds per query, net of the cost of an empty call and the clock: the median over"
        " rounds, then over pairs, each of its own bodies. Of a library its fastest configuration"
        " that takes the bodies, whether or not its answers are right; brackets give its wrong"
        " answers among the certified cases. Sizes: faces of each mesh, pieces of each union."
        f" Ratio: {OURS} over the fastest library, paired by query, with its 95 % bootstrap"
        " interval."
    )
]


def overview(rows: pd.DataFrame) -> pd.DataFrame:
    """A row per cell: verified OFG and each library."""
    made = []
    for key, cell in rows.groupby(CELL, sort=False, observed=True):
        own = cell[cell.engine == OURS]
        row = dict(zip(CELL, key)) | {OURS: shown(own, named=False)}
        for name in LIBRARIES.values():
            row[name] = shown(cell[cell.engine.map(library) == name])
        made.append(row | {"ratio": next((quotient(r) for _, r in own.iterrows()), "-")})
    return pd.DataFrame(made).drop(columns="question")
