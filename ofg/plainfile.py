# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Read OBJ, OFF, PLY and STL files as arrays: polygons with any number of corners, without
silent loss.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from .polygons import triangulated

Part = tuple[np.ndarray, np.ndarray]  #: (vertices (n, 3), faces (m, 3))
#: (name, type, type of its count or None) of each property of an element
Properties = list[tuple[str, str, str | None]]
#: the values of each property of an element
Columns = Mapping[str, np.ndarray | list[Any]]
PLY_TYPES = {
    **dict(char="i1", int8="i1", uchar="u1", uint8="u1", short="i2", int16="i2", ushort="u2"),
    **dict(uint16="u2", int="i4", int32="i4", uint="u4", uint32="u4", float="f4", float32="f4"),
    **dict(double="f8", float64="f8"),
}


class Damaged(ValueError):
    """A fault of a file, worded as the end of a sentence."""


def parts(data: bytes, kind: str) -> list[Part]:
    """The objects in a file of this format, possibly without faces. Damaged if it does not
    conform.
    """
    if kind == "stl":
        return _stl(data)
    return _ply(data) if kind == "ply" else READERS[kind](text_of(data))


def text_of(data: bytes) -> str:
    """Text whose comments and names may be in Latin-1 or UTF-16."""
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return data.decode("utf-16", errors="replace")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("latin-1")


def _obj(text: str) -> list[Part]:
    rows: list[list[str]] = []
    objects: list[list[list[int]]] = [[]]
    for number, line in enumerate(re.sub(r"\\\r?\n", " ", text).splitlines(), 1):
        words = line.partition("#")[0].split()
        if not words:
            continue
        if words[0] == "v":
            rows.append(words[1:4])
        elif words[0] == "o" and objects[-1]:
            objects.append([])
        elif words[0] == "f":
            objects[-1].append([_index(w, len(rows), number) for w in words[1:]])
    v = _floats(rows)
    most = max((max(p) for some in objects for p in some if p), default=-1)
    if most >= len(v):
        raise Damaged(f"a face names vertex {most + 1} of {len(v)}")
    return [(v, triangulated(v, some)) for some in objects if some or len(objects) == 1]


def _index(word: str, n: int, line: int) -> int:
    """A vertex index from 0; OBJ counts from 1, or backwards from the last vertex with -1."""
    try:
        i = int(word.partition("/")[0])
    except ValueError:
        raise Damaged(f"a face near line {line} uses {word[:20]!r} as a vertex") from None
    if i == 0 or i < -n:
        raise Damaged(f"a face near line {line} names vertex {i}; OBJ counts from 1")
    return i - 1 if i > 0 else n + i


def _off(text: str) -> list[Part]:
    lines = [w for line in text.splitlines() if (w := line.partition("#")[0].split())]
    if not lines or not lines[0][0].upper().endswith("OFF"):
        raise Damaged("it does not begin with OFF")
    lines[0] = lines[0][1:]
    lines = lines if lines[0] else lines[1:]
    try:
        n, m = (int(w) for w in lines[0][:2])
    except (ValueError, IndexError):
        raise Damaged("the numbers of vertices and faces are missing after OFF") from None
    if len(lines) < 1 + n + m:
        raise Damaged(f"it ends before its {n} vertices and {m} faces do")
    v = _floats([w[:3] for w in lines[1 : 1 + n]])
    try:
        faces = [[int(x) for x in w[1 : 1 + int(w[0])]] for w in lines[1 + n : 1 + n + m]]
    except ValueError:
        raise Damaged("a face is not a row of whole numbers") from None
    return [(v, _checked(v, faces))]


def _checked(v: np.ndarray, polygons: list[list[int]] | np.ndarray) -> np.ndarray:
    if isinstance(polygons, list):
        ends = np.array([(min(p), max(p)) for p in polygons if p])
    else:
        ends = polygons
    if len(ends) and not 0 <= np.min(ends) <= np.max(ends) < len(v):
        raise Damaged(f"a face names a vertex that is not one of 0 to {len(v) - 1}")
    return triangulated(v, polygons)


def _floats(rows: Sequence[Sequence[str]]) -> np.ndarray:
    if any(len(row) != 3 for row in rows):
        raise Damaged("a vertex has fewer than three coordinates")
    try:
        return np.array(rows, dtype=object).reshape(-1, 3).astype(np.float64)
    except ValueError as error:
        raise Damaged(f"a vertex is not three numbers: {error}") from None


def _ply(data: bytes) -> list[Part]:
    head, mark, body = data.partition(b"end_header")
    if not data.startswith(b"ply") or not mark:
        raise Damaged("it has no PLY header")
    body = body[body.find(b"\n") + 1 :]
    form, elements = _ply_header(head.decode("latin-1"))
    take = _PlyText(body) if form == "ascii" else _PlyBytes(body, form)
    found = {name: take.element(count, properties) for name, count, properties in elements}
    if "vertex" not in found:
        raise Damaged("it has no vertices")
    try:
        v = np.column_stack([found["vertex"][c] for c in "xyz"]).astype(np.float64)
    except KeyError as error:
        raise Damaged(f"its vertices have no {error.args[0]}") from None
    face = found.get("face", {})
    polygons = face.get("vertex_indices", face.get("vertex_index", []))
    if isinstance(polygons, list):
        polygons = [[int(i) for i in p] for p in polygons]
    return [(v, _checked(v, polygons))]


def _ply_header(head: str) -> tuple[str, list[tuple[str, int, Properties]]]:
    """(form, [(element, count, its properties)])."""
    form = ""
    elements: list[tuple[str, int, Properties]] = []
    for words in map(str.split, head.splitlines()):
        try:
            if words[:1] == ["format"]:
                form = words[1]
            elif words[:1] == ["element"]:
                elements.append((words[1], int(words[2]), []))
            elif words[:2] == ["property", "list"]:
                elements[-1][2].append((words[4], PLY_TYPES[words[3]], PLY_TYPES[words[2]]))
            elif words[:1] == ["property"]:
                elements[-1][2].append((words[2], PLY_TYPES[words[1]], None))
        except (IndexError, KeyError, ValueError):
            raise Damaged(f"its header contains {' '.join(words)[:60]!r}") from None
    if form not in ("ascii", "binary_little_endian", "binary_big_endian"):
        raise Damaged(f"its header gives the format {form[:40]!r}")
    return form, elements


class _PlyText:
    def __init__(self, body: bytes):
        self.words, self.at = body.split(), 0

    def take(self, n: int) -> list[bytes]:
        self.at += n
        if self.at > len(self.words) or n < 0:
            raise Damaged("it ends before its elements do")
        return self.words[self.at - n : self.at]

    def element(self, count: int, properties: Properties) -> Columns:
        out: dict[str, list[Any]] = {name: [] for name, _, _ in properties}
        try:
            if not any(listed for _, _, listed in properties):
                rows = np.array(self.take(count * len(properties)), dtype=object).astype(float)
                return dict(zip(out, rows.reshape(count, -1).T))
            for _ in range(count):
                for name, _, listed in properties:
                    if listed:
                        out[name].append([float(w) for w in self.take(int(self.take(1)[0]))])
                    else:
                        out[name].append(float(self.take(1)[0]))
        except ValueError as error:
            raise Damaged(f"an element is not a row of numbers: {error}") from None
        return out


class _PlyBytes:
    def __init__(self, body: bytes, form: str):
        self.body, self.at, self.end = body, 0, "<" if "little" in form else ">"

    def take(self, kind: Any, n: int) -> np.ndarray:
        kind = np.dtype(kind)
        if n < 0 or self.at + n * kind.itemsize > len(self.body):
            raise Damaged("it ends before its elements do")
        out = np.frombuffer(self.body, kind, n, self.at)
        self.at += n * kind.itemsize
        return out

    def element(self, count: int, properties: Properties) -> Columns:
        if not any(listed for _, _, listed in properties):
            kind = [(name, self.end + type_) for name, type_, _ in properties]
            rows = self.take(kind, count) if kind else None
            return {} if rows is None else {name: rows[name] for name, _, _ in properties}
        return self._alike(count, properties) or self._one_by_one(count, properties)

    def _alike(self, count: int, properties: Properties) -> Columns | None:
        """Rows whose lists all have the length of those in the first row, as in most files."""
        start = self.at
        kind: list[tuple[Any, ...]] = []
        first = self._one_by_one(min(count, 1), properties)
        self.at = start
        for name, type_, listed in properties:
            length = len(first[name][0]) if listed and count else 1
            kind += [("n " + name, self.end + listed)] if listed else []
            kind.append((name, self.end + type_, (length,) if listed else ()))
        if start + count * np.dtype(kind).itemsize > len(self.body):
            return None
        rows = self.take(kind, count)
        if all((rows["n " + p[0]] == rows[p[0]].shape[1]).all() for p in properties if p[2]):
            return {name: rows[name] for name, _, _ in properties}
        self.at = start
        return None

    def _one_by_one(self, count: int, properties: Properties) -> Columns:
        out: dict[str, list[Any]] = {name: [] for name, _, _ in properties}
        for _ in range(count):
            for name, type_, listed in properties:
                n = int(self.take(self.end + listed, 1)[0]) if listed else 1
                value = self.take(self.end + type_, n)
                out[name].append(value if listed else value[0])
        return out


def _stl(data: bytes) -> list[Part]:
    said = int.from_bytes(data[80:84], "little") if len(data) >= 84 else 0
    extra = len(data) - 84 - 50 * said
    if len(data) >= 84 and said and 0 <= extra < 50:  # some writers pad the end
        return _soup(_binary_stl(data, said))
    text = text_of(data)
    words = re.search(r"\bfacet\b", text, re.I) or len(data) < 84
    if words and re.match(r"\s*solid\b", text, re.I):
        return _soup(_ascii_stl(text))
    if len(data) < 84 or (not said and not extra):
        return [(np.empty((0, 3)), np.empty((0, 3), int))]
    raise Damaged(
        f"its header gives {said} triangles, but its length fits {(len(data) - 84) / 50:.8g}: it "
        "is truncated or damaged"
    )


def _soup(corners: np.ndarray) -> list[Part]:
    return [(corners.reshape(-1, 3), np.arange(len(corners) * 3).reshape(-1, 3))]


def _binary_stl(data: bytes, n: int) -> np.ndarray:
    kind = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    return np.frombuffer(data, kind, n, 84)["corners"].astype(np.float64)


def _ascii_stl(text: str) -> np.ndarray:
    """Corners found by the word vertex; the lines that name solids may contain any words."""
    words = re.sub(r"(?im)^[ \t]*(end)?solid\b.*$", "", text).lower().split()
    at = [i for i, word in enumerate(words) if word == "vertex"]
    facets, ended = words.count("facet"), words.count("endfacet")
    if len(at) != 3 * facets or ended != facets:
        raise Damaged(
            f"it begins {facets} facets, ends {ended} and has {len(at)} corners: it is truncated "
            "or damaged"
        )
    return _floats([words[i + 1 : i + 4] for i in at]).reshape(-1, 3, 3)


READERS = {"obj": _obj, "off": _off}
KINDS = ("obj", "off", "ply", "stl")
