# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Timing of methods: interleaved rounds on one pinned core, a floor for each method, the same cases
for all.

Protocol. Cases are grouped into bins by question, size and situation (gap or depth; hit or clear).
In a round, every method answers every case of a bin once, each call timed separately, so that poses
change from call to call (a repeated pose flatters by up to 3x). Methods take turns within a round,
in a new random order for each round, so that a slow minute of the machine affects all of them and
no method always finds the bodies in the cache that another left there (in a fixed order k = 4 came
out slower than k = 8 behind it). Turns do not alternate call by call, because each call would then
find the instruction cache full of another engine. The floor of a method is its own cheapest call
(of n substeps: one) on two tetrahedra far apart, timed between its cases: the cost of the binding
and of an early exit. A net time of n substeps therefore still contains the binding's cost of n - 1
calls. An engine behind spheres has that engine's floor, as the spheres settle the query. A method
that takes longer than `seconds` for its rounds of a bin takes part in fewer of them, spread evenly,
but in at least 3; one that takes longer for a single round is warmed up once. Only cases that a
method answered (status ok) are timed; building (`prepare`) is timed once per case.
"""

from __future__ import annotations

import contextlib
import gc
import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from time import perf_counter_ns

import numpy as np
import pandas as pd
import psutil

from baselines import registry
from ofg import Body, Motion, Pose, Query

from . import ownfile, words
from .answering import PACES
from .bins import Bin, choose
from .config import RunConfig, TimingChoice, load_files
from .folder import manifest, origin
from .folder.shard import Shard
from .folder.store import Store
from .processes.pool import MEMORY, Task, mark, run
from .progress import stage

LEAST_ROUNDS = 3
#: share of the machine's memory that the process that times may take. It keeps every prepared case
#: of a bin, and a MuJoCo model alone reserves 28 MB: 48 cases of six methods are 8 GB, of which
#: little is ever touched.
SHARE = 0.5
START = 1.2  # seconds: a process that imports every engine (0.8 in `quick`, 2.3 in `standard`)
COLUMNS = ["question", "faces", "situation", "method", "case", "build_ns", "rounds_ns"]
Times = tuple[str, str, str, str, str, int, list[int]]  #: a row of COLUMNS
PROBE = "(noise probe)"
FLOOR = "(floor)"
# if the process died: a row of its current method, with the reason in place of the case
LOST = "(lost)"


def measure(store: Store, config: RunConfig) -> None:
    """Write timings.parquet: a row per bin, method and case (and floor), with the nanoseconds of
    each round.
    """
    if not config.timing.cases:
        return
    bins = choose(store, config)
    names = [_shard(store, config, bin_) for bin_ in bins]
    seconds = [max(1, round(s)) for s in expected(store, bins, config.timing)]
    there = [name.ready() for name in names]
    with stage(
        "time methods", sum(seconds), sum(s for s, t in zip(seconds, there) if t), sum(seconds)
    ) as advance:
        for bin_, name, planned in (
            (b, n, s) for b, n, s, t in zip(bins, names, seconds, there) if not t
        ):
            store.write(
                pd.DataFrame(
                    measure_bin(store, config, bin_, max(600.0, 20.0 * planned)), columns=COLUMNS
                ),
                name,
            )
            advance(planned)
    parts = [store.read(name) for name in names]
    store.write(
        pd.concat(parts, ignore_index=True) if parts else pd.DataFrame(columns=COLUMNS),
        "timings.parquet",
    )


def _shard(store: Store, config: RunConfig, bin_: Bin) -> Shard:
    engines = sorted({m.engine for spec in config.asked for m in registry.make(spec)})
    methods = {label: sorted(ids) for label, ids in bin_.methods.items()}
    return store.shard(
        "timings",
        **origin.facts(),
        engines={name: manifest.version(name) for name in engines},
        cases=store.digest("cases.parquet"),
        own=ownfile.digests(config.method_files),
        timing=config.timing.model_dump(),
        bin=[bin_.question, bin_.faces, bin_.situation, [case.id for case in bin_.cases], methods],
    )


def expected(store: Store, bins: list[Bin], timing: TimingChoice) -> list[float]:
    """Expected seconds for each bin, from the time that each method took to answer its cases
    once: by medians, because the first answer of a process includes an import, and a body is
    built once for several methods (sums predicted 883 s of `standard`, medians 285, it took
    317).
    """
    pace = store.read(*PACES).set_index(["method", "case"])
    seconds = []
    for bin_ in bins:
        total = START
        for label, ids in bin_.methods.items():
            once = pace.loc[[(label, i) for i in ids]].median() * len(ids)
            total += (
                once.build_s + rounds_within(once.query_s, timing, timing.warmup) * once.query_s
            )
        seconds.append(total)
    return seconds


def foresee(
    bins: dict[str, list[int]], paces: dict[str, pd.DataFrame], timing: TimingChoice
) -> float:
    """As `expected`, before all methods have answered. bins: cases of each bin, by question.
    paces: of methods, their answers so far: a row per case, with its question, and NaN if it was
    not answered.
    """
    total = START * sum(map(len, bins.values()))
    for pace in paces.values():
        for question, sizes in bins.items():
            own = pace[pace.question == question]
            if not len(own) or own.query_s.isna().all():
                continue
            build, query, share = (
                own.build_s.median(),
                own.query_s.median(),
                own.query_s.notna().mean(),
            )
            total += sum(
                share * n * (build + rounds_within(n * query, timing, timing.warmup) * query)
                for n in sizes
            )
    return total


def rounds_within(once: float, timing: TimingChoice, warmup: int = 0) -> int:
    """Rounds for a method whose cases of a bin take `once` seconds: all, or as many as fit, but
    at least LEAST_ROUNDS.
    """
    return min(timing.rounds, max(LEAST_ROUNDS, int(timing.seconds / max(once, 1e-9)))) + (
        warmup if once <= timing.seconds else min(1, warmup)
    )


def measure_bin(store: Store, config: RunConfig, bin_: Bin, seconds: float) -> list[Times]:
    """Rows of COLUMNS for one bin. If a method fails, or the process dies or hangs, the bin is
    timed again without the current method.
    """
    lost: list[Times] = []
    while True:
        found: list[list[Times] | Lost] = []
        task = Task(
            _open,
            config.timing,
            [bin_],
            found.extend,
            lambda item, loss: Lost(loss.mark, f"{loss.status}, {loss.detail}"),
        )
        # one worker: no other process of ours runs while times are measured
        run(
            [task],
            1,
            seconds,
            store.path("workers.log"),
            prepare=partial(load_files, config),
            memory=max(MEMORY, int(SHARE * psutil.virtual_memory().total)),
        )
        if not isinstance(found[0], Lost):
            return found[0] + lost
        label, why = found[0].label, found[0].why
        lost.append(
            (
                bin_.question,
                bin_.faces,
                bin_.situation,
                LOST,
                f"{label or 'all methods'}: {why}",
                0,
                [],
            )
        )
        if label not in bin_.methods:
            return lost
        bin_ = replace(
            bin_, methods={name: ids for name, ids in bin_.methods.items() if name != label}
        )


@dataclass(frozen=True)
class Lost:
    """The result of a bin without times: the method in progress, and why it failed."""

    label: str
    why: str


class _Failed(Exception):
    """A method raised during timing; the message gives the error."""


@contextlib.contextmanager
def _turn(label: str) -> Iterator[None]:
    """A turn on behalf of one method. Any error in it is attributed to that method."""
    mark(label)
    try:
        yield
    except BaseException as error:
        raise _Failed(label, f"error, {words.of_error(error)}") from error


def _open(timing: TimingChoice) -> Callable[[Bin], list[Times] | Lost]:
    os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})

    def answer(bin_: Bin) -> list[Times] | Lost:
        try:
            return time_bin(bin_, timing)
        except _Failed as failed:
            return Lost(*failed.args)

    return answer


def time_bin(bin_: Bin, timing: TimingChoice) -> list[Times]:
    """Rows of COLUMNS for one bin. The process is marked with the label of each method before
    its turn.
    """
    groups = []
    for label, answered in bin_.methods.items():
        with _turn(label):
            groups.append(_prepare(label, bin_, answered))
    groups.append([Call(PROBE, "", 0, _noise_probe())])
    times: dict[Call, list[int]] = {call: [] for group in groups for call in group}
    order = np.random.default_rng(0)
    gc.collect()
    gc.disable()
    once = [0.0] * len(groups)
    for r in range(timing.warmup + timing.rounds):
        for i in order.permutation(len(groups)):
            group, kept = groups[i], r - timing.warmup
            # the caches do not matter to it: one warm-up is enough
            slow = once[i] > timing.seconds
            if (
                slow
                and kept < 0
                or kept >= 0
                and not _takes_part(kept, rounds_within(once[i], timing), timing.rounds)
            ):
                continue
            with _turn(group[0].method):
                once[i] = _round(group, not slow, times if kept >= 0 else None)
    gc.enable()
    return [
        (bin_.question, bin_.faces, bin_.situation, c.method, c.case, c.build_ns, rounds)
        for c, rounds in times.items()
    ]


def _round(group: list[Call], warm: bool, times: dict[Call, list[int]] | None) -> float:
    """Run each call once, and append its duration to `times`. Returns the seconds of all."""
    begin = perf_counter_ns()
    if warm:
        group[-1].ask()  # not timed: its caches are full of another engine's data
    for call in group:
        start = perf_counter_ns()
        call.ask()
        elapsed = perf_counter_ns() - start
        if times is not None:
            times[call].append(elapsed)
    return (perf_counter_ns() - begin) / 1e9


def _takes_part(r: int, wanted: int, rounds: int) -> bool:
    """Whether a method that takes part in `wanted` of the rounds takes part in round r: they are
    spread evenly.
    """
    return (r + 1) * wanted // rounds > r * wanted // rounds


@dataclass(frozen=True, eq=False)
class Call:
    """One timed call of a method: of a case, or of its floor."""

    method: str
    case: str
    build_ns: int
    ask: Callable[[], object]


def _prepare(label: str, bin_: Bin, answered: set[str]) -> list[Call]:
    """The calls of one method, with its floor before every fourth case, so that both are timed
    with the caches in the same state.
    """
    (method,) = registry.make(label)
    cheapest = method.floor()
    calls: list[Call] = []
    for case in (c for c in bin_.cases if c.id in answered):
        if len(calls) % 5 == 0:
            calls.append(Call(label, FLOOR, 0, cheapest.ready(floor_query(bin_.question))))
        start = perf_counter_ns()
        ask = method.ready(case.query)
        calls.append(Call(label, case.id, perf_counter_ns() - start, ask))
    return calls


def floor_query(question: str) -> Query:
    """Two unit tetrahedra a thousand apart, moving (if they do) by a tenth: the cheapest query
    for a method.
    """
    corner = Body.convex(np.vstack([np.zeros(3), np.eye(3)]), "tetrahedron")
    far = Pose(position=np.array([1000.0, 0, 0]))
    motion = (
        Motion()
        if question == "overlap"
        else Motion(np.array([0.1, 0, 0]), angle=0.1 if question == "motion" else 0.0)
    )
    return Query(question, corner, corner, Pose(), far, motion)


def _noise_probe() -> Callable[[], float]:
    """The same arithmetic every time: the variation of its duration measures the disturbance of
    the machine.
    """
    block = np.arange(4096, dtype=np.float64)
    return lambda: float(np.dot(block, block)) + sum(range(200))
