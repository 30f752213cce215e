# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""From scenarios to certified cases."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass
from functools import partial

import pandas as pd

from experiments.cases import families
from experiments.cases.case import Case
from experiments.cases.label import Truth
from experiments.cases.scenario import ScenarioError
from ofg import Query

from . import ownfile, words
from .config import RunConfig, load_files
from .folder import origin
from .folder.rows import Row, body_row, case_row
from .folder.store import Store
from .processes.pool import Instead, Loss, Task, mark, mixed, run
from .progress import stage

REDRAWS = 50
CHUNK = 16  # cases labelled by one process
DRAWING = "drawing"  # the mark of a process while a scenario's own code runs

Drawn = tuple[Row, list[Row]]  #: of cases.parquet, and of bodies.parquet


@dataclass(frozen=True)
class Slot:
    """The place of a case: the draw, the level and the scenario."""

    scenario: str
    level: float
    index: int


@dataclass(frozen=True)
class Unlabelled:
    """A slot whose label was lost, and why: its case is drawn again, in a worker, like all work
    of a scenario.
    """

    slot: Slot
    detail: str


def slots(config: RunConfig) -> list[Slot]:
    """Every case of the run, in the order of the tables. Raises ConfigError or ValueError for
    unknown names and levels.
    """
    found = []
    for choice in config.scenarios:
        scenario = families.get(choice.name)
        for level in choice.levels or scenario.levels:
            scenario.check_level(level)
            found += [Slot(choice.name, float(level), i) for i in range(choice.cases)]
    return found


def make_cases(store: Store, config: RunConfig, workers: int) -> None:
    """Write cases.parquet and bodies.parquet; existing shards are not made again."""
    all_slots = slots(config)
    chunks = [all_slots[i : i + CHUNK] for i in range(0, len(all_slots), CHUNK)]
    facts = {
        **origin.facts(),
        "seed": config.seed,
        "label_seconds": config.label_seconds,
        "own": ownfile.digests(config.scenario_files),
    }
    names = [
        store.shard("cases", **facts, slots=[asdict(slot) for slot in chunk]) for chunk in chunks
    ]
    bodies = [store.shard("bodies", cases=name.key) for name in names]

    def keep(i: int) -> Callable[[list[Drawn]], None]:
        def done(results: list[Drawn]) -> None:
            found = {row["body"]: row for _, rows in results for row in rows}
            store.write(pd.DataFrame(list(found.values())), bodies[i])
            store.write(pd.DataFrame([row for row, _ in results]), names[i])

        return done

    tasks = [
        Task(_open, config.seed, chunk, keep(i), partial(_lost, config.seed))
        for i, chunk in enumerate(chunks)
        if not (names[i].ready() and bodies[i].ready())
    ]
    with stage(
        "certify cases", len(all_slots), len(all_slots) - sum(len(t.items) for t in tasks)
    ) as advance:
        run(
            mixed(tasks),
            workers,
            config.label_seconds,
            store.path("workers.log"),
            advance,
            partial(load_files, config),
        )
    cases = pd.concat([store.read(name) for name in names], ignore_index=True)
    found = pd.concat([store.read(name) for name in bodies], ignore_index=True).drop_duplicates(
        "body", ignore_index=True
    )
    store.write(found, "bodies.parquet")
    store.write(cases, "cases.parquet")


def _open(seed: int) -> Callable[[Slot | Unlabelled], Drawn]:
    from experiments.truth import label

    def answer(item: Slot | Unlabelled) -> Drawn:
        return _label(seed, item, label) if isinstance(item, Slot) else _uncertain(seed, item)

    return answer


def _label(seed: int, slot: Slot, label: Callable[[Query], Truth]) -> Drawn:
    for attempt in range(REDRAWS):
        case = _draw(seed, slot, attempt)
        truth = label(case.query)
        if not families.get(slot.scenario).useless(truth):
            break
    return _rows(case, truth, attempt)


def _draw(seed: int, slot: Slot, attempt: int = 0) -> Case:
    """The case of a slot. ScenarioError, which names it, for any error of the scenario."""
    mark(DRAWING)
    try:
        return families.get(slot.scenario).case(seed, slot.level, slot.index, attempt)
    except ScenarioError:
        raise
    except BaseException as error:
        raise _no_case(seed, slot, words.of_error(error)) from error
    finally:
        mark("")


def _uncertain(seed: int, lost: Unlabelled) -> Drawn:
    truth = Truth("uncertain", reason=f"labelling stopped: {lost.detail}")
    return _rows(_draw(seed, lost.slot), truth, 0)


def _lost(seed: int, item: Slot | Unlabelled, loss: Loss) -> Instead:
    """Make an uncertain case of a slot whose label ended its process. ScenarioError if the
    drawing ended it.
    """
    if loss.mark == DRAWING or isinstance(item, Unlabelled):
        raise _no_case(
            seed,
            item if isinstance(item, Slot) else item.slot,
            f"its process ended ({loss.detail})",
        )
    return Instead(Unlabelled(item, loss.detail))


def _no_case(seed: int, slot: Slot, why: str) -> ScenarioError:
    return ScenarioError(
        f"Scenario '{slot.scenario}' drew no valid case at level {slot.level:g}, index "
        f"{slot.index}, seed {seed}: {why}. Correct its `generate`, or leave out the scenario or "
        "the level."
    )


def _rows(case: Case, truth: Truth, attempt: int) -> Drawn:
    return case_row(case, truth, attempt), [body_row(case.query.a), body_row(case.query.b)]
