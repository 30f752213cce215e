# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""`python -m experiments.drill`: run the command line under every fault and with every faulty
method, and print the outcomes.

Exit code 0: every try ended equal to the undisturbed run, at once or after stopping with a reason.
1: some try did not.
"""

from __future__ import annotations

import argparse
import shutil
import sys
import tempfile
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass
from pathlib import Path
from random import Random

from experiments.run.progress import stage

from . import command, kin, measure
from .command import Attempt, Bench
from .faults import FAULTS, Fault, Missed
from .faulty.kind import KINDS, Kind
from .faulty.methods import METHODS  # noqa: F401 - registers the kinds
from .outcome import FAILED, Outcome
from .tally import Tally
from .ward import Ward

HERE = Path(__file__).parent
FAULTY, MEMORY = "faulty methods", "memory"
ALLOCATES = "faulty-allocates-without-end"
# Kinds that share a run as long as all goes well: fewer disturb each other less during timing.
BATCH, SHORT_BATCH = 8, 24
EVERY = (*(f.name for f in FAULTS), MEMORY, FAULTY)
DRAWS = 10  # random times tried before a fault strikes
FEW = 10  # tries below which a drill is short: without methods that wait for the wall deadline


@dataclass(frozen=True)
class Try:
    """One try: run(place) gives outcomes by their subject."""

    fault: str
    run: Callable[[Path], list[tuple[str, Outcome | None]]]
    weight: int = 1


def main(words: list[str] | None = None) -> int:
    """The exit code; words: of the command line."""
    chosen = _arguments(words)
    names = [f for f in EVERY if not chosen.only or any(word in f for word in chosen.only)]
    if not names:
        print(f"There is no such fault. The faults are: {', '.join(EVERY)}.", file=sys.stderr)
        return 2
    place, tally = Path(tempfile.mkdtemp(prefix="ofg-drill-")), Tally()
    try:
        _drill(chosen, names, place, tally)
    except measure.Undrillable as error:
        print(error, file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print(f"{tally.text()}\n\nInterrupted: the table contains the tries so far.")
        return 130
    finally:
        shutil.rmtree(place, ignore_errors=True)
    print(tally.text(), *tally.reasons(), sep="\n")
    print(f"\n{tally.failed} failed." if tally.failed else "\nNone failed.")
    if chosen.out:
        chosen.out.write_text(
            "\n".join(
                [
                    _title(chosen),
                    "",
                    tally.text("github"),
                    "",
                    *(f"- {r}" for r in tally.reasons()),
                    "",
                ]
            )
        )
    return 1 if tally.failed else 0


def _arguments(words) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        "python -m experiments.drill",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "--tries",
        type=int,
        default=50,
        help="tries of each kill; a fifth as many of other faults [50; below 10: a short drill]",
    )
    parser.add_argument(
        "--only", action="append", help="only faults whose name contains this; may be repeated"
    )
    parser.add_argument(
        "--kind",
        action="append",
        help="only faulty methods whose name contains this; may be repeated",
    )
    parser.add_argument("--seed", type=int, default=0, help="seed of the random times")
    parser.add_argument(
        "--jobs", type=int, default=1, help="concurrent tries, each with two workers"
    )
    parser.add_argument("--out", type=Path, help="also write the table to this Markdown file")
    parser.add_argument(
        "--program",
        nargs="+",
        default=[str(Path(sys.executable).with_name("ofg-bench"))],
        help="command to drill [ofg-bench]",
    )
    return parser.parse_args(words)


def _title(chosen) -> str:
    command = f"python -m experiments.drill --tries {chosen.tries} --seed {chosen.seed}"
    return f"`{command}`: final files of accuracy compared with the undisturbed run."


def _drill(chosen, names: list[str], place: Path, tally: Tally) -> None:
    """Fill the tally, try by try."""
    tries = []
    program = tuple(chosen.program)
    wanted = [f for f in FAULTS if f.name in names]
    if wanted:
        bench, _ = measure.undisturbed(Bench(program, HERE / "drill.toml"), place / "undisturbed")
        tries += [
            _of_fault(f, bench, chosen.seed, i)
            for f in wanted
            for i in range(_times(f, chosen.tries))
        ]
    if {MEMORY, FAULTY} & set(names):
        ward = Ward(*measure.undisturbed(Bench(program, HERE / "faulty.toml"), place / "healthy"))
        tries += _of_memory(ward, names) + _of_methods(ward, chosen, names)
    for name in names:
        tally.name(name, next((f.note() for f in FAULTS if f.name == name), ""))
    with stage("drill", sum(t.weight for t in tries)) as advance:
        for one, found in _all(tries, place, chosen.jobs):
            for what, outcome in found:
                tally.add(one.fault, what, outcome)
                if outcome and outcome.kind == FAILED:
                    words = f"failed: {one.fault}, {what}: {outcome.why}"
                    print(words, file=sys.stderr, flush=True)
            advance(one.weight)


def _all(tries: list[Try], place: Path, jobs: int):
    """Each try with its outcomes, as they end; a consumer that stops early leaves no process."""
    with ThreadPoolExecutor(jobs) as pool:
        running = {pool.submit(_tried, t, place / f"{i:05d}"): t for i, t in enumerate(tries)}
        try:
            for done in as_completed(running):
                yield running[done], done.result()
        finally:
            pool.shutdown(wait=False, cancel_futures=True)
            while not all(future.done() for future in running):
                kin.end(kin.marked(command.OURS))
                time.sleep(0.2)


def _times(fault: Fault, tries: int) -> int:
    return max(min(2, tries), tries // 5) if fault.rare else tries


def _tried(one: Try, place: Path) -> list[tuple[str, Outcome | None]]:
    """Run it in a temporary folder, which is then removed."""
    try:
        return one.run(place)
    finally:
        shutil.rmtree(place, ignore_errors=True)


def _of_fault(fault: Fault, bench: Bench, seed: int, number: int) -> Try:
    def run(place):
        for draw in range(DRAWS):
            try:
                random = Random(f"{seed}/{fault.name}/{number}/{draw}")
                return [(f"try {number}", fault.strike(Attempt(bench, place / str(draw)), random))]
            except Missed:
                pass
        return [(f"try {number}", None)]

    return Try(fault.name, run)


def _of_memory(ward: Ward, names: list[str]) -> list[Try]:
    return (
        [Try(MEMORY, lambda place: [(ALLOCATES, ward.visit([KINDS[ALLOCATES]], place / "run"))])]
        if MEMORY in names
        else []
    )


def _of_methods(ward: Ward, chosen, names: list[str]) -> list[Try]:
    """Kinds that wait get separate runs, the others run in batches."""
    kinds = [
        k for k in KINDS.values() if not chosen.kind or any(word in k.name for word in chosen.kind)
    ]
    kinds = [k for k in kinds if not k.slow or chosen.tries >= FEW] if FAULTY in names else []
    quick = [k for k in kinds if not k.slow]
    size = BATCH if chosen.tries >= FEW else SHORT_BATCH
    batches = [quick[i : i + size] for i in range(0, len(quick), size)] + [
        [k] for k in kinds if k.slow
    ]
    return [
        Try(FAULTY, lambda place, b=batch: _batch(ward, b, place), len(batch)) for batch in batches
    ]


def _batch(ward: Ward, kinds: list[Kind], place: Path) -> list[tuple[str, Outcome]]:
    """All in one run; if that fails, each alone, which shows the cause."""
    together = ward.visit(kinds, place / "together")
    if together.kind != FAILED or len(kinds) == 1:
        return [(k.name, together) for k in kinds]
    return [(k.name, ward.visit([k], place / k.name)) for k in kinds]


if __name__ == "__main__":
    sys.exit(main())
