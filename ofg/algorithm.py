"""OFG as functions: one query, or many poses of one pair of bodies in one call."""

from __future__ import annotations

import os
from collections import OrderedDict
from typing import Sequence

import numpy as np

from . import _core
from .answer import Answer, Answers
from .body import Body
from .motion import Motion
from .options import core_options
from .pose import Pose
from .query import Query

OFG, BRUTE_FORCE = 0, 1
_SOLIDS: OrderedDict[str, _core.Solid] = OrderedDict()
_KEPT_SOLIDS = 256


def discrete(a: Body, b: Body, pose_a: Pose = Pose(), pose_b: Pose = Pose(), *, k: int = 8, **options) -> Answer:
    """Discrete OFG in eight steps: do the surfaces of `a` and `b` meet at these poses?

    k: faces in each selection. At k no less than the number of faces the answer is that of testing all pairs of faces.
    As written, a body wholly inside another is not seen, and k too small misses.

    Options of all calls:
    toi: "velocity" (the parameter at which the virtual edge meets the face, put on the real motion), "bisection" or "none".
    iterations: halvings of the bisection (20: a bracket of 1e-6 of the step; its later end is returned).
    broad: "swept" (step 1 with bounding spheres swept along the motion) or "start" (at the start pose, the literal reading).
    concave: "object" (OFG at the object level picks one pair of pieces), "undivided" (the surface as one mesh) or "all-pairs" of pieces.
    precision: "double" or "float" (the relative pose is in double always).
    screen: True to let a plane between the whole bodies settle "no" before the steps. The answers are the same, sooner where bodies are
    near and apart, soonest in `discrete_many`; the counts are then of what was done. Adaptive k always does it.
    repairs: "none", "all", "all-but-X", "X" or "X+Y" of the names below; or one by one:
    selection="point-triangle" (point-triangle), adaptive_k=True (adaptive-k), broad="swept" (swept-spheres), both_vertices=True
    (both-vertices), edge_edge=True (edge-edge), selections=3 (selection-times), arc_tolerance=1e-6 (arcs: chords stray by no more
    than this share of A's radius), containment=True (containment), concave="all-pairs" (all-pieces), earliest=True (earliest).

    Raises ValueError or TypeError for an option that is unknown or out of range. Source: Kara, "Opposing Face Geometry", GameDev.net 2004.
    """
    return _ask(False, a, b, pose_a, pose_b, Motion(), Motion(), OFG, k=k, **options)


def translational_sweep(
    a: Body,
    b: Body,
    displacement,
    pose_a: Pose = Pose(),
    pose_b: Pose = Pose(),
    *,
    displacement_b=(0, 0, 0),
    k: int = 8,
    **options,
) -> Answer:
    """Translational sweep in six steps: `a` moves by `displacement` (and `b` by `displacement_b`), each (3,), over t in [0, 1].

    Options as of `discrete`. Source: part 3 of the article, "Solving the discrete time problem".
    """
    return _ask(True, a, b, pose_a, pose_b, Motion(displacement), Motion(displacement_b), OFG, k=k, **options)


def rotational_sweep(
    a: Body,
    b: Body,
    motion_a: Motion,
    pose_a: Pose = Pose(),
    pose_b: Pose = Pose(),
    *,
    motion_b: Motion = Motion(),
    k: int = 8,
    **options,
) -> Answer:
    """Rotational sweep: `a` (and `b`) turn and translate as their motions say, about the origins of
    their frames or about other points of theirs. The virtual edges are chords of the true paths,
    seen from `b`. Options as of `discrete`. Source: part 3 of the article, "Solving for rotating
    objects".
    """
    return _ask(True, a, b, pose_a, pose_b, motion_a, motion_b, OFG, k=k, **options)


def ask(query: Query, *, k: int = 8, **options) -> Answer:
    """The answer to a Query, by the variant that its question names."""
    return _ask(
        query.question != "overlap", query.a, query.b, query.pose_a, query.pose_b, query.motion, query.motion_b, OFG, k=k, **options
    )


def brute_force(query: Query, *, precision: str = "double") -> Answer:
    """All faces against all faces; in a sweep also every virtual edge of A against every face of B, with the earliest time. Bodies are
    undivided."""
    return _ask(
        query.question != "overlap",
        query.a,
        query.b,
        query.pose_a,
        query.pose_b,
        query.motion,
        query.motion_b,
        BRUTE_FORCE,
        precision=precision,
    )


def discrete_many(a: Body, b: Body, poses_a, poses_b, *, k: int = 8, threads: int | None = 1, **options) -> Answers:
    """`discrete` for n pairs of poses in one call, without the interpreter lock.

    poses_a, poses_b: sequences of n Pose, or (n, 7) arrays of quaternion (w, x, y, z) and position; one Pose stands for n of it.
    threads: how many; None for one per core. Answers do not depend on it.
    """
    return _many(False, a, b, poses_a, poses_b, Motion(), Motion(), OFG, threads, k=k, **options)


def sweep_many(
    a: Body, b: Body, poses_a, poses_b, motions_a, motions_b=Motion(), *, k: int = 8, threads: int | None = 1, **options
) -> Answers:
    """Sweeps for n pairs of poses and motions in one call.

    motions_a, motions_b: sequences of n Motion, or (n, 10) arrays of displacement, axis, angle and
    about, or (n, 7) without about, which turn about the origins of the bodies' frames; one Motion
    stands for n of it. Where all angles are zero it is the translational sweep. The rest as of
    `discrete_many`.
    """
    return _many(True, a, b, poses_a, poses_b, motions_a, motions_b, OFG, threads, k=k, **options)


def brute_force_many(
    a: Body, b: Body, poses_a, poses_b, motions_a=None, motions_b=Motion(), *, threads: int | None = 1, precision: str = "double"
) -> Answers:
    """`brute_force` for n pairs of poses (and motions, for sweeps) in one call."""
    still = motions_a is None
    return _many(
        not still, a, b, poses_a, poses_b, Motion() if still else motions_a, motions_b, BRUTE_FORCE, threads, precision=precision
    )


def prepare(query: Query, *, algorithm: int = OFG, precision: str = "double", **options) -> _core.Prepared:
    """A callable that asks `query` in the core and returns (hit, time): what a harness times."""
    poses = np.array([_row(query.pose_a), _row(query.pose_b)])
    motions = np.array([_row(query.motion), _row(query.motion_b)])
    return _core.Prepared(
        solid(query.a),
        solid(query.b),
        poses,
        motions,
        core_options(**options),
        algorithm,
        query.question != "overlap",
        _is_float(precision),
    )


def solid(body: Body) -> _core.Solid:
    """The core's form of a body, kept for the last few hundred bodies by content."""
    key = body.digest
    if key in _SOLIDS:
        _SOLIDS.move_to_end(key)
        return _SOLIDS[key]
    made = _core.Solid(
        body.vertices,
        body.broad_faces,
        body.kind == "convex",
        [p.vertices for p in body.pieces],
        [p.faces for p in body.pieces],
    )
    _SOLIDS[key] = made
    if len(_SOLIDS) > _KEPT_SOLIDS:
        _SOLIDS.popitem(last=False)
    return made


def _ask(moving, a, b, pose_a, pose_b, motion_a, motion_b, algorithm, **options) -> Answer:
    return _many(moving, a, b, [pose_a], [pose_b], [motion_a], [motion_b], algorithm, 1, **options)[0]


def _many(moving, a, b, poses_a, poses_b, motions_a, motions_b, algorithm, threads, *, precision="double", **options) -> Answers:
    rows = [
        _rows(poses_a, Pose, "poses_a"),
        _rows(poses_b, Pose, "poses_b"),
        _rows(motions_a, Motion, "motions_a"),
        _rows(motions_b, Motion, "motions_b"),
    ]
    n = max(len(r) for r in rows if r.ndim == 2) if any(r.ndim == 2 for r in rows) else 1
    rows = [np.ascontiguousarray(np.broadcast_to(r, (n, r.shape[-1]))) for r in rows if _fits(r, n)]
    if threads is None:
        threads = os.cpu_count() or 1
    if threads < 1:
        raise ValueError(f"threads = {threads} must be 1 or more, or None for one per core.")
    out = _core.ask_many(solid(a), solid(b), *rows, core_options(**options), algorithm, moving, _is_float(precision), threads)
    return Answers(*out, toi=options.get("toi", "velocity"))


def _is_float(precision: str) -> bool:
    if precision not in ("double", "float"):
        raise ValueError(f"precision = {precision!r} is unknown; use double or float.")
    return precision == "float"


def _row(value: Pose | Motion) -> np.ndarray:
    if isinstance(value, Pose):
        return np.concatenate([value.quaternion, value.position])
    return np.concatenate([value.displacement, value.axis, [value.angle], value.about])


#: what the columns of arrays of each kind are; the last three of a motion may be left out
_COLUMNS = {
    Pose: (7, (7,), "(n, 7): quaternion (w, x, y, z), position"),
    Motion: (10, (7, 10), "(n, 10): displacement, axis, angle, about; or (n, 7) without about"),
}


def _rows(values: Pose | Motion | Sequence | np.ndarray, kind: type, name: str) -> np.ndarray:
    """(7,) of a Pose or (10,) of a Motion; (n, 7) or (n, 10) of many, in a sequence or an array."""
    if isinstance(values, kind):
        return _row(values)
    columns, given, words = _COLUMNS[kind]
    if not isinstance(values, np.ndarray):
        wrong = next((v for v in values if not isinstance(v, kind)), None)
        if wrong is not None:
            raise TypeError(
                f"{name} holds {wrong!r}; give {kind.__name__} objects or an {words.split(':')[0]} float array."
            )
        return np.array([_row(v) for v in values]).reshape(-1, columns)
    rows = np.asarray(values, np.float64)
    if rows.ndim != 2 or rows.shape[1] not in given:
        raise ValueError(f"{name} has shape {rows.shape}; give {words}.")
    bad = np.flatnonzero(~np.isfinite(rows).all(axis=1))
    if len(bad):
        raise ValueError(f"{name}[{bad[0]}] = {rows[bad[0]]} holds a number that is not finite; every number must be finite.")
    zero = np.flatnonzero(~rows[:, :4].any(axis=1) if kind is Pose else ~rows[:, 3:6].any(axis=1) & (rows[:, 6] != 0))
    if len(zero):
        what = "a zero quaternion" if kind is Pose else "an angle about a zero axis"
        raise ValueError(f"{name}[{zero[0]}] has {what}, which is no rotation; use (1, 0, 0, 0), or an axis with a length.")
    return np.pad(rows, ((0, 0), (0, columns - rows.shape[1])))


def _fits(rows: np.ndarray, n: int) -> bool:
    if rows.ndim == 2 and len(rows) != n:
        raise ValueError(
            f"Arrays of poses and motions have {len(rows)} and {n} rows; give all the same number, or one Pose or Motion for all."
        )
    return True
