"""Proposes a Truth with its certificate. The search runs natively; nothing it says is believed before the checker has agreed."""

from __future__ import annotations

from fractions import Fraction
from math import nan
from weakref import WeakKeyDictionary

import numpy as np

from ofg import Body, Query

from . import _native
from .label import Truth

EFFORT = 2000  #: segments per pair of elements and sweep before the prover gives up
_solids: WeakKeyDictionary[Body, _native.Solid] = WeakKeyDictionary()


def prove(query: Query) -> Truth:
    """Propose a label and its certificate. Never raises for a valid query and never hangs: "uncertain" with a reason otherwise."""
    if any(body.kind != "convex" for body in (query.a, query.b)):
        return uncertain("the prover does not know unions and meshes yet")
    a, b = _solid(query.a), _solid(query.b)
    m = query.motion
    pair = _native.Pair(query.pose_a.quaternion.tolist(), query.pose_a.position.tolist(), query.pose_b.quaternion.tolist(),
                        query.pose_b.position.tolist(), m.displacement.tolist(), m.axis.tolist(), m.angle)
    origin = query.pose_a.position
    if query.question == "overlap":
        return _overlap(query, _native.instant(pair, a, b, 0.0), origin)
    return _sweep(query, _native.sweep(pair, a, b, EFFORT), origin)


def uncertain(reason: str) -> Truth:
    return Truth("uncertain", reason=reason)


def _overlap(query, found, origin) -> Truth:
    label = found["label"]
    if label == "clear":
        return Truth("clear", start="clear", end="clear", gap=found["gap"], certificate={"clear": _plane(0.0, found["n"])})
    if label == "hit":
        return Truth("hit", start="hit", end="hit", gap=-_depth(query, 0.0), certificate={"hit": _inside(found["inside"], origin)})
    return uncertain("touching: neither a plane nor a common interior point was found in 106 bits")


def _sweep(query, found, origin) -> Truth:
    label, start = found["label"], found["start"]
    if label == "uncertain":
        return uncertain(found["reason"])
    segments = [[end, frame, *_wide(n)] for end, frame, n in found["segments"]]
    certificate = {"clear": {"tree": [segments, None]}} if start == "clear" else {}
    if label == "clear":
        return Truth("clear", start="clear", end="clear", gap=found["gap"], certificate=certificate)
    certificate["hit"] = _inside(found["inside"], origin)
    t_lo, t_hi, end = found["t_lo"], found["t_hi"], found["end"]
    if end == "clear":
        certificate["end_clear"] = _plane(1.0, found["end_n"])
    if end == "hit":
        certificate["end_hit"] = _inside(found["end_inside"], origin)
    depth = max(_depth(query, t) for t in np.linspace(t_hi, 1.0, 17))
    return Truth("hit", t_lo, t_hi, start, end, -depth, certificate=certificate)


def _plane(t: float, n) -> dict:
    return {"tree": [[[t, "W", *_wide(n)]], None]}


def _wide(n) -> list:
    """Three doubles, or where those do not do, three rationals as "p/q"."""
    return [hi if lo == 0 else str(Fraction(hi) + Fraction(lo)) for hi, lo in zip(n[:3], n[3:])]


def _inside(found, origin) -> dict:
    """The native point is relative to p_A; the certificate's is in the world."""
    point = [Fraction(hi) + Fraction(lo) + Fraction(o) for hi, lo, o in zip(found["point"][:3], found["point"][3:], origin.tolist())]
    point = [float(x) if Fraction(float(x)) == x else str(x) for x in point]
    return {"point": point, "a": [0, *found["a"]], "b": [0, *found["b"]]}


def _depth(query: Query, t: float) -> float:
    """Penetration depth at time t over the face normals of both bodies (edge pairs are left out: an estimate from above)."""
    pose = query.motion.pose_at(query.pose_a, float(t))
    a, b = pose.apply(query.a.vertices), query.pose_b.apply(query.b.vertices)
    depth = np.inf
    for (x, y), faces in (((a, b), query.a.faces), ((b, a), query.b.faces)):
        tri = x[faces]
        n = np.cross(tri[:, 1] - tri[:, 0], tri[:, 2] - tri[:, 0])
        length = np.linalg.norm(n, axis=1)
        n = n[length > 0] / length[length > 0, None]
        depth = min(depth, float(((x @ n.T).max(axis=0) - (y @ n.T).min(axis=0)).min()))
    return max(depth, 0.0)


def _solid(body: Body) -> _native.Solid:
    if body not in _solids:
        _solids[body] = _native.Solid([np.ascontiguousarray(p.vertices) for p in body.pieces])
    return _solids[body]
