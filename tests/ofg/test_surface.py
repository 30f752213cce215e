# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Closed surfaces: what balances, what cancels, what bounds nothing; each fault with its cause."""

import warnings
from fractions import Fraction

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

import ofg
from experiments.truth import label
from ofg import Body, BodyError, BodyWarning, Motion, Pose, Query, exact, surface, winding

CUBE = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
QUADS = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
FACES = np.array([t for a, b, c, d in QUADS for t in ((a, b, c), (a, c, d))])


def joined(*parts):
    """(vertices, faces) of several (vertices, faces); cubes where only vertices are given."""
    parts = [p if isinstance(p, tuple) else (p, FACES) for p in parts]
    first = np.cumsum([0] + [len(v) for v, _ in parts])
    return np.concatenate([v for v, _ in parts]), np.concatenate(
        [np.asarray(f) + n for (_, f), n in zip(parts, first)]
    )


def inward(v):
    return v, FACES[:, ::-1]


def fin(*corners):
    """A quad of no thickness, its back cut along the other diagonal: no two faces are equal."""
    return np.array(corners, float), [(0, 1, 2), (0, 2, 3), (1, 0, 3), (1, 3, 2)]


FIN = fin((1, -0.5, 0), (5, -0.5, 0), (5, 0.5, 0), (1, 0.5, 0))
ACCEPTED = {  # (vertices, faces), volume of the solid
    "apart": (joined(CUBE, CUBE + [10, 0, 0]), 16),
    "a face in common": (joined(CUBE, CUBE + [2, 0, 0]), 16),
    "a part of a face in common": (joined(CUBE, CUBE + [2, 0.5, 0.5]), 16),
    "an edge in common": (joined(CUBE, CUBE + [2, 2, 0]), 16),
    "a corner in common": (joined(CUBE, CUBE + [2, 2, 2]), 16),
    "overlapping": (joined(CUBE, CUBE + [1, 0, 0]), 12),
    "cutting": (joined(CUBE, CUBE + [0.5, 0.3, 0.1]), 16 - 1.5 * 1.7 * 1.9),
    "hollow": (joined(CUBE * 2, inward(CUBE)), 56),
    "a cube in the hollow": (joined(CUBE * 2, inward(CUBE), CUBE / 2), 57),
    "nested, both outward": (joined(CUBE * 2, CUBE), 64),
    "twice the same": (joined(CUBE, CUBE), 8),
    "with a fin": (joined(CUBE, FIN), 8),
    "with a fin of equal faces": (
        joined(CUBE, (FIN[0], [(0, 1, 2), (0, 2, 3), (2, 1, 0), (3, 2, 0)])),
        8,
    ),
    "with a face that names a vertex twice": (joined(CUBE, (CUBE * 7, [(0, 7, 7)])), 8),
    "with a whisker": (
        joined(CUBE, (np.array([(1, 1, 1), (5, 5, 5), (9, 9, 9)], float), [(0, 1, 2), (0, 2, 1)])),
        8,
    ),
}


@pytest.mark.parametrize("name", ACCEPTED)
def test_what_balances_is_a_body_with_the_volume_where_the_winding_number_is_not_0(name):
    """Refused before as "not a manifold": touching cubes, faces in pairs, a face without area."""
    (v, f), volume = ACCEPTED[name]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        body = Body.mesh(v, f, "crate")
    assert body.kind == "mesh" and body.volume == pytest.approx(volume, rel=1e-12)
    again = Body.mesh(body.vertices, body.faces)
    assert again.digest == body.digest, "what is in order stays as it is"
    turned, _ = np.linalg.qr(np.random.default_rng(5).normal(size=(3, 3)))
    turned *= np.sign(np.linalg.det(turned))
    assert Body.mesh(3 * body.vertices @ turned.T + 1, body.faces).volume == pytest.approx(
        27 * volume, rel=1e-9
    )


@pytest.mark.parametrize("name", ACCEPTED)
def test_a_mesh_that_is_all_inward_is_turned_with_a_notice(name):
    (v, f), volume = ACCEPTED[name]
    with pytest.warns(BodyWarning, match="crate.*inside-out.*turned"):
        body = Body.mesh(v, f[:, ::-1], "crate")
    assert body.volume == pytest.approx(volume, rel=1e-12)


@pytest.mark.parametrize(
    "mesh, words",
    [
        (
            joined(CUBE * 1.5, inward(CUBE + [10, 0, 0])),
            ["shell 2 of 2", "inside-out", "fix_normals"],
        ),
        (joined(CUBE * 2, inward(CUBE + [1.5, 0, 0])), ["shell 2 of 2", "inside-out"]),
        ((CUBE, FACES[:-1]), ["open", "3 of 18 edges", "fill_holes"]),
        (
            (CUBE, np.vstack([FACES[:-1], FACES[-1:, ::-1]])),
            ["disagree", "3 of 18 edges", "fix_normals"],
        ),
        (FIN, ["enclose nothing", "thickness"]),
        ((CUBE, FACES[:2]), ["open"]),
        ((CUBE, np.empty((0, 3), int)), ["no faces", "Body.convex"]),
        ((CUBE, FACES + 2**33), ["names vertex 8589934599"]),
        ((CUBE, [[0, 1], [2, 3, 4]]), ["faces", "(m, 3)"]),
        ((CUBE, None), ["faces", "(m, 3)"]),
        (("cube", FACES), ["vertices", "array of numbers"]),
        ((None, FACES), ["vertices"]),
        (([[1, 2, 3], [1, 2]], FACES), ["vertices", "array of numbers"]),
    ],
)
def test_what_is_refused_says_the_fault_and_the_remedy(mesh, words):
    with pytest.raises(BodyError) as error:
        Body.mesh(*mesh, "crate")
    message = str(error.value)
    assert (
        all(w in message for w in ["crate", *words]) and "\n" not in message and len(message) < 500
    ), message


def test_vertices_without_a_face_are_no_part_of_the_body():
    """One at the origin served as inside point, centre and radius: a false alarm."""
    far = Body.mesh(np.vstack([[0, 0, 0], CUBE + [50, 0, 0]]), FACES + 1)
    assert (
        len(far.vertices) == 8
        and np.allclose(far.centre, [50, 0, 0])
        and far.size == pytest.approx(12**0.5)
    )
    big = Body.convex(CUBE * 4)
    assert not ofg.discrete(far, big, repairs="all") and not ofg.discrete(big, far, repairs="all")
    solid = ofg._core.Solid(
        np.vstack([[0, 0, 0], CUBE + [50, 0, 0]]), (FACES + 1).astype(np.int32), False, [], []
    )
    pose = np.array([[1.0, 0, 0, 0, 0, 0, 0]])
    core = ofg.algorithm.core_options(repairs="all", k=8)
    still = np.zeros((1, 10))
    assert not ofg._core.ask_many(
        solid, ofg.algorithm.solid(big), pose, pose, still, still, core, 0, False, False, 1
    )[0][0]


TWO = joined(CUBE / 2 + [9, 0, 0], CUBE / 4 + [1.2, 1.2, 1.2])
BIG = Body.convex(CUBE * 2)


@pytest.mark.parametrize(
    "two",
    [
        Body.mesh(*TWO),
        Body.union([Body.convex(CUBE / 2 + [9, 0, 0]), Body.convex(CUBE / 4 + [1.2, 1.2, 1.2])]),
    ],
    ids=["mesh", "union"],
)
@pytest.mark.parametrize("precision", ["double", "float"])
def test_each_shell_is_asked_whether_it_lies_inside(two, precision):
    """One point was asked per body: the shell inside was missed if it was not the first."""
    options = {"repairs": "all", "concave": "undivided", "precision": precision}
    for a, b in ((two, BIG), (BIG, two)):
        assert label(Query("overlap", a, b)).label == "hit"
        assert ofg.discrete(a, b, **options).found == "inside"
        answer = ofg.translational_sweep(a, b, (0.1, 0, 0), **options)
        assert answer.found == "inside" and answer.time == 0
    away = Pose(position=(0, 0, -4))
    assert label(Query("overlap", two, BIG, away)).label == "clear" and not ofg.discrete(
        two, BIG, away, **options
    )


@pytest.mark.parametrize("way", [1, -1])
def test_a_point_is_inside_where_the_winding_number_is_not_0(way):
    """Nested shells have 2 in the middle, inverted ones -2, which the core took for outside."""
    v, f = joined(CUBE * 2, CUBE)
    f = f[:, ::way]
    solid = ofg._core.Solid(v, np.ascontiguousarray(f, np.int32), False, [], [])
    small = ofg.algorithm.solid(Body.convex(CUBE / 10))
    pose, still = np.array([[1.0, 0, 0, 0, 0, 0, 0]]), np.zeros((1, 10))
    core = ofg.algorithm.core_options(repairs="all", k=8)
    assert ofg._core.ask_many(small, solid, pose, pose, still, still, core, 0, False, False, 1)[0][
        0
    ]
    assert (
        winding.at(v, f, np.array([[0, 0, 0], [1.5, 0, 0], [3, 0, 0], [1, 0, 0]]))
        == [2 * way, way, 0, 0]
    ).all()


FINNED = [
    "with a fin",
    "with a fin of equal faces",
    "with a face that names a vertex twice",
    "with a whisker",
]


@pytest.mark.parametrize("name", FINNED)
def test_what_has_no_thickness_makes_no_hit(name):
    """A fin or a whisker through another body: no interior is shared."""
    body, other = Body.mesh(*ACCEPTED[name][0]), Body.convex(CUBE + [3, 0.2, 0])
    poses = [Pose(position=p) for p in ((0, 0, 0), (0, 0.3, 0.1), (-0.5, 2, 2))]
    for pose in poses:
        query = Query("overlap", other, body, pose)
        assert label(query).label == "clear"
        assert not ofg.ask(query, repairs="all", concave="undivided") and not ofg.brute_force(query)
    sweep = Query("translation", other, body, motion=Motion((0, 0, 0.5)))
    assert (
        label(sweep).label == "clear"
        and not ofg.ask(sweep, repairs="all")
        and not ofg.brute_force(sweep)
    )


def t_junction():
    """A cube whose edge from 4 to 6 has a vertex 8 on one side: a face without area closes it."""
    f = [t for t in FACES.tolist() if t not in ([4, 6, 7],)]
    return np.vstack([CUBE, [1, 0, -1]]), [(4, 8, 7), (8, 6, 7), (4, 6, 8), *f]


def test_a_face_without_area_closes_a_t_junction_and_is_not_touched():
    v, f = t_junction()
    body = Body.mesh(v, f)
    assert len(body.faces) == 14 and len(body.broad_faces) == 13 and body.volume == pytest.approx(8)
    assert exact.flat(body.vertices, body.faces).tolist() == [False] * 13 + [True]
    assert Body.mesh(body.vertices, body.faces).digest == body.digest
    for x, hit in ((1.99, True), (2.01, False)):
        query = Query("overlap", body, Body.convex(CUBE), Pose(), Pose(position=(x, 0.1, 0.2)))
        assert label(query).label == ("hit" if hit else "clear")
        assert bool(ofg.ask(query, k=99)) == bool(ofg.brute_force(query)) == hit
    box = trimesh.Trimesh(*t_junction(), process=False)
    assert Body.from_trimesh(box).kind == "convex" and Body.from_trimesh(
        box
    ).volume == pytest.approx(8)


def test_faces_without_area_that_reach_beyond_an_edge_are_made_anew_within_it():
    """A closed chain of such faces along the line of an edge, out to two points of its own."""
    v = np.vstack([CUBE, [1, 5, -1], [1, 7, -1]])  # on the line through 4 and 6
    a, b, p, q = 4, 6, 8, 9
    body = Body.mesh(v, [*FACES.tolist(), (a, b, p), (b, a, q), (b, q, p), (a, p, q)])
    assert body.digest == Body.mesh(CUBE, FACES).digest


whole_numbers = st.integers(-3, 3)


@given(
    st.lists(st.tuples(*[whole_numbers] * 12), min_size=1, max_size=30),
    st.sampled_from([1.0, 1e-9, 1e150, 0.1, 1 / 3]),
)
@settings(max_examples=100, deadline=None)
def test_sides_are_those_of_rational_arithmetic(rows, scale):
    x = np.array(rows, float).reshape(-1, 4, 3) * scale
    x[:, :, 0] += 0.7 * scale
    found = exact.sides(*(x[:, k] for k in range(4)))
    for row, sign in zip(x, found):
        a, b, c, p = ([Fraction(float(t)) for t in y] for y in row)
        height = winding._dot(
            winding._cross(*([s - r for r, s in zip(a, y)] for y in (b, c))),
            [s - r for r, s in zip(a, p)],
        )
        assert sign == (height > 0) - (height < 0)
    assert (
        exact.flat(x.reshape(-1, 3), np.arange(3) + 4 * np.arange(len(x))[:, None])
        == [
            not any(winding.normal_of([[Fraction(float(t)) for t in y] for y in row[:3]]))
            for row in x
        ]
    ).all()


@given(st.integers(0, 10**6), st.integers(1, 4), st.booleans())
@settings(max_examples=40, deadline=None)
def test_cubes_on_a_grid_have_the_volume_of_their_cells(seed, n, both):
    """Cubes of whole corners that touch, nest, overlap and coincide: counted cell by cell."""
    rng = np.random.default_rng(seed)
    low = rng.integers(0, 4, (n, 3))
    size = rng.integers(1, 4, (n, 1) if both else (n, 3))
    v, f = joined(*[(CUBE + 1) / 2 * s + p for p, s in zip(low, size)])
    cells = np.zeros((8, 8, 8), int)
    for (x, y, z), s in zip(low, np.broadcast_to(size, (n, 3))):
        cells[x : x + s[0], y : y + s[1], z : z + s[2]] += 1
    body = Body.mesh(v, f)
    assert body.volume == pytest.approx((cells > 0).sum(), rel=1e-9)
    assert Body.mesh(body.vertices, body.faces).digest == body.digest
    middles = rng.integers(0, 8, (20, 3))
    assert (winding.at(body.vertices, body.faces, middles + 0.5) == cells[tuple(middles.T)]).all()


@given(st.integers(0, 10**6))
@settings(max_examples=20, deadline=None)
def test_order_and_doubled_vertices_change_neither_kind_nor_volume(seed):
    """A soup of triangles in any order is the solid of the indexed mesh."""
    rng = np.random.default_rng(seed)
    (v, f), volume = ACCEPTED[list(ACCEPTED)[seed % len(ACCEPTED)]]
    f = np.array([np.roll(t, rng.integers(3)) for t in rng.permutation(f)])
    soup = trimesh.Trimesh(v[f].reshape(-1, 3), np.arange(3 * len(f)).reshape(-1, 3), process=False)
    body = Body.from_trimesh(soup)
    assert (
        body.volume == pytest.approx(volume, rel=1e-9)
        and body.kind == Body.from_trimesh(trimesh.Trimesh(v, f, process=False)).kind
    )


def test_shells_that_touch_along_an_edge_are_apart_and_those_that_need_each_other_are_not():
    v, f = surface.merged(*joined(CUBE, CUBE + [2, 2, 0]))
    assert surface.shells(f).tolist() == [0] * 12 + [1] * 12 and surface.patches(f).max() == 1
    v, f = surface.merged(*joined(CUBE, CUBE + [2, 0, 0]))
    assert surface.shells(surface.settled(v, f)[1]).max() == 0


def test_a_cavity_through_two_touching_shells_is_one():
    """The middle of one of its faces lies on the plane in which the shells touch."""
    corners = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
    hull = Body.convex(corners)
    boxes = [((0, 1, 0), (4, 3, 2)), ((2, 2, 1), (3, 5, 2)), ((2, 3, 1), (6, 7, 3))]
    v = np.concatenate([hull.vertices * np.subtract(high, low) + low for low, high in boxes])
    f = [hull.faces, hull.faces[:, ::-1] + 8, hull.faces + 16]
    assert Body.mesh(v, np.concatenate(f)).volume == pytest.approx(16 + 32 - 3, rel=1e-12)
