# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The rows of a run compared with its configuration: none missing, duplicated or of another
kind.
"""

from __future__ import annotations

from collections import Counter

import pandas as pd

from baselines import registry
from experiments.cases import families
from experiments.run import bins, piece_truth, timing
from experiments.run import config as configuration
from experiments.run.folder import given, record
from experiments.run.folder.rows import filled
from experiments.run.folder.store import Store
from experiments.run.labelling import Slot

from .findings import Findings

CASES = (
    "case",
    "scenario",
    "level",
    "index",
    "attempt",
    "precision",
    "question",
    "body_a",
    "body_b",
    "quaternion_a",
    "position_a",
    "quaternion_b",
    "position_b",
    "displacement",
    "axis",
    "angle",
    "about",
    "displacement_b",
    "axis_b",
    "angle_b",
    "about_b",
    "size",
    "faces",
    "tags",
    "label",
    "t_lo",
    "t_hi",
    "start",
    "end",
    "gap",
    "touching",
    "reason",
    "certificate",
)
BODIES = ("body", "name", "kind", "vertices", "faces", "piece_vertices", "piece_faces")
PIECES = (
    "case",
    "body_a",
    "body_b",
    "precision",
    "label",
    "t_lo",
    "t_hi",
    "start",
    "end",
    "gap",
    "touching",
    "reason",
    "certificate",
)
ANSWERS = ("case", "method", "status", "hit", "time", "detail")
TIMES = ("question", "faces", "situation", "method", "case", "build_ns", "rounds_ns")
STATUS = ("ok", "error", "timeout", "unsupported")


def name_preset(config, found: Findings) -> None:
    """Report which configuration of the package this is: a smaller run that agrees with itself
    is also valid.
    """
    names = [*configuration.presets(), *configuration.experiments()]
    differ = {name: config.differences(configuration.load(name)) for name in names}
    best = min(differ, key=lambda name: len(differ[name]))
    if differ[best]:
        found.note(
            f"Its configuration is not one of this package's; the nearest is {best}, from which "
            f"it differs in: {', '.join(differ[best])}."
        )
    else:
        found.note(f"Its configuration is {best}, as in this package.")


def read(store: Store, found: Findings) -> dict[str, pd.DataFrame] | None:
    """The tables by name, with every column; None if one cannot be used. Raises StoreError."""
    wanted = {"cases": CASES, "bodies": BODIES, "observations": ANSWERS}
    wanted |= {"timings": TIMES} if store.has("timings.parquet") else {}
    if any(map(store.has, piece_truth.FILES)):
        wanted |= {"pieces": PIECES, "pieces-bodies": BODIES}
    frames = {}
    for name, columns in wanted.items():
        file = f"{name}.parquet"
        if not store.has(file) and file in piece_truth.FILES:
            found.refuse(file, "it is missing")
            continue
        try:
            # each wrong row is to be named, not only the first
            frames[name] = store.read(file, checked=False)
        except (OSError, ValueError, TypeError) as error:
            found.refuse(file, f"it cannot be read ({given.reason(error)})")
            continue
        if why := record.wrong_values(frames[name], file):
            found.refuse(file, why)
            del frames[name]
            continue
        frames[name] = filled(frames[name]) if name == "cases" else frames[name]
        if missing := [c for c in columns if c not in frames[name]]:
            found.refuse(file, f"it lacks {', '.join(missing)}")
        if extra := [c for c in frames[name] if c not in columns]:
            found.refuse(file, f"it has unknown columns: {', '.join(map(str, extra))}")
    return (
        frames
        if len(frames) == len(wanted)
        and all(c in frames[name] for name, columns in wanted.items() for c in columns)
        else None
    )


def expected(config, cases: pd.DataFrame, found: Findings) -> dict[str, Slot]:
    """The slots required by the configuration, by the name of their case."""
    slots = []
    for choice in config.scenarios:
        known = families.scenarios().get(choice.name)
        own = cases.level[cases.scenario == choice.name].unique()
        for level in choice.levels or (known.levels if known else own):
            slots += [Slot(choice.name, float(level), i) for i in range(choice.cases)]
    return {f"{s.scenario}/{s.level:g}/{s.index:04d}": s for s in slots}


def check(config, frames, slots, found: Findings) -> list[str]:
    """Findings are by row. Returns the cases that occur once, in their order, for further
    checks.
    """
    counts = Counter(frames["cases"].case)
    _counted("cases.parquet", counts, slots, found)
    if list(counts) != [name for name in slots if name in counts]:
        found.refuse("cases.parquet", "the order of the cases differs from the configuration's")
    _bodies(frames, found)
    _answers(config, frames["observations"], slots, found)
    if "timings" in frames:
        _times(config, frames, found)
    return [name for name in slots if counts[name] == 1]


def _counted(file: str, counts: Counter, wanted, found: Findings) -> None:
    for name in wanted:
        if counts[name] != 1:
            found.refuse(_name(name), f"{file} has {counts[name]} rows of it, not 1")
    for name in counts:
        if name not in wanted:
            found.refuse(
                _name(name), f"{file} contains it, but the configuration does not require it"
            )


def _name(name) -> str:
    return " and ".join(map(str, name)) if isinstance(name, tuple) else str(name)


def _bodies(frames, found: Findings) -> None:
    used = {*frames["cases"].body_a, *frames["cases"].body_b}
    for body, n in Counter(frames["bodies"].body).items():
        if n > 1:
            found.refuse(f"body {body}", f"bodies.parquet has {n} rows of it")
        if body not in used:
            found.refuse(f"body {body}", "no case uses it")


def _answers(config, answers: pd.DataFrame, slots, found: Findings) -> None:
    try:
        methods = [m.label for spec in config.asked for m in registry.make(spec)]
    except ValueError:
        methods = list(dict.fromkeys(answers.method))
        found.note(
            "It has methods from files that were not run (--trust runs them); whether a method "
            "of its configuration is missing was not checked."
        )
    wanted = {(name, method): None for method in methods for name in slots}
    counts = Counter(zip(answers.case, answers.method))
    _counted("observations.parquet", counts, wanted, found)
    if list(counts) != [pair for pair in wanted if pair in counts]:
        found.refuse(
            "observations.parquet", "the order of the answers differs from the configuration's"
        )
    for row in answers.itertuples():
        if wrong := _odd(row):
            found.refuse(f"{row.case} and {row.method}", wrong)


def _odd(row) -> str:
    """An impossible answer: an unknown status, or a time without a hit or outside the step."""
    hit = None if pd.isna(row.hit) else bool(row.hit)
    if row.status not in STATUS:
        return f"the status '{row.status}' does not exist"
    if (hit is None) == (row.status == "ok"):
        return f"the status {row.status} does not go with {'no answer' if hit is None else 'one'}"
    if not pd.isna(row.time) and not (hit and 0 <= row.time <= 1):
        return f"the time {row.time} does not go with the answer"
    return (
        "" if (row.status == "ok") == (row.detail == "") else "the detail does not match the status"
    )


def _times(config, frames, found: Findings) -> None:
    cases = (
        frames["cases"]
        .drop_duplicates("case")
        .assign(situation=bins.situation_of, bin=lambda c: bins.size_of(c.faces))
        .set_index("case")
    )
    asked = set(frames["observations"].method)
    key = ["question", "faces", "situation", "method", "case"]
    seen = Counter(frames["timings"][key].itertuples(index=False, name=None))
    for row in frames["timings"].itertuples():
        where, bin_ = f"{row.case} and {row.method}", (row.question, row.faces, row.situation)
        case = cases.loc[row.case] if row.case in cases.index else None
        own = row.case == timing.FLOOR or row.method == timing.PROBE  # of the clock, not of a case
        doubled = not own and seen[(*bin_, row.method, row.case)] > 1
        if row.method == timing.LOST:  # in place of a case: the label, and why it has no times
            if row.case.partition(":")[0] not in {*asked, "all methods"} or len(row.rounds_ns):
                found.refuse(where, "timings.parquet has rows of it that no run makes")
        elif doubled or not (own or row.method in asked):
            found.refuse(where, "timings.parquet has rows of it that no run makes")
        elif not own and (case is None or bin_ != (case.question, str(case.bin), case.situation)):
            found.refuse(where, "it was timed in a bin to which it does not belong")
        elif not (row.build_ns >= 0 and len(row.rounds_ns)):
            found.refuse(where, "its times cannot come from such a run")
