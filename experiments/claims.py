"""The claims of Kara's article, measured against certified truth: `python -m experiments.claims [--cases 200] [--out claims.md]`.

1. "a higher k is more accurate; small faces need a higher k": misses against k, from 12 to 5,120 faces, shallow and deep.
2. "k^2 operations after selection instead of n m": what was counted, as shares of the bounds.
3. When it pays against testing all pairs: time of OFG over time of all pairs, by size and k.
4. Speed over thickness, angle per step, and concavity: misses on the scenario families that vary them, as written and repaired.
5. Time of impact: both estimates against the certified brackets.
Only certified cases are counted; what the prover leaves uncertain is named.
"""

from __future__ import annotations

import argparse
import time
from pathlib import Path

import numpy as np
import pandas as pd

import ofg
from ofg import Motion, Pose, Query

from . import scenarios, shapes
from .metrics import wilson
from .scenario import snap
from .scenarios._place import touching
from .truth import label

FACES = (12, 80, 320, 1280, 5120)
KS = (4, 8, 16, 64)
ALL = 2**31 - 1
DEPTHS = {"shallow (1e-3 to 3e-2 of the radius)": (1e-3, 3e-2), "deep (0.1 to 1)": (0.1, 1.0)}


def rate(missed: int, total: int) -> str:
    low, high = wilson(missed, total)
    return f"{100 * missed / total:.1f} % [{100 * low:.1f}, {100 * high:.1f}] of {total}" if total else "-"


def overlapping(faces: int, low: float, high: float, n: int, rng: np.random.Generator) -> list[Query]:
    """Certified overlaps of random hulls, placed by contact feature at a depth drawn log-uniformly."""
    hits = []
    for i in range(n):
        a, b = shapes.hull(faces, 2 * (i % 8)), shapes.hull(faces, 2 * (i % 8) + 1)
        turn, position, _ = touching(rng, a, b, -np.exp(rng.uniform(np.log(low), np.log(high))))
        query = Query("overlap", a, b, Pose(snap(turn), snap(position)), Pose())
        if label(query).label == "hit":
            hits.append(query)
    return hits


def accuracy(cases: int, rng) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Claim 1 and, for the same queries, claim 2."""
    misses, operations = [], []
    for faces in FACES:
        for depth, (low, high) in DEPTHS.items():
            hits = overlapping(faces, low, high, cases if faces < 5120 else cases // 4, rng)
            row = {"faces": faces, "depth": depth}
            for k in (*(k for k in KS if k < faces), ALL):
                answers = [ofg.ask(q, k=k) for q in hits]
                row[f"k={k}" if k < ALL else "k=all"] = rate(sum(not a.hit for a in answers), len(hits))
                full = min(k, faces) ** 2
                pairs = [a.counts["face_pairs"] / full for a in answers]
                operations.append(
                    {
                        "faces": faces,
                        "depth": depth,
                        "k": min(k, faces),
                        "distances / (n + m)": np.mean([a.counts["distances"] / (2 * faces) for a in answers]),
                        "computed / (n + m)": np.mean([a.counts["evaluated"] / (2 * faces) for a in answers]),
                        "face pairs / k^2, mean": np.mean(pairs),
                        "most": np.max(pairs),
                        "full tests, mean": np.mean([a.counts["full_tests"] for a in answers]),
                    }
                )
            row["repairs=all"] = rate(sum(not ofg.ask(q, repairs="all").hit for q in hits), len(hits))
            misses.append(row)
    return pd.DataFrame(misses), pd.DataFrame(operations)


def pays(rng, n: int = 200, rounds: int = 5) -> pd.DataFrame:
    """Claim 3: paired ratios, interleaved, on pairs 1e-3 to 1e-1 of the radius apart: where nothing can stop early."""
    rows = []
    for faces in FACES:
        a, b = shapes.hull(faces, 0), shapes.hull(faces, 1)
        m = n if faces < 1280 else 8
        placed = [touching(rng, a, b, np.exp(rng.uniform(np.log(1e-3), np.log(1e-1)))) for _ in range(m)]
        poses = np.array([[*turn, *position] for turn, position, _ in placed])
        ratios = {k: [] for k in (*KS, ALL)}
        for _ in range(rounds):
            brute = timed(lambda: ofg.brute_force_many(a, b, poses, Pose()))
            for k in ratios:
                ratios[k].append(timed(lambda: ofg.discrete_many(a, b, poses, Pose(), k=k)) / brute)
        rows.append({"faces": faces, **{f"k={k}" if k < ALL else "k=all": np.median(r) for k, r in ratios.items()}})
    return pd.DataFrame(rows)


def timed(call) -> float:
    start = time.process_time()
    call()
    return time.process_time() - start


VARIANTS = {
    "as written": {},
    "k=16": {"k": 16},
    "k=all": {"k": ALL},
    "step 1 at the start": {"broad": "start"},
    "repairs=all": {"repairs": "all"},
}
CONCAVE = {
    "object": {},
    "undivided": {"concave": "undivided"},
    "all pairs of pieces": {"concave": "all-pairs"},
    "repairs=all": {"repairs": "all"},
}
FAMILIES = {
    "thin_wall": VARIANTS,
    "screw_wall": VARIANTS,
    "rotational_contact": VARIANTS,
    "spin_side": VARIANTS,
    "hooked_ls": CONCAVE,
    "linked_tori": CONCAVE,
    "concave_rotation": CONCAVE,
}


def families(cases: int, seed: int) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Claim 4, by family and level, and claim 5 over the sweeps among them and `contact`."""
    rows, impacts = [], []
    for name in (*FAMILIES, "contact"):
        scenario = scenarios.get(name)
        for level in scenario.levels:
            certified = [(c.query, label(c.query)) for c in (scenario.case(seed, level, i) for i in range(cases))]
            hits = [(q, t) for q, t in certified if t.label == "hit"]
            uncertain = sum(t.label == "uncertain" for _, t in certified)
            if name in FAMILIES:
                row = {"family": name, "level": f"{level:g}", "axis": scenario.axis, "uncertain": uncertain}
                for variant, options in FAMILIES[name].items():
                    row[variant] = rate(sum(not ofg.ask(pieces(q, options), **options).hit for q, _ in hits), len(hits))
                rows.append(row)
            if scenario.question != "overlap":
                impacts += [error for q, t in hits for error in time_errors(name, q, t)]
    return pd.DataFrame(rows), pd.DataFrame(impacts)


def pieces(q: Query, options: dict) -> Query:
    if (
        options.get("concave") == "undivided" or options.get("repairs") == "all"
    ):  # as the method does: adaptive k needs no convexity
        return q
    return Query(q.question, ofg.decompose(q.a), ofg.decompose(q.b), q.pose_a, q.pose_b, q.motion)


def time_errors(family: str, q: Query, truth):
    """Signed error of each estimate against its bracket; only hits that the variant found and gave a time."""
    variants = {
        "velocity": {},
        "bisection": {"toi": "bisection"},
        "repairs=all, velocity": {"repairs": "all"},
        "repairs=all, bisection": {"repairs": "all", "toi": "bisection"},
    }
    for name, options in variants.items():
        t = ofg.ask(pieces(q, options), **options).time
        if not np.isnan(t):
            yield {"family": family, "estimate": name, "error": t - truth.t_hi if t > truth.t_hi else min(0.0, t - truth.t_lo)}


def impact_table(errors: pd.DataFrame) -> pd.DataFrame:
    groups = errors.groupby(["family", "estimate"], sort=False)["error"]
    return groups.agg(times="size", median_size=lambda e: e.abs().median(), latest="max", earliest="min").reset_index()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument(
        "--cases", type=int, default=200, help="cases per cell; a quarter at 5,120 faces, a fifth per level of a family"
    )
    parser.add_argument("--seed", type=int, default=2004)
    parser.add_argument("--out", type=Path, help="write the tables here as Markdown")
    a = parser.parse_args()
    rng = np.random.default_rng(a.seed)
    misses, operations = accuracy(a.cases, rng)
    by_family, impacts = families(max(a.cases // 5, 2), a.seed)
    parts = [
        ("1. Misses against k (Wilson 95 %), discrete, random hulls", misses),
        ("2. Operations", operations),
        ("3. Time over that of all pairs of faces (batched, no Python in it), separated pairs", pays(rng)),
    ]
    parts += [
        (f"4. Misses in {name}: {table['axis'].iloc[0]}", table[["level", "uncertain", *FAMILIES[name]]])
        for name, table in by_family.groupby("family", sort=False)
    ]
    parts.append(("5. Time of impact: error against the certified bracket, in steps", impact_table(impacts)))
    text = "\n\n".join(f"### {title}\n\n{table.to_markdown(index=False, floatfmt='.3g')}" for title, table in parts)
    print(text)
    if a.out:
        a.out.write_text(text + "\n")


if __name__ == "__main__":
    main()
