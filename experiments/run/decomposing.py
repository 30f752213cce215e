# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Decompose meshes into convex pieces, and certify the truth of the cases for the pieces."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd

import ofg
from baselines import registry
from experiments.cases.case import Case
from experiments.cases.label import Truth
from experiments.cases.scenario import snap
from ofg import Body, BodyError, Query

from . import words
from .config import RunConfig
from .folder import origin
from .folder.rows import Row, body_of, body_row, cases_of, truth_row
from .folder.shard import Shard
from .folder.store import Store
from .labelling import CHUNK
from .piece_truth import FILES
from .processes.pool import Loss, Task, mixed, run
from .progress import stage

# estimates for one body and for one case, used only for progress
DECOMPOSE_SECONDS, LABEL_SECONDS = (
    4.0,
    0.2,
)

Pieces = tuple[Body, str]  #: see pieces_of


@dataclass(frozen=True)
class Item:
    """A case for pieces. fault: why one of its meshes has no pieces; the query then contains the
    mesh unchanged.
    """

    case: str
    query: Query
    precision: str
    fault: str


def make(store: Store, config: RunConfig, workers: int) -> None:
    """Write pieces.parquet and pieces-bodies.parquet: a row per case with a mesh.

    Neither is written if no method decomposes, or no case has a mesh. Existing shards are not made
    again.
    """
    cases, bodies = store.read("cases.parquet"), store.read("bodies.parquet")
    about = about_meshes(cases, bodies)
    if about.empty or not wanted(config):
        for name in FILES:
            store.path(name).unlink(missing_ok=True)
        return
    made = _decomposed(store, config, workers, meshes_of(about, bodies))
    items = [item(case, made) for case, _ in cases_of(about, bodies)]
    used = {body.digest: body_row(body) for i in items for body in (i.query.a, i.query.b)}
    store.write(pd.DataFrame(list(used.values())), FILES[1])
    store.write(_certified(store, config, workers, items), FILES[0])


def wanted(config: RunConfig) -> bool:
    """Whether a method of the run answers for the pieces of a mesh."""
    return any(method.decomposes for spec in config.asked for method in registry.make(spec))


def about_meshes(cases: pd.DataFrame, bodies: pd.DataFrame) -> pd.DataFrame:
    """The rows of cases with a mesh among their bodies."""
    meshes = bodies.body[bodies.kind == "mesh"]
    return cases[cases.body_a.isin(meshes) | cases.body_b.isin(meshes)]


def meshes_of(cases: pd.DataFrame, bodies: pd.DataFrame) -> list[Body]:
    """The distinct meshes of the cases."""
    used = bodies.body.isin({*cases.body_a, *cases.body_b})
    return [body_of(row) for row in bodies[used & (bodies.kind == "mesh")].itertuples()]


def pieces_of(mesh: Body) -> Pieces:
    """The pieces that methods use in place of a mesh, and ""; or the mesh itself and the reason
    why it has none.
    """
    try:
        return ofg.decompose(mesh), ""
    except BodyError as error:
        return mesh, words.text_of(error)


def precision_of(query: Query, precision: str) -> str:
    """ "float32" if the case is in float32 and every vertex of the pieces is a float32 number."""
    exact = all(np.array_equal(snap(b.vertices), b.vertices) for b in (query.a, query.b))
    return precision if exact else "float64"


def item(case: Case, made: dict[str, Pieces]) -> Item:
    """made: `pieces_of` each mesh by its digest."""
    q = case.query
    (a, fault_a), (b, fault_b) = (made.get(body.digest, (body, "")) for body in (q.a, q.b))
    query = replace(q, a=a, b=b)
    return Item(case.id, query, precision_of(query, case.precision), fault_a or fault_b)


def _decomposed(
    store: Store, config: RunConfig, workers: int, meshes: list[Body]
) -> dict[str, Pieces]:
    """digest of each mesh -> `pieces_of` it."""
    facts = {**origin.facts(), "seconds": config.build_seconds}
    names = [store.shard("decompositions", **facts, mesh=mesh.digest) for mesh in meshes]

    def keep(mesh: Body, name: Shard) -> Callable[[list[Pieces]], None]:
        def done(results: list[Pieces]) -> None:
            ((pieces, fault),) = results
            row = {**body_row(pieces), "mesh": mesh.digest, "fault": fault}
            store.write(pd.DataFrame([row]), name)

        return done

    tasks = [
        Task(open_mesh, None, [mesh], keep(mesh, name), lost_mesh)
        for mesh, name in zip(meshes, names)
        if not name.ready()
    ]
    _run(
        "decompose meshes",
        store,
        tasks,
        workers,
        config.build_seconds,
        len(meshes),
        DECOMPOSE_SECONDS,
    )
    rows = pd.concat([store.read(name) for name in names], ignore_index=True)
    return {row.mesh: (body_of(row), row.fault) for row in rows.itertuples()}


def open_mesh(_: None) -> Callable[[Body], Pieces]:
    """Return a function for a Task whose items are meshes."""
    return pieces_of


def lost_mesh(mesh: Body, loss: Loss) -> Pieces:
    """The replacement for `pieces_of` a mesh whose process ended."""
    return mesh, f"decomposing stopped: {loss.detail}"


def _certified(store: Store, config: RunConfig, workers: int, items: list[Item]) -> pd.DataFrame:
    chunks = [items[i : i + CHUNK] for i in range(0, len(items), CHUNK)]
    facts = {
        **origin.facts(),
        "cases": store.digest("cases.parquet"),
        "bodies": store.digest(FILES[1]),
        "label_seconds": config.label_seconds,
    }
    names = [store.shard("pieces", **facts, chunk=[i.case for i in chunk]) for chunk in chunks]

    def keep(name: Shard) -> Callable[[list[Row]], None]:
        return lambda rows: store.write(pd.DataFrame(rows), name)

    tasks = [
        Task(_open_label, None, chunk, keep(name), _lost)
        for chunk, name in zip(chunks, names)
        if not name.ready()
    ]
    _run("certify pieces", store, tasks, workers, config.label_seconds, len(items), LABEL_SECONDS)
    return pd.concat([store.read(name) for name in names], ignore_index=True)


def _run(
    title: str,
    store: Store,
    tasks: list[Task],
    workers: int,
    limit: float,
    total: int,
    each: float,
) -> None:
    """each: expected seconds for an item."""
    todo = sum(len(task.items) for task in tasks)
    with stage(title, total, total - todo, each * todo / workers) as advance:
        run(mixed(tasks), workers, limit, store.path("workers.log"), advance)


def _open_label(_: None) -> Callable[[Item], Row]:
    from experiments.truth import label

    def answer(item: Item) -> Row:
        if item.fault:
            return _row(item, no_pieces(item))
        return _row(item, label(item.query))

    return answer


def no_pieces(item: Item) -> Truth:
    """The truth of a case with a mesh that has no pieces."""
    return Truth("uncertain", reason=f"no convex pieces: {item.fault}")


def place(item: Item) -> Row:
    """The columns of a row of pieces.parquet that identify its case."""
    return {
        "case": item.case,
        "body_a": item.query.a.digest,
        "body_b": item.query.b.digest,
        "precision": item.precision,
    }


def _lost(item: Item, loss: Loss) -> Row:
    return _row(item, Truth("uncertain", reason=f"labelling stopped: {loss.detail}"))


def _row(item: Item, truth: Truth) -> Row:
    return {**place(item), **truth_row(truth)}
