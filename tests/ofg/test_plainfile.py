# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Polygons in files, and damaged files: nothing outside the solid, nothing lost unsaid."""

import struct

import numpy as np
import pytest

from ofg import Body, BodyError

CUBE = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
QUADS = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
SOUP = CUBE[np.array([t for a, b, c, d in QUADS for t in ((a, b, c), (a, c, d))])]
ELL = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
DART = [(0, 0), (2, 0), (0.5, 0.5), (0, 2)]


def prism(outline, start):
    """Vertices and polygons of a prism of height 1 whose outline begins at another corner."""
    n, outline = len(outline), outline[start:] + outline[:start]
    v = [(x, y, z) for z in (0, 1) for x, y in outline]
    sides = [(i, (i + 1) % n, (i + 1) % n + n, i + n) for i in range(n)]
    return v, [tuple(range(n))[::-1], tuple(range(n, 2 * n)), *sides]


def obj(v, polygons):
    rows = ["v %.17g %.17g %.17g" % tuple(p) for p in v]
    return "\n".join(rows + ["f " + " ".join(f"{i + 1}//1" for i in p) for p in polygons]).encode()


def off(v, polygons):
    rows = ["%.17g %.17g %.17g" % tuple(p) for p in v] + [
        " ".join(map(str, [len(p), *p])) for p in polygons
    ]
    return "\n".join(["OFF", f"{len(v)} {len(polygons)} 0", *rows]).encode()


def ply(v, polygons, form):
    head = ["ply", f"format {form} 1.0", f"element vertex {len(v)}"]
    head += [f"property double {c}" for c in "xyz"] + ["property uchar red"]
    head += [f"element face {len(polygons)}", "property list uchar int vertex_indices"]
    head = "\n".join([*head, "property float quality", "end_header\n"]).encode()
    if form == "ascii":
        rows = ["%.17g %.17g %.17g 7" % tuple(p) for p in v]
        rows += [" ".join(map(str, [len(p), *p, 0.5])) for p in polygons]
        return head + "\n".join(rows).encode()
    end = "<" if "little" in form else ">"
    body = [struct.pack(end + "dddB", *p, 7) for p in v]
    body += [struct.pack(f"{end}B{len(p)}if", len(p), *p, 0.5) for p in polygons]
    return head + b"".join(body)


WRITERS = {
    "a.obj": obj,
    "a.off": off,
    "text.ply": lambda v, p: ply(v, p, "ascii"),
    "little.ply": lambda v, p: ply(v, p, "binary_little_endian"),
    "big.ply": lambda v, p: ply(v, p, "binary_big_endian"),
}


@pytest.mark.parametrize("name", WRITERS)
@pytest.mark.parametrize("outline, volume", ((ELL, 3), (DART, 1)), ids=("L", "dart"))
def test_a_concave_polygon_has_no_triangle_outside_it(tmp_path, name, outline, volume):
    """A fan of it has: sheets of no thickness, which touch what the solid does not."""
    sides = np.linalg.norm(np.roll(outline, 1, axis=0) - outline, axis=1).sum()
    for start in range(len(outline)):
        (tmp_path / name).write_bytes(WRITERS[name](*prism(outline, start)))
        body = Body.from_file(tmp_path / name)
        assert body.kind == "mesh" and body.volume == pytest.approx(volume, rel=1e-12)
        assert body.to_trimesh().area == pytest.approx(2 * volume + sides, rel=1e-12)


def stl(triangles, said=None, extra=b""):
    rows = [struct.pack("<12fH", 0, 0, 0, *t.ravel(), 0) for t in triangles]
    count = struct.pack("<I", len(triangles) if said is None else said)
    return bytes(80) + count + b"".join(rows) + extra


def ascii_stl(*solids):
    facets = "facet normal 0 0 0\nouter loop\n%sendloop\nendfacet\n"
    corners = [["".join("vertex %g %g %g\n" % tuple(p) for p in t) for t in s] for s in solids]
    return "".join(
        f"solid facet vertex {i}\n{''.join(facets % t for t in some)}endsolid facet vertex\n"
        for i, some in enumerate(corners)
    )


TWO = ascii_stl(SOUP, SOUP + [10, 0, 0])


@pytest.mark.parametrize("text", (TWO, TWO.upper(), TWO.replace("\n", "\r\n\t"), TWO + "the end"))
def test_ascii_stl_is_read_by_its_words(tmp_path, text):
    (tmp_path / "two.stl").write_text(text)
    assert Body.from_file(tmp_path / "two.stl").volume == 16


def test_a_few_bytes_after_a_binary_stl_are_passed_over(tmp_path):
    (tmp_path / "a.stl").write_bytes(stl(SOUP, extra=b"padded"))
    assert Body.from_file(tmp_path / "a.stl").volume == 8


REFUSED = {  # the second cube of the first two was dropped without a word
    "cut_in_a_number.stl": (TWO[: TWO.rindex("vertex") - 60].encode(), "24 facets.*truncated"),
    "cut_in_a_facet.stl": (TWO[: TWO.rindex("facet normal") + 30].encode(), "truncated"),
    "said_more.stl": (stl(SOUP, said=20), "gives 20 triangles, but its length fits 12"),
    "said_less.stl": (stl(SOUP, said=10), "gives 10 triangles, but its length fits 12"),
    "cut.stl": (stl(SOUP)[:-30], "gives 12 triangles, but its length fits 11.4"),
    "zero.obj": (obj(CUBE, QUADS) + b"\nf 0 1 2\n", "names vertex 0; OBJ counts from 1"),
    "beyond.obj": (obj(CUBE, QUADS) + b"\nf 1 2 99\n", "names vertex 99 of 8"),
    "back.obj": (obj(CUBE, QUADS) + b"\nf -1 -2 -9\n", "names vertex -9"),
    "word.obj": (obj(CUBE, QUADS) + b"\nf 1 2 x\n", "uses 'x' as a vertex"),
    "short.obj": (obj(CUBE, QUADS) + b"\nv 1 2\n", "fewer than three coordinates"),
    "cut.off": (off(CUBE, QUADS)[:-12], "ends before its 8 vertices and 6 faces|names a vertex"),
    "empty.off": (b"", "does not begin with OFF"),
    "beyond.off": (off(CUBE, [*QUADS, (0, 1, 8)]), "not one of 0 to 7"),
    "cut.ply": (ply(CUBE, QUADS, "binary_little_endian")[:-9], "ends before its elements do"),
    "text_cut.ply": (ply(CUBE, QUADS, "ascii")[:-30], "ends before its elements do"),
    "type.ply": (ply(CUBE, QUADS, "ascii").replace(b"uchar red", b"colour red"), "colour red"),
    "empty.ply": (b"", "no PLY header"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_a_damaged_file_is_refused_and_what_is_wrong_is_said(tmp_path, name):
    content, words = REFUSED[name]
    (tmp_path / name).write_bytes(content)
    with pytest.raises(BodyError, match=f"{name} cannot be read.*({words}).*Give a triangle mesh"):
        Body.from_file(tmp_path / name)


@pytest.mark.parametrize("path", (None, 5, b"a.stl", ["a.stl"], np.nan))
def test_what_is_no_path_is_said(path):
    with pytest.raises(TypeError, match="must be the path of a mesh file"):
        Body.from_file(path)
