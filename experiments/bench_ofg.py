"""Time per step of OFG, by size and k, beside the native engines in the same run: `python -m experiments.bench_ofg`.

Builds ofg/bench with cmake, against FCL and Bullet where Debian's libfcl-dev and libbullet-dev are installed and MuJoCo from its wheel;
Coal and parry are asked through their plugins of the native lane. What is missing is listed and left out. "OFG k=8" goes through the eight steps for every pair. "screened" lets a plane between the whole
bodies settle those that are apart first (the same answers); "in batch" asks all pairs in one call. All methods are asked the same pairs in interleaved rounds on one core; a ratio is the median
over rounds of the quotient within a round, so that a busy machine slows both sides of it.
"""

from __future__ import annotations

import argparse
import io
import os
import shutil
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pandas as pd
import trimesh

import ofg
from baselines import native
from ofg import Body

ROOT = Path(__file__).parents[1]
COMPARED = (
    *("OFG double k=8 screened in batch", "OFG float k=8 screened in batch", "OFG double k=8 screened", "OFG double k=8"),
    *("OFG double repaired screened in batch", "OFG double repaired", "OFG double k=all"),
)
LANE = ("coal", "parry")  # plugins of baselines/native that are asked here too
ENGINES = (
    *("FCL libccd", "FCL indep", "Bullet GjkPair", "Bullet GjkEpa2", "MuJoCo native"),
    *("MuJoCo libccd", "coal-convex", "coal-convex-exact", "parry"),
)


def bodies(rng: np.random.Generator) -> dict[str, tuple[Body, Body]]:
    """Pairs by name: cubes, icospheres and random hulls (points on a sphere) of 12 to 5,120 faces."""

    def hull(faces):
        v = rng.normal(size=(faces // 2 + 2, 3))
        return Body.convex(v / np.linalg.norm(v, axis=1)[:, None])

    cube = Body.convex(np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float) / np.sqrt(3))
    ico = {20 * 4**i: Body.from_trimesh(trimesh.creation.icosphere(subdivisions=i)) for i in (1, 2, 3, 4)}
    pairs = {"12-cube": (cube, cube), "12-hull": (hull(12), hull(12))}
    for faces in (80, 320, 1280, 5120):
        pairs |= {f"{faces}-hull": (hull(faces), hull(faces)), f"{faces}-ico": (ico[faces], ico[faces])}
    return pairs


def poses(rng: np.random.Generator, a: Body, b: Body, low: float, high: float, n: int) -> np.ndarray:
    """(n, 14): random orientations and directions, B at a gap along the direction drawn log-uniformly from low to high of the radius
    (negative: depth). Contact along the direction is found by bisection with OFG in full: it places the pairs, and judges nothing.
    """
    pa, pb = (np.column_stack([rng.normal(size=(n, 4)), np.zeros((n, 3))]) for _ in range(2))
    d = rng.normal(size=(n, 3))
    d /= np.linalg.norm(d, axis=1)[:, None]
    near, far = np.zeros(n), np.full(n, 2.01 * (a.radius + b.radius) / 2)
    for _ in range(40):
        middle = (near + far) / 2
        pb[:, 4:] = d * middle[:, None]
        hit = ofg.discrete_many(a, b, pa, pb, adaptive_k=True, containment=True).hit
        near, far = np.where(hit, middle, near), np.where(hit, far, middle)
    gap = np.exp(rng.uniform(np.log(abs(low)), np.log(abs(high)), n)) * np.sign(low)
    pb[:, 4:] = d * (far + gap)[:, None]
    return np.hstack([pa, pb])


SITUATIONS = {"gap": (1e-3, 1e-1), "shallow": (-1e-3, -3e-2)}


def write_cells(path: Path, pairs: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    with open(path, "w") as file:
        for name, (a, b) in bodies(rng).items():
            n = pairs if len(a.faces) < 1280 else pairs // 4  # some engines take a millisecond a pair there
            for situation, (low, high) in SITUATIONS.items():
                file.write(f"{name}/{situation} {n}\n")
                for body in (a, b):
                    file.write(f"{len(body.vertices)} {len(body.faces)}\n")
                    np.savetxt(file, body.vertices, fmt="%.17g")
                    np.savetxt(file, body.faces, fmt="%d")
                np.savetxt(file, poses(rng, a, b, low, high, n), fmt="%.17g")


def build(folder: Path) -> Path:
    cmake = shutil.which("cmake", path=os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]]))
    if cmake is None:
        raise SystemExit("bench-ofg needs cmake, which is not installed: pip install cmake.")
    mujoco = find_spec("mujoco")
    where = str(Path(mujoco.origin).parent) if mujoco else ""
    for command in ([cmake, "-S", ROOT / "ofg/bench", "-B", folder, f"-DMUJOCO_DIR={where}"], [cmake, "--build", folder, "-j2"]):
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode:
            raise SystemExit(f"bench-ofg could not be built:\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return folder / "bench"


def plugins() -> list[Path]:
    """The plugins of LANE that can be built here."""
    try:
        built, _ = native.build()
    except native.NativeError:
        return []
    return [native.FOLDER / "plugins" / f"{name}.so" for name in LANE if name in built]


def measure(program: Path, cells: Path, rounds: int, isa: str | None) -> pd.DataFrame:
    core = min(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else None
    pin = (lambda: os.sched_setaffinity(0, {core})) if core is not None else None
    done = subprocess.run([program, cells, str(rounds), isa or "-", *plugins()], capture_output=True, text=True, preexec_fn=pin)
    if done.returncode:
        raise SystemExit(f"bench-ofg stopped: {done.stderr}")
    rows = pd.read_csv(io.StringIO(done.stdout))
    rows[["bodies", "situation"]] = rows["cell"].str.split("/", expand=True)
    return rows


def steps(rows: pd.DataFrame) -> pd.DataFrame:
    """ns per step of the algorithm: differences of runs that stop after a step, medians over rounds."""
    table = []
    for (cell, method), _ in rows[rows["method"].str.fullmatch(r"OFG \w+ k=\d+")].groupby(["cell", "method"], sort=False):
        own = rows[rows["cell"] == cell].pivot(index="round", columns="method", values="nanoseconds")
        to = [own[f"{method} to step 1"], own[f"{method} to step 3"], own[f"{method} to step 6"], own[method]]
        table.append(
            {
                "cell": cell,
                "method": method,
                "1 spheres": to[0].median(),
                "2-3 select A": (to[1] - to[0]).median(),
                "4-6 select B": (to[2] - to[1]).median(),
                "7-8 face pairs": (to[3] - to[2]).median(),
                "all": to[3].median(),
                "hits": int(rows[(rows["cell"] == cell) & (rows["method"] == method)]["hits"].iloc[0]),
            }
        )
    return pd.DataFrame(table)


def engines_of(methods) -> list[str]:
    """The engines among methods: those of ENGINES first, then whatever else is not OFG."""
    others = [m for m in methods if m not in ENGINES and not m.startswith("OFG")]
    return [e for e in ENGINES if e in methods] + others


def ratios(rows: pd.DataFrame, method: str) -> pd.DataFrame:
    """Median over rounds of `method` / engine within the round; `fastest` is against the engine with the least median in that cell."""
    table = []
    for cell, own in rows.groupby("cell", sort=False):
        own = own.pivot(index="round", columns="method", values="nanoseconds")
        if method not in own:  # all faces are asked of bodies up to 320 faces only
            continue
        engines = engines_of(list(own))
        quotient = {e: (own[method] / own[e]).median() for e in engines}
        fastest = min(engines, key=lambda e: own[e].median(), default=None)
        table.append(
            {"cell": cell, "ns": own[method].median(), **quotient, "fastest": fastest, "ratio to it": quotient.get(fastest)}
        )
    return pd.DataFrame(table)


def errors(rows: pd.DataFrame, asked: dict[str, int]) -> pd.DataFrame:
    """Share of pairs answered wrong: pairs are placed 1e-3 of the radius or more from touching, so all have a sure answer."""
    wrong = rows.groupby(["cell", "method"], sort=False)["hits"].first().unstack()
    for cell in wrong.index:
        if cell.endswith("/shallow"):
            wrong.loc[cell] = asked[cell] - wrong.loc[cell]
    return 100 * wrong.div(pd.Series(asked).reindex(wrong.index), axis=0)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--pairs", type=int, default=512, help="pairs of poses per cell; a quarter from 1,280 faces on")
    parser.add_argument("--rounds", type=int, default=11)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument(
        "--isa", choices=("sse2", "avx2", "avx512"), help="instruction set of OFG; the machine's widest if not given"
    )
    parser.add_argument("--build", type=Path, default=ROOT / "build/bench_ofg")
    parser.add_argument("--out", type=Path, help="write rows.csv and tables.md into this folder, too")
    a = parser.parse_args()
    program = build(a.build)
    cells = a.build / "cells.txt"
    write_cells(cells, a.pairs, a.seed)
    asked = {line.split()[0]: int(line.split()[1]) for line in open(cells) if "/" in line}
    rows = measure(program, cells, a.rounds, a.isa)
    missing = [e for e in ENGINES if e not in set(rows["method"])]
    head = (
        f"{a.pairs} pairs per cell (a quarter from 1,280 faces on), {a.rounds} rounds, seed {a.seed}, load {os.getloadavg()[0]:.1f} "
        f"on {os.cpu_count()} cores of {processor()}. "
        + (f"Not found, so left out: {', '.join(missing)}." if missing else "")
    )
    tables = {"Time per step, ns per query": steps(rows).round(0)}
    tables |= {f"{method} over each engine, time per query": ratios(rows, method) for method in COMPARED}
    wanted = [m for m in rows["method"].unique() if "to step" not in m]
    tables["Wrong answers, % of pairs"] = errors(rows, asked)[wanted].T.reset_index()
    print(head)
    pd.set_option("display.width", 250, "display.max_columns", 30, "display.max_rows", 500)
    for title, table in tables.items():
        print(f"\n{title}\n" + table.to_string(index=False, float_format=lambda x: f"{x:.3g}"))
    if a.out:
        write(a.out, rows, head, tables)


def write(folder: Path, rows: pd.DataFrame, head: str, tables: dict[str, pd.DataFrame]) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    rows.to_csv(folder / "rows.csv", index=False)
    parts = ["# Time of OFG by step, size and k, beside the native engines", "`make bench-ofg`: " + head]
    parts += [f"## {title}\n\n{table.to_markdown(index=False, floatfmt='.3g')}" for title, table in tables.items()]
    (folder / "tables.md").write_text("\n\n".join(parts) + "\n")


def processor() -> str:
    lines = Path("/proc/cpuinfo").read_text().splitlines() if Path("/proc/cpuinfo").exists() else []
    return next((line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), "unknown make")


if __name__ == "__main__":
    main()
