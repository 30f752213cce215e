# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Misses and operations by size, depth and k, which no run of the catalogue covers: python -m
experiments.studies.sizes [--cases 400]

Pairs of random hulls of 12 to 5,120 faces. Certified overlaps at a shallow and at a large depth:
the misses of each k, and the operations counted. Flights of the same hulls, with and without
rotation: operations only. The rows go to results/sizes.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated

import numpy as np
import pandas as pd
import typer

import ofg
from experiments.analysis import metrics
from experiments.cases import shapes
from experiments.cases.placement import any_direction, touching
from experiments.cases.scenario import snap
from experiments.run.folder import manifest
from experiments.run.folder.store import Store
from experiments.run.progress import stage
from experiments.truth import label
from ofg import Motion, Pose, Query

FACES = (12, 80, 320, 1280, 5120)
KS = (4, 8, 16, 64)
DEPTHS = {"shallow": (1e-3, 3e-2), "deep": (0.1, 1.0)}  #: of B's radius, log-uniform
COUNTED = ("distances", "face_pairs", "edge_faces", "full_tests", "evaluated")


def hulls(faces: int, i: int) -> tuple[ofg.Body, ofg.Body]:
    return shapes.hull(faces, 2 * (i % 8)), shapes.hull(faces, 2 * (i % 8) + 1)


def overlaps(
    faces: int, low: float, high: float, n: int, rng: np.random.Generator
) -> Iterator[Query]:
    """Pairs placed by contact feature at a depth of low to high; only certified overlaps."""
    for i in range(n):
        a, b = hulls(faces, i)
        turn, position, _ = touching(rng, a, b, -np.exp(rng.uniform(np.log(low), np.log(high))))
        query = Query("overlap", a, b, Pose(snap(turn), snap(position)), Pose())
        if label(query).label == "hit":
            yield query


def flights(question: str, faces: int, n: int, rng: np.random.Generator) -> Iterator[Query]:
    """A starts a radius away and moves two radii towards a feature of B, or in any direction; a
    rotation is one radian.
    """
    for i in range(n):
        a, b = hulls(faces, i)
        turn, position, normal = touching(rng, a, b, 1.0)
        path = -2.0 * (normal if i % 2 else any_direction(rng))
        motion = (
            Motion(snap(path), any_direction(rng), 1.0)
            if question == "motion"
            else Motion(snap(path))
        )
        yield Query(question, a, b, Pose(snap(turn), snap(position)), Pose(), motion)


def ask(query: Query, faces: int, depth: str, case: int) -> Iterator[dict]:
    """A row for each k below the number of faces, for k = all faces, and for all repairs."""
    variants = [{"k": k} for k in (*(k for k in KS if k < faces), faces)] + [{"repairs": "all"}]
    for options in variants:
        answer = ofg.ask(query, **options)
        yield {
            "question": query.question,
            "faces": faces,
            "depth": depth,
            "case": case,
            "k": options.get("k", 0),
            "repairs": "repairs" in options,
            "hit": answer.hit,
            **{name: answer.counts[name] for name in COUNTED},
        }


def measure(cases: int, seed: int) -> pd.DataFrame:
    """All rows. k is 0 if it is adaptive (repairs)."""
    rng, rows = np.random.default_rng(seed), []
    with stage("query hulls of each size", len(FACES)) as advance:
        for faces in FACES:
            n = cases if faces < 5120 else max(cases // 4, 1)  # a label takes longer there
            for depth, (low, high) in DEPTHS.items():
                for i, query in enumerate(overlaps(faces, low, high, n, rng)):
                    rows += ask(query, faces, depth, i)
            for question in ("translation", "motion"):
                for i, query in enumerate(flights(question, faces, max(n // 4, 1), rng)):
                    rows += ask(query, faces, "", i)
            advance(1)
    return pd.DataFrame(rows)


def misses(rows: pd.DataFrame) -> pd.DataFrame:
    """Misses of certified overlaps by faces, depth and k, with Wilson intervals."""
    part = rows[rows.question == "overlap"]
    counts = (
        part.groupby(["faces", "depth", "k", "repairs"], sort=False)
        .hit.agg(hits="size", misses=lambda h: int((~h).sum()))
        .reset_index()
    )
    counts["miss_low"], counts["miss_high"] = zip(
        *[metrics.wilson(m, n) for m, n in zip(counts.misses, counts.hits)]
    )
    return counts


def operations(rows: pd.DataFrame) -> pd.DataFrame:
    """Operations of the article, by question, faces and k: the largest and the mean share of
    each of the article's bounds.
    """
    part = rows[~rows.repairs]
    shares = part[["question", "faces", "k"]].assign(
        distances=part.distances / (2 * part.faces),
        evaluated=part.evaluated / (2 * part.faces),
        pairs=part.face_pairs / part.k**2,
        after_selection=(part.face_pairs + part.edge_faces) / (part.k**2 + 3 * part.k),
        full_tests=part.full_tests / part.k**2,
    )
    named = {f"{name}_{how}": (name, how) for name in shares.columns[3:] for how in ("mean", "max")}
    return (
        shares.groupby(["question", "faces", "k"], sort=False)
        .agg(queries=("k", "size"), **named)
        .reset_index()
    )


def save(rows: pd.DataFrame, made: dict, folder: Path) -> None:
    store = Store(folder)
    store.write(rows, "sizes.parquet")
    store.write_text(json.dumps(made, indent=1) + "\n", "made.json")
    for name, table in (("misses", misses(rows)), ("operations", operations(rows))):
        store.write_text(
            table.to_csv(index=False, float_format="%.6g", lineterminator="\n"),
            "tables",
            f"{name}.csv",
        )
        store.write_text(
            table.to_markdown(index=False, floatfmt=".3g") + "\n", "tables", f"{name}.md"
        )


def run(folder: Path, cases: int = 400, seed: int = 2004) -> None:
    """Measure into the folder, unless it is done."""
    if not (folder / "sizes.parquet").exists():
        made = {
            "started": manifest.now(),
            "commit": manifest.commit(),
            "build": manifest.build(),
            "before": manifest.machine(),
            "cases": cases,
            "seed": seed,
        }
        save(measure(cases, seed), {**made, "finished": manifest.now()}, folder)


def main(
    cases: Annotated[
        int,
        typer.Option(
            min=4,
            help="overlaps for each size and depth; a quarter of it at 5,120 faces, and of flights",
        ),
    ] = 400,
    seed: Annotated[int, typer.Option(help="seed of bodies and poses")] = 2004,
    out: Annotated[Path, typer.Option(help="folder")] = Path("results", "sizes"),
) -> None:
    run(out, cases, seed)
    print((out / "tables" / "misses.md").read_text())
    print((out / "tables" / "operations.md").read_text())


if __name__ == "__main__":
    typer.run(main)
