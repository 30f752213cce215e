# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Garbage into the two extensions, built with the address and undefined-behaviour sanitizers: `make
fuzz-boundary`.

Usage: boundary.py FOLDER [calls] [seconds] [seed]. FOLDER holds the modules _core and _native.
Every call either answers or raises ValueError, TypeError or MemoryError; a sanitizer ends the
process with its report. Prints the counts.
"""

import importlib.util
import sys
import time
import warnings
from collections import Counter
from pathlib import Path

import numpy as np

ODD = (
    0.0,
    -0.0,
    1.0,
    -1.0,
    5e-324,
    1e-300,
    1e-60,
    1e-45,
    1e10,
    1e38,
    1e60,
    1e61,
    1e154,
    1e300,
    1.7e308,
    np.inf,
    -np.inf,
    np.nan,
)
WHOLE = (-(2**31), -1, 0, 1, 2, 3, 4, 7, 8, 20, 60, 61, 255, 256, 257, 10**6, 2**31 - 1)
STILL = ([1, 0, 0, 0], [0] * 3, [0] * 3, [0, 0, 1], 0.0, [0] * 3)


def loaded(folder: str, name: str):
    (path,) = Path(folder).rglob(f"{name}.*.so")
    spec = importlib.util.spec_from_file_location(name, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


class Garbage:
    """Arrays and numbers, mostly right, so that what is behind a check is reached too."""

    def __init__(self, seed: int):
        self.random = np.random.default_rng(seed)

    def often(self, share: float) -> bool:
        return self.random.random() < share

    def number(self) -> float:
        return float(self.random.choice(ODD)) if self.often(0.15) else float(self.random.normal())

    def whole(self) -> int:
        return (
            int(self.random.choice(WHOLE)) if self.often(0.1) else int(self.random.integers(0, 4))
        )

    def array(self, rows: int, columns: int) -> np.ndarray:
        made = self.random.normal(size=(rows, columns))
        if self.often(0.2):
            made = np.round(made)
        if self.often(0.1):
            made = made * 10.0 ** self.random.integers(-70, 70)
        for _ in range(self.random.integers(1, 4) if self.often(0.15) and made.size else 0):
            made.flat[self.random.integers(made.size)] = self.random.choice(ODD)
        return self.strange(made)

    def strange(self, a: np.ndarray):
        """Seldom of another shape, type or layout."""
        if self.often(0.93):
            return a
        forms = (
            lambda: a[:0],
            lambda: a.ravel(),
            lambda: a[:, :-1],
            lambda: np.asfortranarray(a),
            lambda: a[::2],
            lambda: a.astype(np.float32),
            lambda: a.astype(object),
            lambda: a.tolist(),
            lambda: None,
            lambda: a[None],
            lambda: a.astype(np.complex128),
            lambda: a.astype(">f8"),
            lambda: np.hstack([a, a]),
            lambda: np.zeros((0, 3)),
            lambda: "x",
            lambda: a.astype(np.int64, casting="unsafe"),
        )
        return forms[self.random.integers(len(forms))]()

    def mesh(self) -> tuple:
        n, m = int(self.random.integers(1, 40)), int(self.random.integers(1, 40))
        faces = self.random.integers(0, n, (m, 3)).astype(np.int32)
        if self.often(0.1):
            faces.flat[self.random.integers(faces.size)] = self.random.choice(WHOLE)
        return self.array(n, 3), self.strange(faces)

    def poses(self, n: int) -> np.ndarray:
        return self.array(n, 7)

    def motions(self, n: int):
        made = self.array(n, 10)
        if isinstance(made, np.ndarray) and made.ndim == 2 and self.often(0.5):
            made[:, :3] *= 0
        return made


class Calls:
    """Each method makes one call."""

    def __init__(self, core, native, seed: int):
        self.core, self.native, self.g = core, native, Garbage(seed)
        self.solids, self.proved, self.movers = [], [], [native.Mover(*STILL)]
        self.hulls, self.cache = [], core.Cache()

    def solid(self):
        pieces = [self.g.mesh() for _ in range(self.g.random.integers(0, 3))]
        pf = [f for _, f in pieces][: -1 if self.g.often(0.02) else None]
        self._keep(
            self.solids,
            self.core.Solid(*self.g.mesh(), self.g.often(0.5), [v for v, _ in pieces], pf),
        )

    def of_mesh(self):
        self._keep(self.proved, self.native.Solid.of_mesh(*self.g.mesh()))

    def of_pieces(self):
        self._keep(
            self.proved,
            self.native.Solid.of_pieces(
                [self.g.mesh()[0] for _ in range(self.g.random.integers(0, 4))]
            ),
        )

    def mover(self):
        parts = [[self.g.number() for _ in range(n)] for n in (4, 3, 3, 3)]
        self._keep(
            self.movers,
            self.native.Mover(*parts, self.g.number(), [self.g.number() for _ in range(3)]),
        )

    def _keep(self, kept: list, made) -> None:
        kept.append(made)
        del kept[:-16]

    def one(self, kept: list):
        return kept[self.g.random.integers(len(kept))] if kept and self.g.often(0.995) else None

    def options(self):
        o = self.core.Options()
        for name in (
            "k",
            "toi",
            "broad",
            "concave",
            "nearest",
            "order",
            "iterations",
            "piece_times",
            "selection_times",
        ):
            if self.g.often(0.5):
                setattr(o, name, max(1, self.g.whole()) if self.g.often(0.9) else self.g.whole())
        for name in (
            "adaptive_k",
            "both_vertices",
            "edge_edge",
            "containment",
            "earliest",
            "screen",
            "end_moment",
        ):
            setattr(o, name, self.g.often(0.5))
        if self.g.often(0.2):
            o.arc_tolerance = self.g.number()
        if 0 < o.arc_tolerance < 1:  # millions of parts of a step are no fault, but take minutes
            o.arc_tolerance = 0.0
        return o

    def ask_many(self):
        n = int(self.g.random.integers(0, 4))
        rows = (self.g.poses(n), self.g.poses(n), self.g.motions(n), self.g.motions(n))
        self.core.ask_many(
            self.one(self.solids),
            self.one(self.solids),
            *rows,
            self.options(),
            self.g.whole(),
            self.g.often(0.5),
            self.g.often(0.5),
            self.threads(),
        )

    def hull(self):
        meshes = [self.g.mesh() for _ in range(self.g.random.integers(0, 3))]
        closed = self.g.often(0.1)
        if closed:
            meshes = [self.surface()] if self.g.often(0.9) else meshes
        faces = [f for _, f in meshes][: -1 if self.g.often(0.02) else None]
        self._keep(self.hulls, self.core.VerifiedSolid([v for v, _ in meshes], faces, closed))

    def surface(self) -> tuple:
        """Each face with its reverse, so that no edge is left over."""
        v, f = self.g.mesh()
        whole = isinstance(f, np.ndarray) and f.ndim == 2 and f.dtype == np.int32
        return v, np.vstack([f, f[:, ::-1]]) if whole else f

    def verified_many(self):
        n = int(self.g.random.integers(0, 4))
        self.core.verified_many(
            self.one(self.hulls),
            self.one(self.hulls),
            self.g.poses(n),
            self.g.poses(n),
            self.cache if self.g.often(0.5) else None,
            self.g.often(0.5),
            self.threads(),
        )

    def prepared_verified(self):
        pair = self.one(self.hulls), self.one(self.hulls)
        made = self.core.PreparedVerified(*pair, self.g.poses(2), self.g.often(0.5))
        made(), made()

    def verified_sweep_many(self):
        n = int(self.g.random.integers(0, 4))
        rows = (self.g.poses(n), self.g.poses(n), self.g.motions(n), self.g.motions(n))
        pair = self.one(self.hulls), self.one(self.hulls)
        self.core.verified_sweep_many(*pair, *rows, self.threads())

    def prepared_verified_sweep(self):
        pair = self.one(self.hulls), self.one(self.hulls)
        made = self.core.PreparedVerifiedSweep(*pair, self.g.poses(2), self.g.motions(2))
        made(), made()

    def threads(self) -> int:
        return self.g.whole() if self.g.often(0.02) else 1

    def prepared(self):
        rows = self.g.poses(2), self.g.motions(2)
        made = self.core.Prepared(
            self.one(self.solids),
            self.one(self.solids),
            *rows,
            self.options(),
            self.g.whole(),
            self.g.often(0.5),
            self.g.often(0.5),
        )
        made(), made()

    def strays(self):
        self.core.strays(
            self.one(self.solids),
            self.one(self.solids),
            self.g.poses(2),
            self.g.motions(2),
            self.g.number(),
        )

    def least_points(self):
        self.core.least_points(self.one(self.solids), self.g.array(4, 3))

    def triangles(self):
        (self.core.triangles_meet if self.g.often(0.5) else self.core.triangles_meet_float)(
            self.g.array(3, 18)
        )

    def set_isa(self):
        self.core.set_isa(self.g.whole())

    def pair(self):
        seeds = {
            (self.g.whole(), self.g.whole()): self.native.Seed(self.g.whole(), self.g.number())
            for _ in range(self.g.random.integers(0, 2))
        }
        return (
            self.native.Pair(self.one(self.movers), self.one(self.movers)),
            self.one(self.proved),
            self.one(self.proved),
            seeds,
        )

    def limit(self) -> float:
        return (
            self.g.number() if self.g.often(0.05) else float(self.g.random.choice((0, 100, 3000)))
        )

    def instant(self):
        pair, a, b, seeds = self.pair()
        self.native.instant(
            pair, a, b, self.g.number() if self.g.often(0.2) else 0.0, min(self.limit(), 1e4), seeds
        )

    def sweep(self):
        pair, a, b, seeds = self.pair()
        self.native.sweep(pair, a, b, min(self.limit(), 1e4), seeds)


def main(folder: str, calls: int = 10**6, seconds: float = 1e9, seed: int = 1) -> None:
    warnings.simplefilter("ignore")
    made = Calls(loaded(folder, "_core"), loaded(folder, "_native"), seed)
    shares = {
        "solid": 2,
        "hull": 2,
        "verified_many": 4,
        "prepared_verified": 2,
        "verified_sweep_many": 4,
        "prepared_verified_sweep": 2,
        "of_mesh": 2,
        "of_pieces": 2,
        "mover": 3,
        "ask_many": 6,
        "prepared": 4,
        "strays": 1,
        "least_points": 1,
        "triangles": 1,
        "set_isa": 0.1,
        "instant": 2,
        "sweep": 1,
    }
    names, weights = list(shares), np.array(list(shares.values()))
    begin, done, count = time.monotonic(), 0, Counter()
    while done < calls and time.monotonic() - begin < seconds:
        for name in made.g.random.choice(names, min(1000, calls - done), p=weights / weights.sum()):
            try:
                getattr(made, name)()
                count[name, "answered"] += 1
            except (ValueError, TypeError, MemoryError, OverflowError):
                count[name, "refused"] += 1
            done += 1
    for name in names:
        print(f"{name}: {count[name, 'answered']} answered, {count[name, 'refused']} refused")
    print(
        f"{done} calls, {sum(n for (_, what), n in count.items() if what == 'refused')} of them"
        " refused: no fault"
    )


if __name__ == "__main__":
    main(sys.argv[1], *(kind(word) for kind, word in zip((int, float, int), sys.argv[2:])))
