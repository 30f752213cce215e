# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""`python -m experiments.truth.audit.bench`: certified labels per second on the mix of a preset
(default: standard, else quick).

The measured time covers everything except drawing the case: preparing its bodies, proving, building
the certificate, and checking it. The cases are labelled in chunks, as in a run, by the requested
number of processes (default 2), each timed over all its chunks; the rate is summed over processes.
Times are processor seconds, and for each chunk the fastest of --rounds rounds, so that a busy
machine disturbs them less; bodies are prepared afresh in each round. Cases whose label is
"uncertain" count as labelled and are shown.
"""

from __future__ import annotations

import argparse
import time
import tomllib
from collections import Counter, defaultdict
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

from tabulate import tabulate

from experiments.cases import families
from experiments.truth import check_many, prove
from experiments.truth.check import geometry
from experiments.truth.prove import prover

CHUNK = 64


def draw_cases(preset: str, share: int, shares: int, cases: int | None):
    """[(scenario, query)] of every `shares`-th case of the preset."""
    config = tomllib.loads((Path(__file__).parents[2] / "presets" / f"{preset}.toml").read_text())
    drawn = []
    for choice in config["scenarios"]:
        scenario = families.get(choice["name"])
        for level in choice.get("levels", scenario.levels):
            drawn += [(scenario, level, i) for i in range(cases or choice["cases"])]
    return [
        (s.name, s.case(config.get("seed", 0), level, i).query)
        for s, level, i in drawn[share::shares]
    ]


def measure(preset: str, share: int, shares: int, cases: int | None, rounds: int):
    """Seconds to prove and to check, and the number of labels, by scenario and question."""
    drawn = defaultdict(list)
    for name, query in draw_cases(preset, share, shares, cases):
        drawn[name, query.question].append(query)
    rows = {}
    for key, queries in drawn.items():
        proving = checking = 0.0
        labels = Counter()
        for first in range(0, len(queries), CHUNK):
            chunk = queries[first : first + CHUNK]
            best = (float("inf"), float("inf"))
            for _ in range(rounds):
                for cache in (prover.solids, *geometry.CACHES):
                    cache.clear()
                t0 = time.process_time()
                truths = [prove(q) for q in chunk]
                t1 = time.process_time()
                checks = check_many(list(zip(chunk, truths)))
                best = min(best, (t1 - t0, time.process_time() - t1), key=sum)
            proving, checking = proving + best[0], checking + best[1]
            labels.update(t.label if c.ok else "refused" for t, c in zip(truths, checks))
        rows[key] = len(queries), proving, checking, labels
    return rows


def main():
    known = sorted(p.stem for p in (Path(__file__).parents[2] / "presets").glob("*.toml"))
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "--preset", choices=known, default="standard" if "standard" in known else "quick"
    )
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--cases", type=int, help="cases per level instead of the preset's")
    parser.add_argument("--rounds", type=int, default=3)
    args = parser.parse_args()
    with ProcessPoolExecutor(args.workers) as pool:
        shares = [
            pool.submit(measure, args.preset, i, args.workers, args.cases, args.rounds)
            for i in range(args.workers)
        ]
        results = [share.result() for share in shares]
    table, total = [], defaultdict(lambda: [0, 0.0, 0.0, 0.0])
    for key in sorted(set().union(*results), key=lambda k: (k[1], k[0])):
        parts = [r[key] for r in results if key in r]
        n, proving, checking = (sum(p[i] for p in parts) for i in range(3))
        labels = sum((p[3] for p in parts), Counter())
        group = "overlap" if key[1] == "overlap" else "sweep"
        total[group] = [x + y for x, y in zip(total[group], (n, proving, checking, 0.0))]
        table.append(
            [
                *key,
                n,
                1e3 * proving / n,
                1e3 * checking / n,
                labels["hit"],
                labels["clear"],
                labels["uncertain"],
                labels["refused"],
            ]
        )
    print(f"preset {args.preset}, {args.workers} processes; milliseconds per label on one core")
    print(
        tabulate(
            table,
            [
                "scenario",
                "question",
                "labels",
                "prove ms",
                "check ms",
                "hit",
                "clear",
                "uncertain",
                "refused",
            ],
            floatfmt=".3f",
        )
    )
    for group, target in (("overlap", 10_000), ("sweep", 500)):
        n, proving, checking, _ = total[group]
        if n:
            rate = args.workers * n / (proving + checking)
            print(
                f"{group}: {rate:,.0f} labels/s on {args.workers} processes (goal {target:,});"
                f" prove {1e3 * proving / n:.3f} ms + check {1e3 * checking / n:.3f} ms. Included:"
                " preparing bodies, proving, certificate, check. Not included: drawing the case."
            )


if __name__ == "__main__":
    main()
