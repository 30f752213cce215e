# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Run scenes in worlds at random start phases, and count the bodies that pass their obstacle."""

from __future__ import annotations

import math
import statistics
import zlib
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from time import perf_counter_ns

import numpy as np
import pandas as pd
from scipy.stats import binomtest

from baselines import registry

from .scene import SCENES, TRAVELS, Scene, turned
from .worlds import BulletWorld, KinematicWorld, MujocoWorld, RapierWorld


@dataclass(frozen=True)
class Contestant:
    """A world with one set of remedies. about: a description of them."""

    name: str
    make: Callable
    about: str


CONTESTANTS = (
    Contestant("bullet", BulletWorld, "default settings: multibodies"),
    Contestant(
        "bullet ccd",
        partial(BulletWorld, ccd=0.9),
        "ccdSweptSphereRadius on multibodies, where it is silently ignored",
    ),
    Contestant("bullet maximal", partial(BulletWorld, maximal=True), "useMaximalCoordinates only"),
    Contestant(
        "bullet maximal ccd",
        partial(BulletWorld, maximal=True, ccd=0.9),
        "swept sphere of 0.9 of the least half-extent, maximal coordinates",
    ),
    Contestant("mujoco", MujocoWorld, "default settings"),
    Contestant("mujoco margin 0.02", partial(MujocoWorld, margin=0.02), "geom margin 0.02 on both"),
    Contestant("mujoco margin 0.5", partial(MujocoWorld, margin=0.5), "geom margin 0.5 on both"),
    Contestant(
        "mujoco speculative", partial(MujocoWorld, speculative=True), "the speculative flag"
    ),
    # Of 20 boxes at 100 thicknesses 18 passed, 13 with stiff contacts; more solver iterations or
    # another integrator changed nothing.
    Contestant(
        "mujoco speculative stiff",
        partial(MujocoWorld, speculative=True, stiff=True),
        "the speculative flag, solref of two time steps",
    ),
    Contestant("rapier", RapierWorld, "default settings"),
    Contestant("rapier ccd", partial(RapierWorld, ccd=True), "ccd_enabled"),
    Contestant(
        "rapier soft ccd",
        partial(RapierWorld, ccd=True, soft=2.0),
        "ccd_enabled, soft_ccd_prediction of two steps' travel",
    ),
    *(
        Contestant(
            spec,
            partial(KinematicWorld, method=spec),
            f"kinematic loop that runs {spec} at every step",
        )
        for spec in (
            "ofg k=8",
            "ofg k=8 repairs=all",
            "ofg-verified",
            "ofg-verified-substeps n=1",
            "ofg-verified-substeps n=16",
            "fcl-convex-substeps n=1",
            "fcl-convex-substeps n=16",
            "rapier-cast",
            "mujoco-speculative",
        )
    ),
)


@dataclass(frozen=True)
class Run:
    tunnelled: bool
    nanoseconds: float  #: per step


def run(contestant: Contestant, scene: Scene, travel: float, rng: np.random.Generator) -> Run:
    """One translation, or rotation, with its own start phase, until an unhindered body would be
    past.
    """
    start, attitude = scene.start(travel, rng.uniform()), turned(rng, scene)
    world = contestant.make(scene, scene.per_step(travel) / _dt(contestant), start, attitude)
    steps = scene.steps(travel, world.cap)
    if hasattr(world, "prepare"):
        world.prepare(steps)
    progress, taken = start, 0
    for _ in range(steps):
        begin = perf_counter_ns()
        world.step()
        taken += perf_counter_ns() - begin
        progress = _unwrapped(scene, progress, world)
        if not math.isfinite(progress):
            break
    # Past the obstacle's middle; a world that blew up did not stop the body either.
    return Run(not progress < 0, taken / steps)


def measure(
    contestants, scenes=SCENES, travels=TRAVELS, runs: int = 40, seed: int = 0
) -> Iterator[dict]:
    """A row per contestant, scene and travel: tunnelled of runs, its Wilson interval, median
    time per step.
    """
    for scene in scenes:
        for contestant in contestants:
            for travel in travels:
                # The same start phases and attitudes for every contestant.
                rng = np.random.default_rng(
                    [seed, zlib.crc32(scene.name.encode()), round(travel * 1000)]
                )
                results = [run(contestant, scene, travel, rng) for _ in range(runs)]
                tunnelled = sum(r.tunnelled for r in results)
                low, high = binomtest(tunnelled, runs).proportion_ci(method="wilson")
                yield {
                    "scene": scene.name,
                    "contestant": contestant.name,
                    "travel": travel,
                    "runs": runs,
                    "tunnelled": tunnelled,
                    "share": tunnelled / runs,
                    "low": low,
                    "high": high,
                    "us_per_step": statistics.median(r.nanoseconds for r in results) / 1000,
                }


def table(rows: pd.DataFrame, scene: str) -> pd.DataFrame:
    """Tunnelled of the runs, a row per contestant and a column per travel, and the median cost of a
    step.
    """
    part = rows[rows.scene == scene]
    grid = part.pivot(index="contestant", columns="travel", values="tunnelled").loc[
        list(dict.fromkeys(part.contestant))
    ]
    grid.columns = [f"{travel:g}" for travel in grid.columns]
    grid["us/step"] = part.groupby("contestant").us_per_step.median().round(1)
    return grid.reset_index()


def absent(contestant: Contestant) -> str | None:
    """None if the contestant's engine can be imported here, else the reason and the remedy."""
    return registry.available(method_of(contestant))


def method_of(contestant: Contestant) -> type[registry.Method]:
    """A method of the contestant's engine."""
    keywords = getattr(contestant.make, "keywords", {})
    if "method" in keywords:
        return type(registry.make(keywords["method"])[0])
    make = getattr(contestant.make, "func", contestant.make)
    return {
        "pybullet": registry.methods()["bullet"],
        "mujoco": registry.methods()["mujoco"],
        "rapier3d": registry.methods()["rapier"],
    }[make.engine]


def _dt(contestant: Contestant) -> float:
    make = contestant.make
    return (make.func if isinstance(make, partial) else make).dt


def _unwrapped(scene: Scene, before: float, world) -> float:
    """Progress after a step; an angle is chosen nearest to the prediction from the world's own
    rate.
    """
    now = world.progress()
    if not scene.turns or not math.isfinite(now):
        return now
    expected = before + min(world.rate() * world.dt, world.cap)
    return (
        now + 2 * math.pi * round((expected - now) / (2 * math.pi))
        if math.isfinite(expected)
        else expected
    )
