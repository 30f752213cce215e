"""Proposes a Truth with its certificate. The search runs natively; nothing it says is believed before the checker has agreed."""

from __future__ import annotations

from fractions import Fraction
from weakref import WeakKeyDictionary

from ofg import Body, Query

from . import _native
from .exact import exact_time
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
    m = query.motion
    pair = _native.Pair(
        query.pose_a.quaternion.tolist(),
        query.pose_a.position.tolist(),
        query.pose_b.quaternion.tolist(),
        query.pose_b.position.tolist(),
        m.displacement.tolist(),
        m.axis.tolist(),
        m.angle,
    )
    if query.question == "overlap":
        return _overlap(query, _native.instant(pair, a, b, 0.0, EFFORT))
    return _sweep(query, _native.sweep(pair, a, b, EFFORT))


def uncertain(reason: str) -> Truth:
    return Truth("uncertain", reason=reason)


def _overlap(query, found) -> Truth:
    label = found["label"]
    if label == "clear":
        return Truth(
            "clear", start="clear", end="clear", gap=found["gap"], certificate={"clear": _apart(query, found["tree"], 0.0)}
        )
    if label == "hit":
        return Truth("hit", start="hit", end="hit", gap=-found["depth"], certificate={"hit": _inside(query, found["common"])})
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
    certificate["hit"] = _inside(query, found["common"])
    t_lo, t_hi, end = found["t_lo"], found["t_hi"], found["end"]
    if start == "clear" and query.question == "translation" and query.a.kind == query.b.kind == "convex":
        if exact := exact_time(query, 0, 0, found["tree"][0][-1][2][:3]):
            certificate["exact"] = exact
    if end["label"] == "clear":
        certificate["end_clear"] = _apart(query, end["tree"], 1.0)
    if end["label"] == "hit":
        certificate["end_hit"] = _inside(query, end["common"])
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


def _inside(query, found) -> dict:
    """The native point is relative to p_A; the certificate's is in the world."""
    high, low, origin = found["point"][:3], found["point"][3:], query.pose_a.position.tolist()
    point = [Fraction(hi) + Fraction(lo) + Fraction(o) for hi, lo, o in zip(high, low, origin)]
    point = [float(x) if Fraction(float(x)) == x else str(x) for x in point]
    return {"point": point, **{key: None if found[key][0] < 0 else list(found[key]) for key in ("a", "b")}}


def _solid(body: Body) -> _native.Solid:
    if body not in _solids:
        if body.kind == "mesh":
            _solids[body] = _native.Solid.of_mesh(body.vertices, body.faces)
        else:
            _solids[body] = _native.Solid.of_pieces([p.vertices for p in body.pieces])
    return _solids[body]
