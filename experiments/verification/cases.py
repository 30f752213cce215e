# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Every case drawn again from its scenario, seed, level, index and attempt, and proved again."""

from __future__ import annotations

import json
import math
import tempfile
from functools import partial
from pathlib import Path

import numpy as np
import pandas as pd

from experiments.cases import families
from experiments.cases.case import Case
from experiments.run.config import load_files
from experiments.run.folder.rows import body_row, case_row, cases_of, filled
from experiments.run.folder.store import Store
from experiments.run.labelling import REDRAWS, Slot
from experiments.run.processes.pool import Task, run
from experiments.run.progress import stage
from experiments.truth import Truth, check_many, label
from ofg import Body, Query

from .findings import Findings

CHUNK = 64
SECONDS = 300.0  # for one case with all its draws
# another build's prover may differ: brackets by this factor, gaps relatively
WIDTH, GAP = (
    4.0,
    1e-6,
)
CLAIMS = ("label", "t_lo", "t_hi", "start", "end", "gap", "touching", "reason", "certificate")
SAID = ("label", "start", "end", "touching", "reason")


def check(store: Store, config, slots, names, workers, own, found: Findings) -> None:
    """own: the configuration whose files a process may run, or None. Findings are by case."""
    items = [(name, slots[name]) for name in names]
    chunks = [items[i : i + CHUNK] for i in range(0, len(items), CHUNK)]
    results = [[] for _ in chunks]

    def lost(item, loss):
        return {"case": item[0], "wrong": [f"checking stopped: {loss.detail}"]}

    tasks = [
        Task(_open, (str(store.folder), config.seed), chunk, results[i].extend, lost)
        for i, chunk in enumerate(chunks)
    ]
    with tempfile.TemporaryDirectory() as folder, stage("check cases", len(items)) as advance:
        run(tasks, workers, SECONDS, Path(folder, "log"), advance, own and partial(load_files, own))
    _gather([result for chunk in results for result in chunk], store, found)


def _gather(results, store: Store, found: Findings) -> None:
    names, undrawn = {}, []
    for result in results:
        for what in result["wrong"]:
            found.refuse(result["case"], what)
        if not result["wrong"]:
            found.labels[result["label"]] += 1
        for digest, name in result.get("names", ()):
            names.setdefault(digest, set()).add(name)
        undrawn += [] if result.get("drawn", True) else [result["case"].split("/")[0]]
    for row in store.read("bodies.parquet", checked=False).itertuples():
        if row.body in names and row.name not in names[row.body]:
            found.refuse(f"body {row.body}", f"its name '{row.name}' is not the scenario's")
    if undrawn:
        found.note(
            f"{len(undrawn)} cases were not drawn again, because their scenarios are not of this "
            f"package: {', '.join(sorted(set(undrawn)))}. Their labels were proved again for the "
            "recorded bodies. If you trust the Python files of this run, add --trust."
        )


def _open(argument):
    folder, seed = argument
    store = Store(folder)
    cases = filled(store.read("cases.parquet", checked=False)).drop_duplicates("case", keep=False)
    bodies = store.read("bodies.parquet", checked=False).drop_duplicates("body")
    rows = {row["case"]: row for row in cases.to_dict("records")}
    made = {row["body"]: row for row in bodies.to_dict("records")}
    return lambda item: _looked_at(item[0], item[1], rows[item[0]], made, seed)


def _looked_at(name: str, slot: Slot, row: dict, bodies: dict, seed: int) -> dict:
    scenario = families.scenarios().get(slot.scenario)
    result = {"case": name, "wrong": [], "label": str(row["label"]), "drawn": bool(scenario)}
    try:
        if scenario:
            query, names = _drawn(scenario, slot, row, bodies, seed, result["wrong"])
            result["names"] = names
        else:
            query = _recorded(row, bodies, result["wrong"])
        prove(query, row, result["wrong"])
    except Exception as error:
        words = f"{type(error).__name__}: {error}"[:200]
        result["wrong"].append(f"its row cannot be read ({words})")
    return result


def _drawn(scenario, slot: Slot, row, bodies, seed: int, wrong: list[str]):
    """The query of the case as its scenario draws it, and its bodies' names."""
    attempt = row["attempt"]
    if not (attempt == int(attempt) and 0 <= attempt < REDRAWS):
        raise ValueError(f"attempt {attempt} is not a valid draw")
    for earlier in range(int(attempt)):
        truth = label(scenario.case(seed, slot.level, slot.index, earlier).query)
        if not scenario.useless(truth):
            wrong.append(
                f"draw {earlier} was rejected, although its scenario accepts it: {truth.label}"
            )
    case = scenario.case(seed, slot.level, slot.index, int(attempt))
    _inputs(case, row, int(attempt), wrong)
    for side in ("a", "b"):
        _body(getattr(case.query, side), bodies.get(row[f"body_{side}"]), side, wrong)
    if scenario.useless(_truth(row)) and attempt < REDRAWS - 1:
        wrong.append("the draw was kept, although its scenario rejects it")
    return case.query, [(body.digest, body.name) for body in (case.query.a, case.query.b)]


def _inputs(case: Case, row, attempt: int, wrong: list[str]) -> None:
    fresh = case_row(case, Truth("uncertain"), attempt)
    for column, value in fresh.items():
        if column not in CLAIMS and not same(row[column], value):
            wrong.append(f"{column} is not what the scenario draws")


def _body(body: Body, row, side: str, wrong: list[str]) -> None:
    if row is None:
        return wrong.append(f"body_{side} is not in bodies.parquet")
    for column, value in body_row(body).items():
        if column != "name" and not same(row[column], value):
            wrong.append(
                f"{column} of body_{side} in bodies.parquet is not what the scenario draws"
            )


def _recorded(row, bodies, wrong: list[str]) -> Query:
    """The recorded query with bodies made again from their rows, and thus valid."""
    found = [bodies[row[f"body_{side}"]] for side in ("a", "b")]
    made = [_made(body) for body in found]
    ((case, _),) = cases_of(pd.DataFrame([row]), pd.DataFrame(found).drop_duplicates("body"))
    query = case.query
    for body, recorded in zip(made, found):
        if body.digest != recorded["body"]:
            wrong.append("a body does not have the digest under which it is recorded")
    query = Query(query.question, *made, query.pose_a, query.pose_b, query.motion, query.motion_b)
    _inputs(
        Case(
            row["case"],
            row["scenario"],
            row["level"],
            row["index"],
            query,
            case.tags,
            row["precision"],
        ),
        row,
        row["attempt"],
        wrong,
    )
    return query


def _made(row) -> Body:
    """Made by the constructors that check: BodyError or ValueError for an open surface and the
    like.
    """
    v, f = (np.reshape(row[column], (-1, 3)) for column in ("vertices", "faces"))
    if row["kind"] == "mesh":
        return Body.mesh(v, f, row["name"])
    if row["kind"] == "convex":
        return Body.convex(v, row["name"])
    pieces, first = [], 0
    for n in row["piece_vertices"]:
        pieces.append(Body.convex(v[first : first + n]))
        first += n
    return Body.union(pieces, row["name"])


def _truth(row) -> Truth:
    try:
        certificate = json.loads(row["certificate"])
    except (ValueError, TypeError, RecursionError):
        certificate = "not JSON"
    claims = [row[c] for c in ("label", "t_lo", "t_hi", "start", "end", "gap", "reason")]
    return Truth(*claims, certificate, bool(row["touching"]))


def prove(query: Query, row, wrong: list[str]) -> None:
    """Check the recorded truth and label the query again; differences are added to `wrong`."""
    truth, fresh = _truth(row), label(query)
    (verdict,) = check_many([(query, truth)])
    if not verdict.ok:
        wrong.append(f"label {truth.label} is refused: {verdict.reason}")
    if truth.label == "uncertain" != fresh.label:
        return wrong.append(
            f"recorded as uncertain, but now proved {fresh.label}: a forgery, or a "
            "fault of the machine that recorded it"
        )
    for claim in SAID:
        if getattr(truth, claim) != getattr(fresh, claim):
            wrong.append(
                f"{claim} is recorded as {getattr(truth, claim)}, but proved to be"
                f" {getattr(fresh, claim)}"
            )
    if truth.t_hi - truth.t_lo > WIDTH * (fresh.t_hi - fresh.t_lo) + 1e-15:
        wrong.append(f"its bracket [{truth.t_lo}, {truth.t_hi}] is wider than the prover's")
    for claim in ("gap", "t_lo", "t_hi"):
        before, after = getattr(truth, claim), getattr(fresh, claim)
        if not (same(before, after) or math.isclose(before, after, rel_tol=GAP)):
            wrong.append(f"{claim} is recorded as {before}, but proved to be {after}")


def same(a, b) -> bool:
    """Equal to the bit: -0.0 is not 0.0, and NaN is NaN."""
    return _plain(a) == _plain(b)


def _plain(value):
    value = value.tolist() if hasattr(value, "tolist") else value
    if isinstance(value, (list, tuple)):
        return [_plain(x) for x in value]
    return value.hex() if isinstance(value, float) else value
