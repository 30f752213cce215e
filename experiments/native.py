"""Both lanes side by side: methods asked from Python, and the same libraries asked in C++: python -m experiments.native

The Python lane's net time is its gross time less the method's floor (its call on two tetrahedra far apart); the native lane's is less
what a call and two looks at the clock cost. Where the two differ by more than 30 %, WHY says what the binding adds or saves.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated, Optional

import numpy as np
import pandas as pd
import typer
from rich.console import Console

from baselines import native, registry
from ofg import Motion, Pose, Query

from .cases import shapes
from .cases.case import Case
from .cases.placement import any_direction, touching
from .cases.scenario import snap
from .run.config import TimingChoice
from .run.timing import COLUMNS, FLOOR, Bin, time_bin

FACES = (12, 80, 320, 1280)
SITUATIONS = ("apart", "overlapping", "flight")
LIMIT = 0.3  #: of the native time: a larger difference is explained

WHY = {  # engine: why its net Python time is not its native time
    "bullet": "pybullet makes two collision objects, a contact test and a list of points for each call, more than its floor holds; the native "
              "lane asks the GJK pair detector alone. The casts are the same code in both lanes; their floor holds the cast of two tetrahedra",
    "coal": "its floor, a call on tetrahedra, holds part of the test itself, which is most of it on cheap pairs",
    "fcl": "its floor holds part of the test on cheap pairs, and a hit costs more than a miss (python-fcl builds a list of contacts); where the "
           "ratio is below 1 on large bodies the wheel's FCL is faster than Debian's build of the same version",
    "mujoco": "its floor holds mj_kinematics and part of the test, which every query needs and the native time has",
    "ofg": "every prepared query has a workspace of its own, cold at each call, where the native lane shares one; its floor is nothing but "
           "the bounding spheres' test",
    "parry": "its floor, a call on tetrahedra, holds part of the test itself, which is most of it on cheap pairs",
}


def queries(faces: int, situation: str, n: int, rng: np.random.Generator) -> list[Query]:
    """n pairs of random hulls: 1e-3 to 1e-1 of the radius apart, 1e-3 to 3e-2 in each other, or about to fly into each other.

    Every body is another: prepared methods hold their own copies, so a shared one would be in the caches of one lane alone.
    """
    made = []
    for i in range(n):
        a, b = shapes.hull(faces, 2 * i), shapes.hull(faces, 2 * i + 1)
        gap = {"apart": 10 ** rng.uniform(-3, -1), "overlapping": -(10 ** rng.uniform(-3, -1.5)), "flight": rng.uniform(0.5, 2)}[situation]
        turn, position, normal = touching(rng, a, b, gap)
        motion = Motion(snap(-(gap + rng.uniform(0.1, 0.5)) * normal + 0.2 * any_direction(rng))) if situation == "flight" else Motion()
        made.append(Query("translation" if situation == "flight" else "overlap", a, b, Pose(turn, snap(position)), Pose(), motion))
    return made


def python_lane(names: list[str], asked: list[Query], timing: TimingChoice) -> pd.DataFrame:
    """A row per method: its hits, gross and floor in nanoseconds (medians over rounds, then over cases), by the runner's own protocol."""
    cases = [Case(str(i), "native", 0.0, i, query) for i, query in enumerate(asked)]
    everything = {case.id for case in cases}
    rows = pd.DataFrame(time_bin(Bin(asked[0].question, "", "", cases, {name: everything for name in names}), timing), columns=COLUMNS)
    rows["ns"] = [np.median(rounds) for rounds in rows.rounds_ns]
    hits = {name: [method.ready(query)().hit for query in asked]
            for name in names for method in registry.make(name)}
    median = rows.groupby(["method", rows.case == FLOOR]).ns.median()
    return pd.DataFrame([{"method": name, "hits": hits[name], "gross": median[name, False], "floor": median[name, True]} for name in names])


def native_lane(asked: list[Query], timing: TimingChoice, core: int | None) -> pd.DataFrame:
    """A row per engine: hits and net nanoseconds (medians over rounds, then over cases, less the floor's)."""
    rows = native.run(asked, timing.rounds, timing.warmup, core)
    rows["ns"] = rows.filter(like="round").median(axis=1)
    floor = rows[rows.engine == native.FLOOR].ns.median()
    groups = rows[rows.engine != native.FLOOR].sort_values("case").groupby("engine")
    return pd.DataFrame([{"method": engine, "hits": [bool(h) for h in group.hit], "native": group.ns.median() - floor} for engine, group in groups])


def compare(faces: int, situation: str, n: int, timing: TimingChoice, passes: int, seed: int, core: int | None) -> pd.DataFrame:
    """Both lanes on the same queries, in turns, medians over the passes. ratio: net Python over native; same: of how many cases both
    lanes say the same."""
    asked = queries(faces, situation, n, np.random.default_rng([seed, faces, SITUATIONS.index(situation)]))
    taken = [_both(asked, timing, core) for _ in range(passes)]
    both = taken[0][["method", "same"]].copy()
    for column in ("native", "gross", "floor"):
        both[column] = np.median([t[column] for t in taken], axis=0)
    both["net"] = both.gross - both.floor
    both["ratio"] = both.net / both.native
    both.insert(0, "faces", faces)
    both.insert(0, "situation", situation)
    return both


def _both(asked: list[Query], timing: TimingChoice, core: int | None) -> pd.DataFrame:
    there = native_lane(asked, timing, core)
    # py-parry3d has no shape cast, so parry's has no Python lane.
    present = [m for m in there.method if m.split()[0] in registry.methods() and not registry.available(type(registry.make(m)[0]))]
    both = there.merge(python_lane(present, asked, timing), on="method", how="left", suffixes=("", "_python"))
    both["same"] = [f"{np.sum(np.array(a) == np.array(b))}/{len(a)}" if isinstance(b, list) else "-" for a, b in zip(both.hits, both.hits_python)]
    return both


def main(
    cases: Annotated[int, typer.Option(min=1, help="pairs for each size and situation")] = 24,
    rounds: Annotated[int, typer.Option(min=3, help="timed rounds over all pairs, in each pass")] = 5,
    passes: Annotated[int, typer.Option(min=1, help="how often the lanes take turns")] = 3,
    seed: Annotated[int, typer.Option(help="of bodies and poses")] = 0,
    core: Annotated[int, typer.Option(help="the core to run on; -1: any")] = 0,
    out: Annotated[Optional[Path], typer.Option(help="folder for native.csv and native.md")] = None,
) -> None:
    """Build the native lane with what is found here, and time it beside the Python lane on the same pairs."""
    console = Console()
    try:
        plugins, missing = native.build()
    except native.NativeError as error:
        console.print(str(error), markup=False)
        raise typer.Exit(1)
    for line in missing:
        console.print(f"without {line}", markup=False, highlight=False)
    if core >= 0:
        os.sched_setaffinity(0, {core})
    timing = TimingChoice(rounds=rounds)
    parts = [compare(f, s, cases, timing, passes, seed, core if core >= 0 else None) for s in SITUATIONS for f in FACES]
    table = pd.concat(parts, ignore_index=True)
    text = page(table, plugins, missing)
    console.print(text, markup=False, highlight=False, soft_wrap=True)
    if out:
        out.mkdir(parents=True, exist_ok=True)
        table.to_csv(out / "native.csv", index=False)
        (out / "native.md").write_text(text + "\n")


def page(table: pd.DataFrame, plugins: list[str], missing: list[str]) -> str:
    """The tables, and a line for each engine whose lanes differ by more than LIMIT anywhere."""
    lines = ["Nanoseconds per query, medians over rounds and then over pairs. native: the library in C++, net. gross: from Python. net: gross less "
             "the method's floor. ratio: net / native. same: pairs on which both lanes say the same.", "",
             f"Native lane: {', '.join(plugins)}." + "".join(f"\nLeft out: {line}." for line in missing)]
    for (situation, faces), part in table.groupby(["situation", "faces"], sort=False):
        grid = part[["method", "native", "gross", "floor", "net", "ratio", "same"]].sort_values("native")
        lines += ["", f"## {situation}, {faces} faces each", "", grid.to_markdown(index=False, floatfmt=("", ".0f", ".0f", ".0f", ".0f", ".2f", ""))]
    far = table[(table.ratio - 1).abs() > LIMIT]
    lines += ["", f"## Where net and native differ by more than {LIMIT:.0%}", ""]
    for engine, part in far.groupby(far.method.str.split("[- ]").str[0]):
        lines.append(f"- {engine} ({part.ratio.min():.2f} to {part.ratio.max():.2f} in {len(part)} cells): {WHY.get(engine, 'not explained yet')}.")
    return "\n".join(lines)


if __name__ == "__main__":
    typer.run(main)
