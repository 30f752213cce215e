"""Proposes a Truth with its certificate. The search runs natively; nothing it says is believed before the checker has agreed."""

from __future__ import annotations

from fractions import Fraction
from weakref import WeakKeyDictionary

from ofg import Body, Motion, Pose, Query

from . import _native
from .balls import add, rational, vector
from .exact import exact_time
from .geometry import centre
from .label import Truth

EFFORT = 3e7  #: vertices visited per case before the prover gives up
_solids: WeakKeyDictionary[Body, _native.Solid] = WeakKeyDictionary()


def prove(query: Query) -> Truth:
    """Propose a label and its certificate. Never raises for a valid query and never hangs: else "uncertain" with a reason."""
    try:
        return _prove(query)
    except (OverflowError, ValueError) as error:  # lengths near the ends of the range of doubles
        return uncertain(f"numbers beyond the prover's range ({error})")


def _prove(query: Query) -> Truth:
    a, b = _solid(query.a), _solid(query.b)
    pair = _native.Pair(_mover(query.pose_a, query.motion), _mover(query.pose_b, query.motion_b))
    if query.question == "overlap":
        return _overlap(query, _native.instant(pair, a, b, 0.0, EFFORT))
    return _sweep(query, _native.sweep(pair, a, b, EFFORT))


def _mover(pose: Pose, m: Motion) -> _native.Mover:
    return _native.Mover(
        *(v.tolist() for v in (pose.quaternion, pose.position, m.displacement, m.axis)), m.angle, m.about.tolist()
    )


def uncertain(reason: str) -> Truth:
    return Truth("uncertain", reason=reason)


def _overlap(query, found) -> Truth:
    label = found["label"]
    if label == "clear":
        return Truth(
            "clear", start="clear", end="clear", gap=found["gap"], certificate={"clear": _apart(query, found["tree"], 0.0)}
        )
    if label == "hit":
        certificate = {"hit": _inside(query, found["common"], 0.0)}
        return Truth("hit", start="hit", end="hit", gap=-found["depth"], certificate=certificate)
    if found["spent"]:
        return uncertain(f"the effort limit of {EFFORT:.0e} vertex visits ran out")
    return uncertain("touching: neither planes nor a common interior point were found in 106 bits")


def _sweep(query, found) -> Truth:
    label, start = found["label"], found["start"]
    if label == "uncertain":
        return uncertain(found["reason"])
    until = 1.0 if label == "clear" else found["t_lo"]
    certificate = {"clear": _apart(query, found["tree"], until)} if start == "clear" else {}
    if label == "clear":
        return Truth("clear", start="clear", end="clear", gap=found["gap"], certificate=certificate)
    t_lo, t_hi, end = found["t_lo"], found["t_hi"], found["end"]
    certificate["hit"] = _inside(query, found["common"], t_hi)
    if start == "clear" and query.question == "translation" and query.a.kind == query.b.kind == "convex":
        if exact := exact_time(query, 0, 0, found["tree"][0][-1][2][:3]):
            certificate["exact"] = exact
    if end["label"] == "clear":
        certificate["end_clear"] = _apart(query, end["tree"], 1.0)
    if end["label"] == "hit":
        certificate["end_hit"] = _inside(query, end["common"], 1.0)
    return Truth("hit", t_lo, t_hi, start, end["label"], -found["depth"], certificate=certificate)


def _apart(query, tree, end) -> dict:
    apart = {"tree": _tree(tree, -1.0, end)}
    for key, body in (("order_a", query.a), ("order_b", query.b)):
        order = _solid(body).order
        if len(order) > 1:
            apart[key] = order
    return apart


def _tree(node, start, end) -> list:
    """The native tree, without what lies past the interval's end: it was proved before an earlier impact was found."""
    segments, split = node
    kept = []
    for to, frame, n in segments:
        if kept and start >= end:
            break
        kept.append([to, frame, *_wide(n)])
        start = to
    if split is None or (kept and start >= end):
        return [kept, None]
    side, cut, left, right = split
    return [kept, [side, [cut], [_tree(left, start, end), _tree(right, start, end)]]]


def _wide(n) -> list:
    """Three doubles, or where those do not do, three rationals as "p/q"."""
    return [hi if lo == 0 else str(Fraction(hi) + Fraction(lo)) for hi, lo in zip(n[:3], n[3:])]


def _inside(query, found, t) -> dict:
    """The native point is relative to A's point of turning and B's displacement; the certificate's is in the world."""
    point = [Fraction(hi) + Fraction(lo) for hi, lo in zip(found["point"][:3], found["point"][3:])]
    shift = add(centre(query.pose_a, query.motion), vector(query.motion_b.displacement), rational(t))
    point = [x + Fraction(int(c.p), int(c.q)) for x, c in zip(point, shift)]
    point = [float(x) if Fraction(float(x)) == x else str(x) for x in point]
    return {"point": point, **{key: None if found[key][0] < 0 else list(found[key]) for key in ("a", "b")}}


def _solid(body: Body) -> _native.Solid:
    if body not in _solids:
        if body.kind == "mesh":
            _solids[body] = _native.Solid.of_mesh(body.vertices, body.faces)
        else:
            _solids[body] = _native.Solid.of_pieces([p.vertices for p in body.pieces])
    return _solids[body]
