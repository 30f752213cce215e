# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Placement of bodies with a given gap, feature or time of contact, exact wherever float32 permits.

Gaps of 1e-16 are made as follows: both bodies have the contact point at their own frame's origin
(`rest_on`), both rotations are integer quaternions with a common part, and the tiny length goes
into one body's position and the large one into the other's. Nothing is then added, and only the
tiny number itself is rounded.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache

import numpy as np
import trimesh

from ofg import Body, Motion, Pose

from .scenario import Draft, snap
from .shapes import any_convex, box, hull_of, rod, scaled

IDENTITY = np.array([1, 0, 0, 0])
QUARTER_TURN = np.array([1, 0, 0, 1])  # about z
UPSIDE_DOWN = np.array([0, 1, 0, 0])
FEATURE_PAIRS = (
    "vertex-vertex",
    "vertex-edge",
    "vertex-face",
    "edge-edge crossing",
    "edge-edge parallel",
    "edge-face",
    "face-face",
)
ALIGNED_SHARE = 0.25  # of the cases keep the axes of the world: engines fail on symmetric input

GROUND = 1e-6  # of the size: vertices nearer than this to a face's plane belong to the face


def multiply(p, q) -> np.ndarray:
    """Hamilton product of (w, x, y, z) quaternions; integers stay integers."""
    p, q = np.asarray(p), np.asarray(q)
    return np.concatenate(
        [[p[0] * q[0] - p[1:] @ q[1:]], p[0] * q[1:] + q[0] * p[1:] + np.cross(p[1:], q[1:])]
    )


def norm_matrix(q) -> np.ndarray:
    """N(q), which is |q|^2 times the rotation: integer for an integer quaternion."""
    w, x, y, z = np.asarray(q)
    return np.array(
        [
            [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
        ]
    )


def any_rotation(rng) -> np.ndarray:
    """A quaternion of a uniformly distributed rotation."""
    q = rng.normal(size=4)
    return q / np.linalg.norm(q)


def common_rotation(rng) -> tuple[np.ndarray, str]:
    """An integer quaternion for both bodies, and the tag "aligned": "yes" if it is the identity."""
    if rng.random() < ALIGNED_SHARE:
        return IDENTITY, "yes"
    return rng.choice([-1, 1], 4) * rng.integers(1, 16, 4), "no"


def any_direction(rng) -> np.ndarray:
    v = rng.normal(size=3)
    return v / np.linalg.norm(v)


@dataclass(frozen=True)
class Seat:
    """A above B with one feature of each at the common point 0, the plane between them
    perpendicular to `normal`, which points to A.

    matrix: integer (3, 3); its columns, divided by `unit`, are two exact directions in the plane
    and the normal. offset: (3,) where in the world the contact may lie, if the case tolerates the
    rounding.
    """

    a: Body
    b: Body
    rotation_a: np.ndarray
    rotation_b: np.ndarray
    matrix: np.ndarray
    unit: float
    offset: np.ndarray
    tags: dict

    @property
    def size(self) -> float:
        """The size of the smaller body, to which gaps are relative."""
        return min(self.a.size, self.b.size)

    @property
    def normal(self) -> np.ndarray:
        return self.matrix[:, 2] / self.unit

    def exact(self, x: int, y: int, z: int, length: float) -> np.ndarray:
        """About `length` in the direction of the integers (x, y, z) in the plane's axes, each
        component exact in float32.
        """
        v = self.matrix @ [x, y, z]
        return v * 2.0 ** np.round(np.log2(length / np.linalg.norm(v)))

    def apart(self, gap: float) -> Draft:
        """At rest, `gap` (length) apart along the normal; negative: penetrating by that depth.
        The tag "aim" contains it.
        """
        self.tags["aim"] = float(gap)
        return self.draft(gap * self.normal, [0, 0, 0], finest=gap)

    def draft(
        self, position_a, position_b, motion: Motion = Motion(), finest: float = 0.0
    ) -> Draft:
        """Both positions relative to the contact. It is moved to `offset` if rounding the
        positions there to float32 changes the `finest` relevant length by less than a
        thousandth; otherwise it stays at the world's origin.
        """
        if 1e-3 * abs(finest) > 2.0**-24 * np.abs(self.offset).max():
            position_a, position_b = position_a + self.offset, position_b + self.offset
        return Draft(
            self.a,
            self.b,
            Pose(self.rotation_a, position_a),
            Pose(self.rotation_b, position_b),
            motion,
            self.tags,
        )


def seat(rng, body_a: Body, body_b: Body, pair: str | None = None) -> Seat:
    """Rest A on B by one of FEATURE_PAIRS, drawn if not given; which body has which feature is
    drawn.
    """
    pair = pair or FEATURE_PAIRS[rng.integers(len(FEATURE_PAIRS))]
    features = pair.split()[0].split("-")
    if rng.random() < 0.5:
        features.reverse()
    a, b = (
        rest_on(body, feature, int(rng.integers(4)))
        for body, feature in zip((body_a, body_b), features)
    )
    common, aligned = common_rotation(rng)
    if aligned == "yes":  # boxes stay aligned with the world: a quarter turn at most
        spin = QUARTER_TURN if "crossing" in pair or rng.random() < 0.5 else IDENTITY
    else:
        spin = np.array([rng.integers(1, 8), 0, 0, rng.integers(1, 8)])
    spin = IDENTITY if "parallel" in pair else spin
    matrix = norm_matrix(common)
    offset = rng.normal(size=3) * min(a.size, b.size)
    return Seat(
        a,
        b,
        multiply(common, spin),
        multiply(common, UPSIDE_DOWN),
        matrix,
        float(common @ common),
        offset,
        {"feature": pair, "aligned": aligned},
    )


@cache
def rest_on(body: Body, feature: str, variant: int) -> Body:
    """The convex body moved so that it stands in z >= 0 on one of its features, with the frame's
    origin in that feature.

    feature: "vertex" (at 0), "edge" (along x through 0) or "face" (in z = 0, around 0); `variant`
    selects which one. The placement is exact: the feature's vertices have the required zero
    coordinates, and all other vertices have z > 0.
    """
    rng = np.random.default_rng([variant, len(body.vertices)])
    # trimesh considers the triangles of a body of 1e-6 degenerate
    unit = 2.0 ** np.round(np.log2(body.size))
    mesh = trimesh.Trimesh(body.vertices / unit, body.faces, process=False)
    for _ in range(100):
        normal, along, contact, members = _feature(mesh, feature, rng)
        x = along - normal * (along @ normal)
        x /= np.linalg.norm(x)
        axes = np.array([x, np.cross(-normal, x), -normal])
        v = snap((mesh.vertices - contact) @ axes.T) * unit
        v[members, 2] = 0.0
        if feature != "face":
            v[members, 1] = 0.0
        if feature == "vertex":
            v[members, 0] = 0.0
        if np.delete(v, members, axis=0)[:, 2].min() > GROUND * unit:
            return hull_of(v, f"{body.name} on {feature} {variant}")
    raise ValueError(
        f"Body '{body.name}': found no {feature} on which it can stand clear of its other "
        "vertices in 100 tries; give the scenario a body with blunter features."
    )


def _feature(mesh: trimesh.Trimesh, feature: str, rng):
    """Outward normal, a direction across it, the contact point and the vertices of a random
    feature of the body.
    """
    if feature == "face":
        face = rng.choice(len(mesh.faces), p=mesh.area_faces / mesh.area_faces.sum())
        normal = mesh.face_normals[face]
        heights = (mesh.vertices - mesh.vertices[mesh.faces[face][0]]) @ normal
        corners = mesh.vertices[mesh.faces[face]]
        sides = np.roll(corners, -1, axis=0) - corners
        shortest = sides[np.argmin(np.linalg.norm(sides, axis=1))]  # of a box, not the diagonal
        return (
            normal,
            shortest,
            rng.dirichlet(np.ones(3) * 3) @ corners,
            np.flatnonzero(heights > -GROUND),
        )
    if feature == "edge":
        sharp = np.flatnonzero(mesh.face_adjacency_angles > 0.02)
        lengths = np.linalg.norm(
            np.diff(mesh.vertices[mesh.face_adjacency_edges[sharp]], axis=1)[:, 0], axis=1
        )
        pick = rng.choice(sharp, p=lengths / lengths.sum())
        members = mesh.face_adjacency_edges[pick]
        start, end = mesh.vertices[members]
        share = rng.uniform(0.3, 0.7)
        normal = mesh.face_normals[mesh.face_adjacency[pick]].sum(axis=0)
        return normal / np.linalg.norm(normal), end - start, start + share * (end - start), members
    vertex = rng.integers(len(mesh.vertices))
    around = mesh.vertex_faces[vertex]
    normal = (
        rng.dirichlet(np.ones(np.count_nonzero(around >= 0)) * 3)
        @ mesh.face_normals[around[around >= 0]]
    )
    return (
        normal / np.linalg.norm(normal),
        rng.normal(size=3),
        mesh.vertices[vertex],
        np.array([vertex]),
    )


def surface_point(rng, body: Body) -> tuple[np.ndarray, np.ndarray]:
    """A point on the surface (in the body's frame, uniform by area) and the outward normal
    there.
    """
    mesh = body.to_trimesh()
    face = rng.choice(len(mesh.faces), p=mesh.area_faces / mesh.area_faces.sum())
    return rng.dirichlet(np.ones(3)) @ mesh.triangles[face], mesh.face_normals[face]


def touching(rng, a: Body, b: Body, gap: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Rotation and position of A, and the normal, such that A's extreme vertex is `gap` above a
    point of B's surface.

    B is at the identity. Any kind of body. If B is concave, A may still intersect another part of
    it.
    """
    point, normal = surface_point(rng, b)
    rotation = snap(any_rotation(rng))
    turned = Pose(rotation).apply(a.vertices)
    return rotation, point + gap * normal - turned[np.argmin(turned @ normal)], normal


def in_world(rng, draft: Draft, offset: float = 1.0) -> Draft:
    """The same in a common random rotation and offset; a quarter of the cases keep the world's
    axes (tag "aligned").
    """
    q, aligned = common_rotation(rng)
    r = norm_matrix(q) / (q @ q)
    shift = offset * rng.normal(size=3)

    def moved(pose: Pose) -> Pose:
        turned = multiply(q, pose.quaternion)
        return Pose(turned / np.linalg.norm(turned), r @ pose.position + shift)

    def turned(motion: Motion) -> Motion:
        return replace(motion, displacement=r @ motion.displacement, axis=r @ motion.axis)

    motion_b = draft.motion_b if draft.motion_b.rests else turned(draft.motion_b)
    poses = {"pose_a": moved(draft.pose_a), "pose_b": moved(draft.pose_b)}
    tags = {**(draft.tags or {}), "aligned": aligned}
    return replace(draft, **poses, motion=turned(draft.motion), motion_b=motion_b, tags=tags)


def flight_through(rng, level: float) -> Draft:
    """A body flies along -z through a wall, or past its rim, from clear to clear; level = travel
    / thickness of the wall.
    """
    half_width = 2.0
    a = any_convex(rng)
    run_up = a.radius + rng.uniform(0.2, 1.0)
    travel = 2 * run_up * level / (level - 1)
    wall = box(2 * half_width, 2 * half_width, float(np.float32(travel / level)))
    through = rng.random() < 0.7
    side = (
        rng.uniform(-1, 1, 2)
        if through
        else np.array([half_width + a.radius * rng.uniform(1.05, 1.5), 0.0])
    )
    slant = rng.uniform(-0.5, 0.5, 2) * [through, 1]  # a body beside the rim stays beside it
    start = Pose(any_rotation(rng), [*(side - slant / 2), travel / 2])
    return Draft(
        a,
        wall,
        start,
        Pose(),
        Motion([*slant, -travel]),
        {"place": "through" if through else "past the rim"},
    )


def spin_beside(rng, turn: float, angle: float, width: float) -> Draft:
    """A rod rotates about z and its own centre by `turn`; a body of radius `width` stands at the
    angle `angle`, near enough to be hit by the rod's end or just out of reach.
    """
    hit = rng.random() < 0.65
    reach = rng.uniform(0.6, 0.9) if hit else rng.uniform(1.01, 1.2)
    body = any_convex(rng)
    body = scaled(body, float(np.float32(width / body.radius)))
    rotation = any_rotation(rng)
    out = np.array([np.cos(angle), np.sin(angle), 0.0])
    nearest = (Pose(rotation).apply(body.vertices) @ out).min()
    pose = Pose(rotation, (reach - nearest) * out)
    place = "in the way" if hit else "out of reach"
    return Draft(
        rod(float(rng.choice([8, 16, 32]))),
        body,
        Pose(),
        pose,
        Motion([0, 0, 0], [0, 0, 1], turn),
        {"place": place},
    )
