# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Meshes decomposed again, and the truth of the cases about their pieces proved again."""

from __future__ import annotations

import tempfile
from collections import Counter
from pathlib import Path

from experiments.run import decomposing
from experiments.run.folder.rows import body_row, cases_of, truth_row
from experiments.run.piece_truth import FILES
from experiments.run.processes.pool import Task, run
from experiments.run.progress import stage

from .cases import CHUNK, SECONDS, prove, same
from .findings import Findings


def check(config, frames, names, workers: int, found: Findings) -> None:
    """names: the cases to check. Findings are by case and by body."""
    if "pieces" not in frames:
        if _wanted(config):
            found.note(
                f"It has no {FILES[0]}, like older runs: its methods that decompose meshes are "
                "judged by the meshes."
            )
        return
    if _wanted(config) is False:
        found.refuse(FILES[0], "no method of the configuration decomposes meshes")
    bodies = frames["bodies"].drop_duplicates("body")
    about = decomposing.about_meshes(frames["cases"], bodies).drop_duplicates("case")
    _rows(frames["pieces"], list(about.case), found)
    try:
        meshes = decomposing.meshes_of(about, bodies)
        cases = [case for case, _ in cases_of(about[about.case.isin(names)], bodies)]
    except ValueError as error:
        return found.refuse(FILES[0], f"it cannot be checked. {error}")
    made = _decomposed(meshes, config, workers)
    items = [decomposing.item(case, made) for case in cases]
    _bodies(frames["pieces-bodies"], items, found)
    _proved(items, frames["pieces"], workers, found)


def _wanted(config) -> bool | None:
    """Whether a method decomposes; None if a method's file is not loaded."""
    try:
        return decomposing.wanted(config)
    except ValueError:
        return None


def _rows(pieces, wanted: list[str], found: Findings) -> None:
    counts = Counter(pieces.case)
    for name in wanted:
        if counts[name] != 1:
            found.refuse(name, f"{FILES[0]} has {counts[name]} rows of it, not 1")
    for name in counts.keys() - set(wanted):
        found.refuse(name, f"{FILES[0]} contains it, but it is not a case about a mesh")
    if list(pieces.case) != [name for name in wanted if name in counts]:
        found.refuse(FILES[0], "the order of its cases differs from cases.parquet")


def _decomposed(meshes, config, workers: int) -> dict:
    made = {}

    def keep(mesh):
        return lambda results: made.update({mesh.digest: results[0]})

    tasks = [
        Task(decomposing.open_mesh, None, [mesh], keep(mesh), decomposing.lost_mesh)
        for mesh in meshes
    ]
    _run("decompose meshes", tasks, workers, config.build_seconds)
    return made


def _run(title: str, tasks, workers: int, seconds: float) -> None:
    total = sum(len(task.items) for task in tasks)
    with tempfile.TemporaryDirectory() as folder, stage(title, total) as advance:
        run(tasks, workers, seconds, Path(folder, "log"), advance)


def _bodies(recorded, items, found: Findings) -> None:
    fresh = {body.digest: body for i in items for body in (i.query.a, i.query.b)}
    counts = Counter(recorded.body)
    for digest in counts.keys() - fresh.keys():
        found.refuse(f"body {digest}", f"{FILES[1]} contains it, but no case uses it")
    rows = {row["body"]: row for row in recorded.to_dict("records")}
    for digest, body in fresh.items():
        if counts[digest] != 1:
            found.refuse(f"body {digest}", f"{FILES[1]} has {counts[digest]} rows of it, not 1")
        elif wrong := [c for c, v in body_row(body).items() if not same(rows[digest][c], v)]:
            found.refuse(
                f"body {digest}",
                f"{', '.join(wrong)} in {FILES[1]} differs from its decomposition",
            )


def _proved(items, pieces, workers: int, found: Findings) -> None:
    rows = {
        row["case"]: row for row in pieces.drop_duplicates("case", keep=False).to_dict("records")
    }
    items = [(item, rows[item.case]) for item in items if item.case in rows]
    results = []

    def lost(item, loss):
        return item[0].case, "uncertain", [f"checking stopped: {loss.detail}"]

    tasks = [
        Task(_open, None, items[i : i + CHUNK], results.extend, lost)
        for i in range(0, len(items), CHUNK)
    ]
    _run("check pieces", tasks, workers, SECONDS)
    for name, label, wrong in results:
        for what in wrong:
            found.refuse(f"{name} (pieces)", what)
        if not wrong:
            found.pieces[label] += 1


def _open(_):
    return _looked_at


def _looked_at(given) -> tuple[str, str, list[str]]:
    item, row = given
    wrong = [
        f"{column} differs from that of the pieces of its meshes"
        for column, value in decomposing.place(item).items()
        if not same(row[column], value)
    ]
    try:
        if item.fault:
            wanted = truth_row(decomposing.no_pieces(item))
            wrong += [
                f"{c} is recorded, but its mesh has no pieces"
                for c in wanted
                if not same(row[c], wanted[c])
            ]
        else:
            prove(item.query, row, wrong)
    except Exception as error:
        wrong.append(f"its row cannot be read ({type(error).__name__}: {error})"[:200])
    return item.case, str(row["label"]), wrong
