# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Mesh files as users bring them: the kind and volume to find, or what must be said."""

import bz2
import gzip
import json
import struct
import warnings
import zipfile

import numpy as np
import pytest
import trimesh

from ofg import Body, BodyError, BodyWarning, meshfile, solid

CUBE = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
QUADS = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
FACES = [t for a, b, c, d in QUADS for t in ((a, b, c), (a, c, d))]
SOUP = CUBE[np.array(FACES)]


def stl(triangles, header=b""):
    rows = np.asarray(triangles, np.float32).reshape(-1, 9)
    body = b"".join(struct.pack("<12fH", 0, 0, 0, *t, 0) for t in rows)
    return header.ljust(80, b"\0") + struct.pack("<I", len(rows)) + body


def obj(*parts, faces=QUADS):
    lines, first = [], 1
    for i, v in enumerate(parts):
        lines += [f"o part{i}", *("v %.17g %.17g %.17g" % tuple(p) for p in v)]
        lines += ["f " + " ".join(str(k + first) for k in f) for f in faces]
        first += len(v)
    return "\n".join(lines).encode()


def ascii_stl(*solids):
    text = ""
    for name, triangles in solids:
        text += f"solid {name}\n"
        for t in triangles:
            corners = "".join("vertex %g %g %g\n" % tuple(p) for p in t)
            text += f"facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n"
        text += f"endsolid {name}\n"
    return text.encode("latin-1")


def off():
    rows = ["%g %g %g" % tuple(p) for p in CUBE] + ["4 %d %d %d %d" % q for q in QUADS]
    return "\n".join(["OFF", "8 6 0", *rows]).encode()


def dented(depth):
    """A cube whose top is pressed in at the middle."""
    ring = (1, 5, 7, 3)
    rest = [f for f in FACES if not all(CUBE[i][2] > 0 for i in f)]
    sides = [(ring[i], ring[(i + 1) % 4], 8) for i in range(4)]
    return obj([*CUBE, (0, 0, 1 - depth)], faces=[*rest, *sides])


BOXES = [
    ((0.6, 0.6, 0.05), (0, 0, 0.05)),
    ((0.6, 0.2, 0.2), (0, 0.4, 0.3)),
    ((0.6, 0.2, 0.2), (0, -0.4, 0.3)),
]
CHANNEL = np.concatenate([SOUP * s + c for s, c in BOXES])
DEGENERATE = np.concatenate([SOUP, [[CUBE[0], CUBE[1], CUBE[1]]], SOUP[:1], SOUP[:1, ::-1]])
JITTER = np.random.default_rng(0).integers(-1, 2, (12, 3, 3))
FOUND = {  # name: (content, kind, volume, pieces with split=True or None where refused)
    "cube.stl": (stl(SOUP), "convex", 8, 1),
    "Grün.STL": (stl(SOUP, "Würfel".encode("latin-1")), "convex", 8, 1),
    "two_apart.obj": (obj(CUBE, CUBE + [10, 0, 0]), "mesh", 16, 2),
    "two_touching.obj": (obj(CUBE, CUBE + [2, 0, 0]), "convex", 16, 2),
    "two_touching.stl": (stl(np.concatenate([SOUP, SOUP + [2, 0, 0]])), "convex", 16, 2),
    "two_edge.obj": (obj(CUBE, CUBE + [2, 2, 0]), "mesh", 16, 2),
    "two_corner.obj": (obj(CUBE, CUBE + 2), "mesh", 16, 2),
    "two_overlapping.obj": (obj(CUBE, CUBE + [1, 0, 0]), "mesh", 12, 2),
    "channel.stl": (stl(CHANNEL), "mesh", 0.528, 3),
    "hollow.stl": (stl(np.concatenate([SOUP * 2, SOUP[:, ::-1]])), "mesh", 56, None),
    "nested_out.stl": (stl(np.concatenate([SOUP * 2, SOUP])), "mesh", 64, 2),
    "tiny.stl": (stl(SOUP * 1e-8), "convex", 8e-24, 1),
    "small.stl": (stl(SOUP * 1e-7), "convex", 8e-21, 1),
    "plate.stl": (stl(SOUP * [1, 1, 1e-9]), "convex", 8e-9, 1),
    "degenerate.stl": (stl(DEGENERATE), "convex", 8, 1),
    "dent.obj": (dented(2e-5), "mesh", 8 - 4 * 2e-5 / 3, None),
    "dent_of_an_ulp.obj": (dented(2**-53), "mesh", 8, None),
    "bump.obj": (dented(-2e-5), "convex", 8 + 4 * 2e-5 / 3, 1),
    "millimetres.obj": (obj(CUBE * 1000), "convex", 8e9, 1),
    "cube.off": (off(), "convex", 8, 1),
    "two_solids.stl": (ascii_stl(("a", SOUP), ("b", SOUP + [10, 0, 0])), "mesh", 16, 2),
    "umlaut.stl": (ascii_stl(("gr\xfcn", SOUP)), "convex", 8, 1),
    "umlaut.obj": (b"# gr\xfcn, 20 \xb0C\nmtllib gr\xfcn.mtl\n" + obj(CUBE), "convex", 8, 1),
    "utf16.obj": (obj(CUBE).decode().encode("utf-16"), "convex", 8, 1),
    "umlaut.off": (off().replace(b"OFF", b"OFF\n# gr\xfcn"), "convex", 8, 1),
    "hundred.stl": (
        stl(np.concatenate([SOUP + [3 * i, 0, 0] for i in range(100)])),
        "mesh",
        800,
        100,
    ),
}


@pytest.mark.parametrize("name", FOUND)
def test_a_file_gives_the_kind_and_the_volume_of_its_solid(tmp_path, name):
    """Hulls were made of concave files (trimesh calls them convex to 1e-5), small ones merged at
    1e-8, touching and degenerate ones refused."""
    content, kind, volume, pieces = FOUND[name]
    (tmp_path / name).write_bytes(content)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        body = Body.from_file(tmp_path / name)
    assert (
        body.kind == kind
        and body.volume == pytest.approx(volume, rel=1e-7)
        and body.name == name.rsplit(".", 1)[0]
    )
    if pieces is None:
        with pytest.raises(BodyError, match=f"{name}.*(concave|cavity).*ofg.decompose"):
            Body.from_file(tmp_path / name, split=True)
    else:
        union = Body.from_file(tmp_path / name, split=True)
        assert (
            union.kind == "union"
            and len(union.pieces) == pieces
            and union.volume == pytest.approx(volume, rel=1e-7)
        )


PLY = "ply\nformat ascii 1.0\ncomment gr\xfcn\nelement vertex 8\n"
PLY += "".join(f"property float {c}\n" for c in "xyz") + "end_header\n"
CLOUD = (PLY + "\n".join("%g %g %g" % tuple(p) for p in CUBE)).encode("latin-1")
NAN = np.where(np.arange(108).reshape(12, 3, 3) == 7, np.nan, SOUP)
REFUSED = {
    "open.stl": (stl(SOUP[:-2]), ["open", "fill_holes"]),
    "nan.stl": (stl(NAN), ["vertex 2", "nan", "not finite", "Remove"]),
    "sheet.stl": (stl(SOUP[:2]), ["open"]),
    "cloud.ply": (CLOUD, ["8 points and no faces", "point cloud", "Body.convex"]),
    "cube.step": (b"ISO-10303-21;\n", ["CAD file", "Export a mesh", "STL"]),
    "cube.stl": (b"ISO-10303-21;\nHEADER;\n", ["CAD file", "Export a mesh"]),
    "cloud.xyz": (b"0 0 0\n", ["point cloud", "Body.convex"]),
    "curve.dxf": (b"0\n", ["drawing of curves"]),
    "part.tar.gz": (gzip.compress(b"x"), ["packed file", "Unpack"]),
    "half_inverted.stl": (
        stl(np.concatenate([SOUP * 1.5, SOUP[:, ::-1] + [10, 0, 0]])),
        ["shell 2 of 2", "inside-out", "fix_normals"],
    ),
    "crack.stl": (stl(SOUP + 1e-6 * JITTER), ["open", "weld=1e-05"]),
    "empty.obj": (b"", ["contains no faces", "OBJ"]),
    "novel.obj": (b"It was a dark and stormy night.\n", ["OBJ, STL, PLY"]),
    "novel.gz": (gzip.compress(b"x"), ["cannot be read"]),
    "broken.zip": (b"PK\3\4 and no more", ["cannot be read"]),
    "cut.stl.gz": (gzip.compress(stl(SOUP))[:60], ["cannot be read"]),
    "scene.3mf": (b"PK\5\6" + bytes(18), ["networkx lxml", "3MF files need", "pip install", "STL"]),
    "scene.dae": (b"<xml/>", ["pycollada", "DAE files need", "STL"]),
}


@pytest.mark.parametrize("name", REFUSED)
def test_a_file_that_is_refused_is_named_with_the_fault_and_the_remedy(tmp_path, name):
    content, words = REFUSED[name]
    (tmp_path / name).write_bytes(content)
    with pytest.raises(BodyError) as error:
        Body.from_file(tmp_path / name)
    message = str(error.value)
    assert all(word in message for word in [name, *words]), message
    assert "\n" not in message and len(message) - len(str(tmp_path)) < 450


def test_a_crack_is_welded_on_request_and_not_beyond(tmp_path):
    path = tmp_path / "crack.stl"
    path.write_bytes(REFUSED["crack.stl"][0])
    body = Body.from_file(path, weld=1e-5)
    assert len(body.vertices) == 8 and body.volume == pytest.approx(8, rel=1e-5)
    for weld, words in (
        (1e-9, "open"),
        (-1, "length of 0 or more"),
        ("x", "length of 0 or more"),
        (2.1, "more than a hundredth"),
    ):
        with pytest.raises(BodyError, match=f"crack.stl.*{words}"):
            Body.from_file(path, weld=weld)


def test_a_chain_of_near_vertices_is_not_welded_to_one():
    v = np.column_stack([np.arange(300.0), np.zeros(300), np.zeros(300)])
    with pytest.raises(
        BodyError,
        match="crate: weld = 1.5 joins vertices that are 299 apart through others between",
    ):
        solid.welded(v, np.empty((0, 3), int), 1.5, "crate")


def test_an_inverted_file_is_turned_with_a_notice(tmp_path):
    (tmp_path / "in.stl").write_bytes(stl(SOUP[:, ::-1]))
    for split in (False, True):
        with pytest.warns(BodyWarning, match="in.stl.*inside-out.*turned"):
            assert Body.from_file(tmp_path / "in.stl", split=split).volume == 8


def test_packed_files_are_read(tmp_path):
    (tmp_path / "a.stl.gz").write_bytes(gzip.compress(stl(SOUP)))
    (tmp_path / "a.obj.bz2").write_bytes(bz2.compress(obj(CUBE)))
    with zipfile.ZipFile(tmp_path / "a.zip", "w") as z:
        (
            z.writestr("readme.txt", "x"),
            z.writestr("m/a.stl", stl(SOUP)),
            z.writestr("m/b.stl", stl(SOUP + [9, 0, 0])),
        )
    assert (
        Body.from_file(tmp_path / "a.stl.gz").volume
        == Body.from_file(tmp_path / "a.obj.bz2").volume
        == 8
    )
    assert Body.from_file(tmp_path / "a.stl.gz").name == "a" and Body.from_file(
        tmp_path / "a.zip"
    ).volume == pytest.approx(16)


@pytest.mark.parametrize("name", ["bomb.zip", "bomb.3mf", "bomb.stl.gz", "bomb.stl", "bomb.gltf"])
def test_what_is_too_large_is_refused_before_it_is_read(tmp_path, monkeypatch, name):
    """A ZIP of 1.5 MB that unpacks to 1.5 GB took the memory of the machine."""
    path, size = tmp_path / name, 3 * 2**20
    if name.endswith((".zip", ".3mf")):
        with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as z:
            z.writestr("a.stl", bytes(size))
        monkeypatch.setattr(zipfile.ZipFile, "read", lambda *_: pytest.fail("unpacked"))
    elif name.endswith(".gz"):
        path.write_bytes(gzip.compress(bytes(size)))
    elif name.endswith(".gltf"):
        path.write_text(json.dumps({"buffers": [{"uri": "big.bin", "byteLength": size}]}))
        (tmp_path / "big.bin").write_bytes(bytes(size))
    else:
        path.write_bytes(bytes(size))
    with pytest.raises(BodyError, match=f"{name} contains more than 2 MiB.*limit.*most=BYTES"):
        Body.from_file(path, most=2 * 2**20)
    assert meshfile.MOST_BYTES == 512 * 2**20


def test_a_huge_plain_file_is_refused_by_its_size(tmp_path):
    with open(tmp_path / "huge.obj", "wb") as file:
        file.truncate(600 * 2**20)  # a file with a hole takes no room
    with pytest.raises(BodyError, match="huge.obj contains more than 512 MiB"):
        Body.from_file(tmp_path / "huge.obj")


def test_scenes_are_placed_and_mirrored_parts_turned():
    scene = trimesh.Scene()
    box = trimesh.Trimesh(CUBE, FACES, process=False)
    scene.add_geometry(box)
    scene.add_geometry(
        box, transform=np.diag([-1.0, 1, 1, 1]) + np.array([[0, 0, 0, 10], *[[0] * 4] * 3])
    )
    body = Body.from_trimesh(scene, "pair")
    assert body.volume == pytest.approx(16) and body.size == pytest.approx((12**2 + 8) ** 0.5)
    assert len(Body.from_trimesh(scene, split=True).pieces) == 2


@pytest.mark.parametrize(
    "thing", [trimesh.PointCloud(CUBE), trimesh.Scene(), "cube.stl", None, CUBE]
)
def test_what_is_no_mesh_is_said(thing):
    with pytest.raises(BodyError, match="thing"):
        Body.from_trimesh(thing, "thing")


def test_a_body_is_convex_only_if_that_is_proved():
    """trimesh asks neighbours alone, to 1e-5 of the size."""
    ball = trimesh.creation.icosphere(3)
    assert Body.from_trimesh(ball).kind == "convex"
    pressed = ball.vertices.copy()
    pressed[7] *= 1 - 1e-2
    assert Body.from_trimesh(trimesh.Trimesh(pressed, ball.faces, process=False)).kind == "mesh"
    gridded = trimesh.Trimesh(CUBE, FACES, process=False).subdivide().subdivide().subdivide()
    assert Body.from_trimesh(gridded).kind == "convex" and Body.from_trimesh(gridded).volume == 8
    twice = trimesh.util.concatenate([ball, ball])
    assert Body.from_trimesh(twice).kind == "mesh" and Body.from_trimesh(
        twice
    ).volume == pytest.approx(ball.volume)
    torus = trimesh.creation.torus(1.0, 0.25, major_sections=12, minor_sections=6)
    assert Body.from_trimesh(torus).kind == "mesh"
