# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The bodies of the scenarios: generated ones of radius about 1, and real meshes from the installed
pybullet_data.

Every vertex is a float32 number, so that float and double engines get the same body. Bodies are
cached: equal calls return the same object, so engines may reuse what they built for it.
"""

from __future__ import annotations

from functools import cache, lru_cache
from pathlib import Path

import numpy as np
import trimesh

from ofg import Body, decompose

from .scenario import snap

# Each mesh is a file under pybullet_data. Face counts in comments. Convex to within rounding:
# replaced by their hulls.
CONVEX_MESHES = {
    "prism": "toys/prism.obj",  # 12
    "finger": "franka_panda/meshes/collision/finger.obj",  # 32
    "domino": "domino/domino.obj",  # 48
    "tmotor": "quadruped/tmotor3.obj",  # 124
    "fingertip": "kuka_iiwa/meshes/finger_tip_left.stl",  # 138
    "hand": "franka_panda/meshes/collision/hand.obj",  # 200
    "link5": "franka_panda/meshes/collision/link5.obj",  # 300
    "wheel": "racecar/meshes/left_front_wheel.STL",  # 1632
}
# Closed concave surfaces. `decomposed` takes CoACD 0.3 to 2 s each for the first four (threshold
# 0.05), 5 to 35 s for the rest.
CONCAVE_MESHES = {
    "cone": "racecar/meshes/cone.obj",  # 38
    "lower_leg": "laikago/lower_leg3_lores.obj",  # 120
    "shin": "laikago/lower_leg_3_collision.stl",  # 188
    "knuckle": "xarm/xarm_gripper/meshes/left_outer_knuckle.STL",  # 444
    "shape_sorter": "toys/shape_sorter.obj",  # 200
    "guide": "gripper/meshes/GUIDE_WSG50_110.stl",  # 476
    "bunny": "bunny.obj",  # 902
    "ring": "torus/torus_textured.obj",  # 1002
}
LARGE_MESHES = {
    "stand": "differential/diff_stand.stl",  # 3338
    "xarm_link3": "xarm/xarm_description/meshes/xarm6/visual/link3.stl",  # 4248
    "duck": "duck.obj",  # 4212
    "channel": "quadruped/microtaur/channel_4inch.stl",  # 5638
}
# Meshes supplied by their authors in convex pieces: the pieces are the body, without CoACD.
PIECEWISE_MESHES = {
    "tray": "tray/tray_textured4.obj",  # 6 pieces
    "xarm_link4": "xarm/xarm_description/meshes/xarm6/collision/link4_vhacd.obj",  # 5
    "duck_pieces": "duck_vhacd.obj",  # 5
    "upper_leg": "laikago/upper_leg_left_vhacd.obj",  # 9
    "teddy": "teddy2_VHACD_CHs.obj",  # 15
}


def hull_of(points, name: str) -> Body:
    """The hull of (n, 3) points after snapping them to float32."""
    return Body.convex(snap(points), name)


@lru_cache(512)  # some families use walls of arbitrary thickness
def box(x: float = 1.0, y: float = 1.0, z: float = 1.0) -> Body:
    """A box with these edge lengths; a cube by default. Use multiples of a power of two if a gap
    must be exact.
    """
    corners = np.array(np.meshgrid([-0.5, 0.5], [-0.5, 0.5], [-0.5, 0.5])).reshape(3, -1).T
    return hull_of(corners * [x, y, z], f"box {x:g} x {y:g} x {z:g}")


@cache
def tetrahedron() -> Body:
    """Regular, radius sqrt(3)/2."""
    return hull_of(
        np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]) * 0.5, "tetrahedron"
    )


@cache
def icosphere(subdivisions: int = 1, radius: float = 1.0) -> Body:
    """20 * 4^subdivisions nearly equal faces."""
    return hull_of(
        trimesh.creation.icosphere(subdivisions, radius).vertices,
        f"icosphere {20 * 4**subdivisions}",
    )


@cache
def hull(faces: int, seed: int) -> Body:
    """A random hull: points on an ellipsoid with axes between 0.4 and 1, as many as give `faces`
    triangles (even, >= 4).
    """
    rng = np.random.default_rng([seed, faces])
    points = rng.normal(size=(faces // 2 + 2, 3))
    points *= rng.uniform(0.4, 1.0, 3) / np.linalg.norm(points, axis=1)[:, None]
    return hull_of(points - points.mean(axis=0), f"hull {faces} #{seed}")


@cache
def rod(aspect: float, sections: int = 8, length: float = 2.0) -> Body:
    """A prism along x over a regular polygon; aspect = length / thickness. A needle if the
    aspect is large.
    """
    turn = 2 * np.pi * np.arange(sections) / sections
    ring = np.stack([0 * turn, np.cos(turn), np.sin(turn)], axis=1) * (length / aspect / 2)
    return hull_of(
        np.concatenate([ring - [length / 2, 0, 0], ring + [length / 2, 0, 0]]), f"rod {aspect:g}"
    )


def plate(aspect: float, width: float = 2.0) -> Body:
    """A square plate perpendicular to z; aspect = width / thickness."""
    return box(width, width, width / aspect)


@cache
def torus(
    radius: float = 0.75,
    tube: float = 0.25,
    sections: int = 16,
    around: int = 8,
    form: str = "mesh",
) -> Body:
    """A torus about z. The hole has the radius `radius - tube`. form "mesh", or "union": the
    same solid in `sections` convex pieces.
    """
    turn = 2 * np.pi * (np.arange(around) + 0.5) / around
    profile = np.stack([radius + tube * np.cos(turn), tube * np.sin(turn)], axis=1)
    return _revolved(profile, sections, form, f"torus {form} {2 * sections * around}")


@cache
def frame(
    hole: float, outer: float = 1.0, thickness: float = 0.25, sections: int = 4, form: str = "mesh"
) -> Body:
    """A flat ring about z whose hole is a regular polygon of inscribed radius `hole`; `outer` is
    its outer radius.
    """
    to_corner = 1 / np.cos(np.pi / sections)
    corners = [(hole, -1), (outer, -1), (outer, 1), (hole, 1)]
    profile = np.array([(r * to_corner, 0.5 * thickness * z) for r, z in corners])
    return _revolved(profile, sections, form, f"frame {form} {hole:g}")


@cache
def hook(arm: float = 1.0, width: float = 0.25, form: str = "mesh") -> Body:
    """An L in the plane z = 0: two arms of length `arm` along x and y from the corner, both
    `width` wide and thick. The frame's origin is the inner corner.
    """
    far = arm - width
    outline = np.array([(0, 0), (0, far), (-width, far), (-width, -width), (far, -width), (far, 0)])
    if form == "union":
        # Both arms contain the corner: pieces that merely shared a face would leave a seam outside
        # both interiors.
        upright = _slab(-width, 0, -width, far, width)
        foot = _slab(-width, far, -width, 0, width)
        return Body.union([upright, foot], "hook union")
    n = len(outline)
    low, high = (np.column_stack([outline, np.full(n, z)]) for z in (-width / 2, width / 2))
    # a fan from the inner corner covers the whole L
    cap = np.array([(0, i, i + 1) for i in range(1, n - 1)])
    sides = [(i, j, j + n) for i, j in _ring(n)] + [(i, j + n, i + n) for i, j in _ring(n)]
    return Body.mesh(
        snap(np.concatenate([low, high])),
        np.concatenate([cap[:, ::-1], cap + n, sides]),
        "hook mesh",
    )


@cache
def real_convex(name: str) -> Body:
    """One of CONVEX_MESHES as its hull, its vertices' mean at the origin, radius 1."""
    return hull_of(_unit(_load(CONVEX_MESHES[name]).convex_hull.vertices), name)


@cache
def real_concave(name: str, form: str = "mesh") -> Body:
    """One of CONCAVE_MESHES or LARGE_MESHES, its vertices' mean at the origin, radius 1. form
    "mesh": the closed surface; "union": its CoACD pieces.
    """
    mesh = _load({**CONCAVE_MESHES, **LARGE_MESHES}[name])
    body = Body.mesh(snap(_unit(mesh.vertices)), mesh.faces, name)
    return decomposed(body) if form == "union" else body


@cache
def real_pieces(name: str) -> Body:
    """One of PIECEWISE_MESHES as the union of its authors' pieces, vertices' mean at the origin,
    radius 1.
    """
    mesh = _load(PIECEWISE_MESHES[name])
    label = trimesh.graph.connected_component_labels(
        mesh.face_adjacency, node_count=len(mesh.faces)
    )
    vertices = _unit(mesh.vertices)
    parts = [np.unique(mesh.faces[label == i]) for i in range(label.max() + 1)]
    return Body.union(
        [hull_of(vertices[part], f"{name} {i}") for i, part in enumerate(parts)], name
    )


@cache
def decomposed(body: Body) -> Body:
    """The union of the CoACD pieces of a closed mesh, vertices snapped to float32. The pieces
    *are* the body then.
    """
    pieces = decompose(body, threshold=0.05, seed=0).pieces
    return Body.union([hull_of(p.vertices, p.name) for p in pieces], f"{body.name} pieces")


CONVEX_KINDS = (
    "cube",
    "box",
    "tetrahedron",
    "hull 12",
    "hull 40",
    "icosphere",
    "rod",
    *list(CONVEX_MESHES)[:6],
)


def convex(kind: str, seed: int = 0) -> Body:
    """One of CONVEX_KINDS by name: the "any convex body" of the families; `seed` selects among
    the random ones.
    """
    if kind in CONVEX_MESHES:
        return real_convex(kind)
    if kind.startswith("hull "):
        return hull(int(kind.split()[1]), seed)
    made = {
        "cube": box,
        "box": lambda: box(1.0, 0.75, 0.375),
        "tetrahedron": tetrahedron,
        "icosphere": icosphere,
        "rod": lambda: rod(4.0),
    }
    return made[kind]()


def any_convex(rng: np.random.Generator) -> Body:
    """A body drawn uniformly from CONVEX_KINDS; random hulls come from a pool of 16 so that
    engines may reuse what they built.
    """
    return convex(CONVEX_KINDS[rng.integers(len(CONVEX_KINDS))], int(rng.integers(16)))


@cache
def scaled(body: Body, factor: float) -> Body:
    """The body times `factor`, snapped to float32 again."""
    if body.kind == "mesh":
        return Body.mesh(snap(body.vertices * factor), body.faces, body.name)
    pieces = [hull_of(p.vertices * factor, p.name) for p in body.pieces]
    return pieces[0] if body.kind == "convex" else Body.union(pieces, body.name)


def _slab(x0, x1, y0, y1, thickness) -> Body:
    size, middle = np.array([x1 - x0, y1 - y0, thickness]), np.array([x0 + x1, y0 + y1, 0]) / 2
    return hull_of(box().vertices * size + middle, "slab")


def _ring(n: int):
    return [(i, (i + 1) % n) for i in range(n)]


def _revolved(profile: np.ndarray, sections: int, form: str, name: str) -> Body:
    """A closed (m, 2) profile (radius, z), counter-clockwise, revolved about z in `sections`
    straight steps.
    """
    turn = 2 * np.pi * np.arange(sections) / sections
    r, z = profile.T
    grid = np.stack(
        [np.outer(np.cos(turn), r), np.outer(np.sin(turn), r), np.tile(z, (sections, 1))], axis=2
    )
    if form == "union":
        return Body.union(
            [
                hull_of(np.concatenate([grid[i], grid[j]]), f"{name} {i}")
                for i, j in _ring(sections)
            ],
            name,
        )
    m = len(profile)
    quads = [
        (i * m + p, j * m + p, j * m + q, i * m + q)
        for i, j in _ring(sections)
        for p, q in _ring(m)
    ]
    faces = [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]
    return Body.mesh(snap(grid.reshape(-1, 3)), np.array(faces), name)


def _load(path: str) -> trimesh.Trimesh:
    """A mesh from the installed package; the meshes have their own licences and are not copied."""
    import pybullet_data

    mesh = trimesh.load(Path(pybullet_data.getDataPath()) / path, force="mesh")
    mesh.merge_vertices(merge_tex=True, merge_norm=True)
    return mesh


def _unit(vertices: np.ndarray) -> np.ndarray:
    centred = vertices - vertices.mean(axis=0)
    return centred / np.linalg.norm(centred, axis=1).max()
