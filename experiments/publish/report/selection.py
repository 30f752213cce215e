# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""OFG's selections, recomputed in numpy from the published steps for display. The answer itself
always comes from the core.

A test runs the core on the selected faces only, all against all, and compares its answer with
OFG's.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import nan

import numpy as np
import trimesh

import ofg
from ofg import Body, Motion, Pose, Query

# shares of the step after the impact at which intersecting faces are searched for
AFTER = (0.0, 1e-9, 1e-7, 1e-5, 1e-4, 1e-3, 1e-2, 3e-2, 0.1)


@dataclass(frozen=True)
class Mesh:
    """One piece as used by OFG; its faces have the indices first, first + 1, ... in the whole
    body.
    """

    body: Body
    piece: int
    first: int

    @property
    def centre(self) -> np.ndarray:
        return self.body.vertices.mean(axis=0)

    @property
    def radius(self) -> float:
        return float(np.linalg.norm(self.body.vertices - self.centre, axis=1).max())

    @property
    def corners(self) -> np.ndarray:
        return self.body.vertices[self.body.faces]


def trace(query: Query, options: dict, impact: float = nan) -> dict:
    """OFG's answer and selections for a query, as values that JSON can store.

    options: those of ofg.ask; bodies must already be in pieces if OFG is to use pieces. impact: the
    certified time of impact of a hit, else NaN. If the repair "arcs" splits the step into parts,
    the part that contains it is shown.

    hit, time, found: the answer. met: the faces that met, [a, b] or None. stopped: "" or the step
    that ended the query before a face was tested. pieces: those tested. window: [from, to], one of
    `parts`. a, b: selected faces, nearest first. selections: the number of times at which faces
    were selected. vertices_b: whether B's vertices have virtual edges too. should: faces that
    intersect at `time`, and their places in the order of all faces by distance (None if they belong
    to a piece that was not tested); None if no surfaces intersect. All faces are indices into the
    faces of the whole body.
    """
    answer = ofg.ask(query, **options)
    chosen = _Options(**options)
    ma, mb = _pieces(query, chosen, answer)
    made = {
        "hit": answer.hit,
        "time": None if np.isnan(answer.time) else answer.time,
        "found": answer.found,
        "pieces": [ma.piece, mb.piece],
        "vertices_b": chosen.both_vertices,
        "selections": chosen.selections,
        "stopped": "",
    }
    made["met"] = (
        [answer.faces[0] + ma.first, answer.faces[1] + mb.first]
        if answer.hit and min(answer.faces) >= 0
        else None
    )
    moving = query.question != "overlap"
    parts = _parts(query, ma, mb, chosen) if moving else 1
    at = answer.time if answer.hit and not np.isnan(answer.time) else impact
    index = min(int(at * parts), parts - 1) if at == at else 0
    window = (index / parts, (index + 1) / parts) if moving else (0.0, 0.0)
    fa, fb = select(query, ma, mb, window, chosen)
    made.update(
        window=list(window), parts=parts, a=(fa + ma.first).tolist(), b=(fb + mb.first).tolist()
    )
    if not answer.hit:
        made["stopped"] = _stopped(query, ma, mb, fa, fb, moving, chosen)
    if impact == impact or (not moving and not answer.hit):
        made["should"] = _should(query, ma, mb, chosen, window, impact if moving else 0.0)
    return made


def select(
    query: Query, a: Mesh, b: Mesh, window: tuple[float, float], chosen: _Options
) -> tuple[np.ndarray, np.ndarray]:
    """Steps 2 to 5 and 7: indices of the selected faces of both pieces, nearest first."""
    times, gap = _times(query, a, b, window, chosen)
    poses = [_relative(query, t) for t in times]
    reach_a = b.radius
    if chosen.adaptive_k:
        r, p = poses[0]
        pivots = r @ query.motion.about + p - query.motion_b.about
        flown = np.linalg.norm(_displacement(query)) * (window[1] - window[0])
        far = np.linalg.norm(pivots) + flown
        reach_a += gap * _speed(query, 0.0, _arm(b.centre, query.motion_b), far)
    fa = _nearest(a, [r.T @ (b.centre - p) for r, p in poses], chosen, reach_a)
    centre, radius = _sphere(a, fa)
    reach_b = radius + (
        gap * _speed(query, _arm(centre, query.motion), 0.0, far) if chosen.adaptive_k else 0.0
    )
    return fa, _nearest(b, [r @ centre + p for r, p in poses], chosen, reach_b)


class _Options:
    """The options of ofg.ask that affect selections, with repairs resolved."""

    def __init__(self, k=8, repairs="none", **own):
        o = {**ofg.repair_options(repairs), **own}
        self.k, self.nearest, self.adaptive_k = (
            k,
            o.get("nearest", "centroid"),
            o.get("adaptive_k", False),
        )
        self.selections, self.arc_tolerance, self.both_vertices = (
            o.get("selection_times", 1),
            o.get("arc_tolerance", 0.0),
            o.get("both_vertices", False),
        )
        self.broad, self.concave = o.get("broad", "swept"), o.get("concave", "object")


def _pieces(query: Query, chosen: _Options, answer) -> tuple[Mesh, Mesh]:
    """The pieces that the core reports as tested; if it tested all pairs without a hit, the pair
    chosen at the object level.
    """
    ids = list(answer.pieces)
    if chosen.concave == "all-pairs" and not answer.hit:
        ids = list(ofg.ask(query, k=1, concave="object", broad="swept").pieces)
    return _mesh(query.a, ids[0]), _mesh(query.b, ids[1])


def _mesh(body: Body, piece: int) -> Mesh:
    if piece < 0 or body.kind != "union":
        return Mesh(body, piece, 0)
    return Mesh(body.pieces[piece], piece, sum(len(p.faces) for p in body.pieces[:piece]))


def _relative(query: Query, t: float) -> tuple[np.ndarray, np.ndarray]:
    """A's frame in B's frame at time t: x_b = r x_a + p."""
    at, at_b = _poses(query, t)
    rb = at_b.rotation
    return rb.T @ at.rotation, rb.T @ (at.position - at_b.position)


def _poses(query: Query, t: float) -> tuple[Pose, Pose]:
    """The poses of A and B at time t."""
    return query.motion.pose_at(query.pose_a, t), query.motion_b.pose_at(query.pose_b, t)


def _times(query: Query, a: Mesh, b: Mesh, window, chosen: _Options) -> tuple[list[float], float]:
    """The times of the selections, and the largest distance in time to the nearest of them."""
    t0, t1 = window
    if query.question == "overlap" or chosen.selections == 1:
        return [t0], t1 - t0
    if chosen.selections == 2:
        return [t0, t1], (t1 - t0) / 2
    start, end = _between(query, a, b, t0), _between(query, a, b, t1)
    step = end - start
    along = step @ step
    share = min(1.0, max(0.0, -(start @ step) / along)) if along > 0 else 0.0
    closest = t0 + (t1 - t0) * share
    return [t0, closest, t1], max(closest - t0, t1 - closest) / 2


def _between(query: Query, a: Mesh, b: Mesh, t: float) -> np.ndarray:
    """World vector from B's centre to A's."""
    at, at_b = _poses(query, t)
    return at.rotation @ a.centre - at_b.rotation @ b.centre + (at.position - at_b.position)


def _displacement(query: Query) -> np.ndarray:
    """The displacement of A relative to B."""
    return query.motion.displacement - query.motion_b.displacement


def _arm(point: np.ndarray, motion: Motion) -> float:
    """Distance from a body's rotation centre to another of its points."""
    return np.linalg.norm(point - motion.about)


def _speed(query: Query, distance_a: float, distance_b: float, apart: float) -> float:
    turned = abs(query.motion.angle) + abs(query.motion_b.angle)
    return np.linalg.norm(_displacement(query)) + turned * (distance_a + distance_b + apart)


def _distances(mesh: Mesh, point: np.ndarray, nearest: str) -> np.ndarray:
    """Squared distances from a point in the piece's frame to each face, or to its centroid."""
    corners = mesh.corners
    if nearest == "centroid":
        d = corners.mean(axis=1) - point
    else:
        d = (
            trimesh.triangles.closest_point(corners, np.broadcast_to(point, (len(corners), 3)))
            - point
        )
    return np.einsum("ij,ij->i", d, d)


def _nearest(mesh: Mesh, points, chosen: _Options, reach: float) -> np.ndarray:
    least = np.full(len(mesh.body.faces), np.inf)
    for point in points:
        d = _distances(mesh, point, chosen.nearest)
        take = np.lexsort((np.arange(len(d)), d))[: min(chosen.k, len(d))]
        if chosen.adaptive_k:
            corners = mesh.corners
            own = (
                np.linalg.norm(corners - corners.mean(axis=1, keepdims=True), axis=2).max(axis=1)
                if chosen.nearest == "centroid"
                else 0.0
            )
            take = np.union1d(take, np.flatnonzero(d <= (reach + own) ** 2))
        fresh = take[np.isinf(least[take])]
        least[fresh] = d[fresh]
    taken = np.flatnonzero(np.isfinite(least))
    return taken[np.lexsort((taken, least[taken]))]


def _sphere(mesh: Mesh, faces: np.ndarray) -> tuple[np.ndarray, float]:
    corners = mesh.corners[faces]
    centre = corners.mean(axis=(0, 1))
    return centre, float(np.linalg.norm(corners - centre, axis=2).max())


def _parts(query: Query, a: Mesh, b: Mesh, chosen: _Options) -> int:
    """The number of equal parts into which the repair "arcs" splits the step, by the bound in
    stray.hpp on the deviation of chords from paths.
    """
    wa, wb = abs(query.motion.angle), abs(query.motion_b.angle)
    if not chosen.arc_tolerance or not wa + wb:
        return 1
    of_a, of_b = _lever(a, query.motion), _lever(b, query.motion_b)
    slide, pivots = np.linalg.norm(_displacement(query)), _pivots(query)
    far = max(np.linalg.norm(pivots), np.linalg.norm(pivots + _displacement(query)))

    def strays(h: float) -> float:
        away = _bend(wa, wb, of_a, slide, far + of_a)
        if chosen.both_vertices:
            away = max(away, _bend(wb, wa, of_b, slide, of_a + (slide + wb * of_b) * h))
        return away * h * h / 8

    parts = 1
    while strays(1 / parts) > chosen.arc_tolerance * a.radius and parts < 2**24:
        parts *= 2
    return parts


def _bend(own: float, other: float, lever: float, slide: float, apart: float) -> float:
    """Bound on the second derivative of a point's path in the frame of the other body."""
    return own**2 * lever + 2 * other * (slide + own * lever) + other**2 * apart


def _lever(mesh: Mesh, motion: Motion) -> float:
    """Upper bound on the distance of a vertex from the body's rotation centre."""
    about = motion.about if motion.angle else np.zeros(3)
    return min(
        mesh.body.radius + np.linalg.norm(about), mesh.radius + np.linalg.norm(mesh.centre - about)
    )


def _pivots(query: Query) -> np.ndarray:
    """Vector from B's rotation centre to A's at the start."""
    sides = ((query.pose_a, query.motion), (query.pose_b, query.motion_b))
    at_a, at_b = (p.position + (p.rotation @ m.about if m.angle else 0) for p, m in sides)
    return at_a - at_b


def _stopped(query, a, b, fa, fb, moving, chosen) -> str:
    """The sphere test that answered "clear" before a face was tested, or ""."""
    start, end = _between(query, a, b, 0.0), _between(query, a, b, 1.0 if moving else 0.0)
    step = end - start if moving and chosen.broad == "swept" else np.zeros(3)
    along = step @ step
    closest = start + step * (min(1.0, max(0.0, -(start @ step) / along)) if along > 0 else 0.0)
    sides = ((a, query.motion), (b, query.motion_b)) if moving and chosen.broad == "swept" else ()
    stray = sum(_arm(mesh.centre, motion) * min(motion.angle**2 / 8, 2.0) for mesh, motion in sides)
    if np.linalg.norm(closest) > a.radius + b.radius + stray:
        return "step 1: the bounding spheres are apart" + (
            " at the start pose" if moving and chosen.broad == "start" else ""
        )
    if not moving:
        (ca, ra), (cb, rb), (r, p) = _sphere(a, fa), _sphere(b, fb), _relative(query, 0.0)
        if np.linalg.norm(r @ ca + p - cb) > ra + rb:
            return "step 6: the spheres of the two selections are apart"
    return ""


def _should(query: Query, a: Mesh, b: Mesh, chosen: _Options, window, impact: float) -> dict | None:
    """Two faces that intersect at the impact or soon after, and their places in the order by
    distance.
    """
    for later in AFTER if query.question != "overlap" else (0.0,):
        t = min(impact + later, 1.0)
        met = ofg.brute_force(Query("overlap", query.a, query.b, *_poses(query, t)))
        if met.hit:
            return {
                "time": t,
                "faces": list(met.faces),
                "places": _places(query, a, b, chosen, window, met.faces),
            }
    return None


def _places(query, a, b, chosen, window, faces) -> list[int | None]:
    r, p = _relative(query, window[0])
    fa, _ = select(query, a, b, window, chosen)
    orders = [
        _distances(a, r.T @ (b.centre - p), chosen.nearest),
        _distances(b, r @ _sphere(a, fa)[0] + p, chosen.nearest),
    ]
    places = []
    for mesh, face, d in zip((a, b), faces, orders):
        own = face - mesh.first
        places.append(int((d < d[own]).sum()) + 1 if 0 <= own < len(d) else None)
    return places
