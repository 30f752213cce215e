"""The native lane: the libraries themselves, asked the same cases in one interleaved C++ loop.

build() compiles what it finds; run(queries) times it. Bodies are convex (their hulls) or closed meshes; unions have no lane here.
One body moves here: where both translate it is asked about A's motion relative to B.
"""

from __future__ import annotations

import os
import shutil
import struct
import subprocess
import sysconfig
import tempfile
from pathlib import Path

import numpy as np
import pandas as pd

from ofg import QUESTIONS, Query

from ..frames import stated

SOURCE = Path(__file__).parent
FOLDER = SOURCE.parents[1] / "build" / "native"
FLOOR = "(floor)"  #: the engine that does nothing: two looks at the clock and a call


class NativeError(RuntimeError):
    """The lane cannot be built or run; the message says why and what to do."""


def build(folder: Path = FOLDER) -> tuple[list[str], list[str]]:
    """Compile what is found. Returns the plugins that stand, and a line for each that does not: what is missing, and the remedy."""
    cmake = shutil.which("cmake", path=os.pathsep.join([sysconfig.get_path("scripts"), os.environ.get("PATH", "")]))
    if not cmake:
        raise NativeError("The native lane needs cmake 3.20 or later; install it with: pip install cmake")
    site = sysconfig.get_path("platlib")
    _command([cmake, "-S", str(SOURCE), "-B", str(folder), f"-DSITE_PACKAGES={site}", "-DCMAKE_BUILD_TYPE=Release"])
    # One that fails to compile (an old compiler, no crates at hand) must not cost the others.
    outcome = subprocess.run([cmake, "--build", str(folder), "--parallel", "2", "--", "-k"], capture_output=True, text=True)
    plugins = _plugins(folder)
    missing = (folder / "missing.txt").read_text().splitlines()
    if not plugins or not (folder / "lane").is_file():
        raise NativeError(f"The native lane does not compile: {_last(outcome.stdout + outcome.stderr)}. It needs a C++20 compiler and make.")
    known = {p.stem for p in plugins} | {line.split(":")[0] for line in missing}
    missing += [f"{p.stem}: does not compile here" for p in SOURCE.glob("*.cpp") if p.stem not in known | {"main"}]
    return [p.stem for p in plugins], missing


def run(queries: list[Query], rounds: int = 15, warmup: int = 3, core: int | None = None, folder: Path = FOLDER) -> pd.DataFrame:
    """A row per engine and query: engine (named as the method of the Python lane), case (index of the query), hit, time, build
    (nanoseconds, of the whole engine), and round0, round1, ...: nanoseconds, gross. The floor's rows are named FLOOR.

    core: run on this one. ValueError for a union, Unsupported where both bodies turn.
    """
    if not (folder / "lane").is_file():
        raise NativeError("The native lane is not built; build it with: make native")
    with tempfile.TemporaryDirectory() as scratch:
        cases, results = Path(scratch, "cases"), Path(scratch, "results.csv")
        write(cases, queries)
        pin = None if core is None else lambda: os.sched_setaffinity(0, {core})
        _command([str(folder / "lane"), str(cases), str(results), str(warmup), str(rounds), *map(str, _plugins(folder))], preexec_fn=pin)
        return pd.read_csv(results)


def write(path: Path, queries: list[Query]) -> None:
    """The case file that `main.cpp` reads: each body once, then a case per query. Little-endian, no padding."""
    bodies: dict[str, int] = {}
    blocks, cases = [], []
    for query in (stated(query, movers=1, about=False) for query in queries):
        for body in (query.a, query.b):
            if body.kind == "union":
                raise ValueError(f"Body '{body.name}' is a union, which the native lane does not take; ask it about convex bodies and meshes.")
            if body.digest not in bodies:
                bodies[body.digest] = len(bodies)
                blocks.append(struct.pack("<II", len(body.vertices), len(body.faces)) + body.vertices.astype("<f8").tobytes()
                              + body.faces.astype("<i4").tobytes())
        motion = query.motion
        numbers = np.concatenate([query.pose_a.quaternion, query.pose_a.position, query.pose_b.quaternion, query.pose_b.position,
                                  motion.displacement, motion.axis, [motion.angle]])
        cases.append(struct.pack("<III", bodies[query.a.digest], bodies[query.b.digest], QUESTIONS.index(query.question))
                     + numbers.astype("<f8").tobytes())
    path.write_bytes(b"OFGLANE1" + struct.pack("<II", len(bodies), len(cases)) + b"".join(blocks) + b"".join(cases))


def _plugins(folder: Path) -> list[Path]:
    return sorted((folder / "plugins").glob("*.so"))


def _command(words: list[str], **options) -> None:
    outcome = subprocess.run(words, capture_output=True, text=True, **options)
    if outcome.returncode:
        raise NativeError(f"The native lane's {Path(words[0]).name} failed: {_last(outcome.stderr or outcome.stdout) or outcome.returncode}")


def _last(text: str) -> str:
    lines = text.strip().splitlines()
    return next((line for line in lines if "error" in line.lower()), lines[-1] if lines else "")
