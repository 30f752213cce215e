# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Propose a Truth with its certificate. The search is native; its result counts only after the
checker has accepted it.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from weakref import WeakKeyDictionary

from experiments.cases.label import Truth
from experiments.truth.check.balls import add, nearest_double, number, rational, vector
from experiments.truth.check.geometry import centre
from ofg import Body, Motion, Pose, Query

from . import _native
from .exact import exact_time
from .touch import Plane, plane, witness

EFFORT = 3e7  #: vertices visited per case before the prover gives up
TOUCHING = 64  #: pairs of pieces of a case for which an exact plane is sought
solids: WeakKeyDictionary[Body, _native.Solid] = WeakKeyDictionary()


def prove(query: Query) -> Truth:
    """Propose a label and its certificate. Never raises for a valid query and never hangs:
    otherwise "uncertain" with a reason.
    """
    try:
        return _prove(query)
    except (OverflowError, ValueError) as error:  # lengths near the ends of the range of doubles
        return uncertain(f"numbers beyond the prover's range ({error})")


def _prove(query: Query) -> Truth:
    a, b = _solid(query.a), _solid(query.b)
    pair = _native.Pair(_mover(query.pose_a, query.motion), _mover(query.pose_b, query.motion_b))
    pieces = query.a.kind != "mesh" and query.b.kind != "mesh"
    planes = {}
    while True:
        seeds = {at: _native.Seed(number, p.end) for number, (at, p) in enumerate(planes.items())}
        if query.question == "overlap":
            found = _native.instant(pair, a, b, 0.0, EFFORT, seeds)
        else:
            found = _native.sweep(pair, a, b, EFFORT, seeds)
            if found["label"] == "hit" and found["start"] == "clear" and found["t_lo"] == 0:
                # Apart by so little that no segment of time was gained: use the planes at the
                # start.
                found = {**found, "tree": _native.instant(pair, a, b, 0.0, EFFORT, seeds)["tree"]}
        stuck = (
            [at for at in found["stuck"] if at not in planes]
            if pieces and not found["spent"]
            else []
        )
        new = (
            {at: p for at in stuck if (p := plane(query, *at)) is not None}
            if len(stuck) <= TOUCHING
            else {}
        )
        if found["label"] != "uncertain" or not new:
            break
        planes |= new
    propose = _Proposal(query, list(planes.values()))
    truth = propose.overlap(found) if query.question == "overlap" else propose.sweep(found)
    return _tagged(query, truth, planes) if truth.label == "clear" and planes else truth


def _tagged(query, truth, planes) -> Truth:
    """The truth with the tag and its witness, if one of the pairs that needed an exact plane
    touches.
    """
    for (i, j), p in planes.items():
        if found := witness(query, i, j, p):
            return replace(
                truth, touching=True, certificate={**truth.certificate, "touching": found}
            )
    return truth


def _mover(pose: Pose, m: Motion) -> _native.Mover:
    return _native.Mover(
        *(v.tolist() for v in (pose.quaternion, pose.position, m.displacement, m.axis)),
        m.angle,
        m.about.tolist(),
    )


def uncertain(reason: str) -> Truth:
    return Truth("uncertain", reason=reason)


class _Proposal:
    """The result of the native search as a Truth with its certificate. planes: the planes given
    to it, by number.
    """

    def __init__(self, query: Query, planes: list[Plane]):
        self.query, self.planes = query, planes

    def overlap(self, found) -> Truth:
        label, query = found["label"], self.query
        if label == "clear":
            certificate = {"clear": self.apart(found["tree"], 0.0)}
            return Truth(
                "clear", start="clear", end="clear", gap=found["gap"], certificate=certificate
            )
        if label == "hit":
            certificate = {"hit": _inside(query, found["common"], 0.0)}
            return Truth(
                "hit", start="hit", end="hit", gap=-found["depth"], certificate=certificate
            )
        if found["spent"]:
            return uncertain(f"the effort limit of {EFFORT:.0e} vertex visits ran out")
        return uncertain(
            "touching: neither planes nor a common interior point were found in 106 bits"
        )

    def sweep(self, found) -> Truth:
        label, start, query = found["label"], found["start"], self.query
        if label == "uncertain":
            return uncertain(found["reason"])
        until = 1.0 if label == "clear" else found["t_lo"]
        certificate = {"clear": self.apart(found["tree"], until)} if start == "clear" else {}
        if label == "clear":
            return Truth(
                "clear", start="clear", end="clear", gap=found["gap"], certificate=certificate
            )
        t_lo, t_hi, end = found["t_lo"], found["t_hi"], found["end"]
        certificate["hit"] = _inside(query, found["common"], t_hi)
        if (
            start == "clear"
            and query.question == "translation"
            and query.a.kind == query.b.kind == "convex"
        ):
            near = [nearest_double(number(c)) for c in certificate["clear"]["tree"][0][-1][2:]]
            if exact := exact_time(query, 0, 0, near):
                certificate["exact"] = exact
        if end["label"] == "clear":
            certificate["end_clear"] = self.apart(end["tree"], 1.0)
        if end["label"] == "hit":
            certificate["end_hit"] = _inside(query, end["common"], 1.0)
        return Truth(
            "hit", t_lo, t_hi, start, end["label"], -found["depth"], certificate=certificate
        )

    def apart(self, tree, end) -> dict:
        apart = {"tree": self.tree(tree, -1.0, end)}
        for key, body in (("order_a", self.query.a), ("order_b", self.query.b)):
            order = _solid(body).order
            if len(order) > 1:
                apart[key] = order
        return apart

    def tree(self, node, start, end) -> list:
        """The native tree, without the parts past the interval's end: it was proved before an
        earlier impact was found.
        """
        segments, split = node
        kept = []
        for to, frame, n in segments:
            if kept and start >= end:
                break
            kept.append([to, *self.plane(frame, n)])
            start = to
        if split is None or (kept and start >= end):
            return [kept, None]
        side, cut, left, right = split
        return [kept, [side, [cut], [self.tree(left, start, end), self.tree(right, start, end)]]]

    def plane(self, frame, n) -> list:
        if frame != "S":
            return [frame, *_wide(n)]
        exact = self.planes[int(n[0])]
        return [exact.frame, *(str(c) for c in exact.n)]


def _wide(n) -> list:
    """Three doubles, or if those do not suffice, three rationals as "p/q"."""
    return [hi if lo == 0 else str(Fraction(hi) + Fraction(lo)) for hi, lo in zip(n[:3], n[3:])]


def _inside(query, found, t) -> dict:
    """The native point is relative to A's centre of rotation and B's displacement; the
    certificate's is in the world.
    """
    point = [Fraction(hi) + Fraction(lo) for hi, lo in zip(found["point"][:3], found["point"][3:])]
    shift = add(
        centre(query.pose_a, query.motion), vector(query.motion_b.displacement), rational(t)
    )
    point = [x + Fraction(int(c.p), int(c.q)) for x, c in zip(point, shift)]
    point = [float(x) if Fraction(float(x)) == x else str(x) for x in point]
    return {
        "point": point,
        **{key: None if found[key][0] < 0 else list(found[key]) for key in ("a", "b")},
    }


def _solid(body: Body) -> _native.Solid:
    if body not in solids:
        if body.kind == "mesh":
            solids[body] = _native.Solid.of_mesh(body.vertices, body.faces)
        else:
            solids[body] = _native.Solid.of_pieces([p.vertices for p in body.pieces])
    return solids[body]
