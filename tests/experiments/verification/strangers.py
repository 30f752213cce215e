# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Malformed cases, runs and configurations, mutated one by one, as a stranger may send them."""

import itertools
import json
import os
import shutil
from pathlib import Path

import numpy as np
import pandas as pd

from .strange_meshes import CUBE, FACES

#: JSON in place of a value
VALUES = (
    None,
    True,
    -1,
    10**6,
    2**31,
    2**63,
    10**400,
    float("nan"),
    float("inf"),
    "",
    "9" * 400,
    "\x00",
    "[/red]",
    "../../x",
    [],
    [[]],
    {},
    [0],
    ["x"],
    [None],
    [1e308] * 3,
)
#: of each kind; 200 in all are the least that count
LEAST = {
    "mesh": 60,
    "case": 100,
    "run": 90,
    "configuration": 70,
}


def case() -> dict:
    """A case file that is right: two cubes, apart."""
    body = {
        "body": "cube",
        "kind": "mesh",
        "vertices": CUBE.ravel().tolist(),
        "faces": FACES.ravel().tolist(),
    }
    row = {
        "case": "a/1/0000",
        "scenario": "a",
        "level": 1.0,
        "question": "motion",
        "body_a": "cube",
        "body_b": "cube",
        "label": "clear",
        "start": "clear",
        "end": "clear",
        "gap": 1.0,
        "t_lo": None,
        "t_hi": None,
        "tags": {},
        "certificate": "{}",
        "position_b": [5.0, 0, 0],
        "quaternion_b": [1.0, 0, 0, 0],
        "displacement": [0.1, 0, 0],
        "axis": [0, 0, 1.0],
        "angle": 0.1,
        "about": [0.0, 0, 0],
    }
    said = {
        "case": "a/1/0000",
        "method": "ofg k=8",
        "status": "ok",
        "hit": False,
        "time": None,
        "detail": "",
    }
    return {"case": row, "bodies": [body], "observations": [said]}


def cases(folder: Path) -> list[Path]:
    """Case files of which a field holds something else, or that are none."""
    texts = []
    for part in ("body", "kind", "vertices", "faces"):
        for value in VALUES:
            texts.append(changed(case(), ("bodies", 0, part), value))
    for part in (
        "question",
        "body_a",
        "label",
        "level",
        "gap",
        "t_lo",
        "tags",
        "certificate",
        "position_b",
        "quaternion_b",
        "axis",
        "angle",
        "case",
    ):
        for value in VALUES[:: 2 if part in ("gap", "t_lo") else 3]:
            texts.append(changed(case(), ("case", part), value))
    for part in ("case", "method", "status", "hit", "time", "detail"):
        texts += [changed(case(), ("observations", 0, part), value) for value in VALUES[::4]]
    for part in ("piece_vertices", "piece_faces"):
        for value in ([8], [4, 4], [-8, 16], [10**9], [2**62, 2**62], [0, 8], "8", [8.5]):
            union = changed(case(), ("bodies", 0, "kind"), "union")
            texts.append(
                changed(
                    changed(union, ("bodies", 0, "piece_vertices"), [8]), ("bodies", 0, part), value
                )
            )
    for faces in (
        FACES[2:],
        FACES[:, ::-1],
        FACES + 10**6,
        FACES - 1,
        FACES[:1],
        np.concatenate([FACES, FACES]),
    ):
        for kind in ("mesh", "convex"):
            made = changed(case(), ("bodies", 0, "kind"), kind)
            texts.append(changed(made, ("bodies", 0, "faces"), faces.ravel().tolist()))
    texts += [
        [],
        1,
        "x",
        {},
        {"case": {}},
        {"bodies": []},
        {"case": [], "bodies": {}},
        {"case": {}, "bodies": [1]},
    ]
    raw = ["", "{", "\0", "[" * 100_000, '{"case": ' + "9" * 5000 + "}", '{"a":' * 50_000]
    return _files(folder, [*map(json.dumps, texts), *raw], "json") + [
        _latin(folder / "latin.json"),
        _folder(folder / "f.json"),
        _pipe(folder / "p.json"),
    ]


def configurations(folder: Path) -> list[Path]:
    """TOML files that no run can be made from."""
    right = {
        "seed": "1",
        "methods": '["ofg k=8"]',
        "scenarios": '[{name = "thin_wall", cases = 1}]',
    }
    wrong = (
        '"x"',
        "-1",
        "1.5",
        "true",
        "nan",
        "inf",
        "9" * 30,
        "9" * 5000,
        "[]",
        "{}",
        '[""]',
        "[[]]",
        '["../x"]',
        '"' + "9" * 400 + '"',
        "1979-05-27",
        "[" * 5000 + "]" * 5000,
    )
    texts = [
        "\n".join(f"{k} = {v}" for k, v in {**right, name: value}.items())
        for name in right
        for value in wrong
        if (name, value) != ("seed", "true")
    ]
    texts += [
        "\n".join([*(f"{k} = {v}" for k, v in right.items()), line])
        for line in (
            'title = ["x"]',
            "about = 1",
            "timing = 1",
            "timing = {cases = -1}",
            "timing = {cases = 999999999999}",
            "timing = {seconds = nan}",
            'unknown = "[/red]"',
            "tables = [{name = '../x', title = 't', value = 'wrong'}]",
            "tables = [{name = 'x', title = 't', value = 'all'}]",
            "tables = 1",
            "query_seconds = -1",
            "query_seconds = inf",
            "method_files = ['none.py']",
            "scenario_files = ['/dev/null']",
            "stepping = {runs = 0}",
            "seed = 2",
            'title = "\\u0000\\u001b[31m"\nmethods2 = 1',
            f'title = "{"x" * 10000}"',
        )
    ]
    texts += [
        "",
        "x",
        "= 1",
        "[",
        "a.b.c = ",
        "\0",
        "seed = 1",
        "[[scenarios]]\n" * 2000,
        "a." * 30_000 + "b = 1",
    ]
    big = folder / "big.toml"
    with open(big, "wb") as file:
        file.truncate(2**30)  # a gigabyte of nothing
    return _files(folder, texts, "toml") + [
        big,
        _latin(folder / "latin.toml"),
        _folder(folder / "f.toml"),
        _pipe(folder / "p.toml"),
    ]


def runs(folder: Path, right: Path) -> list[Path]:
    """Copies of a run with one file changed."""
    made = []

    def copy() -> Path:
        made.append(folder / f"run{len(made):03d}")
        shutil.copytree(right, made[-1])
        return made[-1]

    names = (
        "config.json",
        "manifest.json",
        "cases.parquet",
        "bodies.parquet",
        "observations.parquet",
    )
    for name in names:
        content = (right / name).read_bytes()
        for changed_ in (
            b"",
            b"\0" * 100,
            content[: len(content) // 2],
            content[::-1],
            b"[" * 50_000,
            b'{"versions": 1, "started": []}',
            b"9" * 5000,
        ):
            (copy() / name).write_bytes(changed_)
        at = copy() / name
        at.unlink()
        os.mkfifo(at)
        at = copy() / name
        at.unlink()
        at.mkdir()
    for name in names[2:]:
        frame = pd.read_parquet(right / name)
        for column in frame:
            at = copy()
            frame.drop(columns=column).to_parquet(at / name)
            frame.assign(**{column: _other(frame[column])}).to_parquet(copy() / name)
        pd.concat([frame, frame]).to_parquet(copy() / name)
        frame.iloc[:0].to_parquet(copy() / name)
    _bodies(copy, right)
    return made


def _bodies(copy, right: Path) -> None:
    """Bodies that pass for numbers and are none."""
    frame = pd.read_parquet(right / "bodies.parquet")
    for field, value in itertools.product(
        ("vertices", "faces", "piece_vertices", "piece_faces"), (10**6, -1, 2**31, np.nan)
    ):
        lists = [np.array(v, float if value != value else None) for v in frame[field]]
        for v in lists:
            v[0] = value
        frame.assign(**{field: lists}).to_parquet(copy() / "bodies.parquet")
    for cut in (0, 1, 3, -3, -1):
        frame.assign(faces=[v[:cut] for v in frame.faces]).to_parquet(copy() / "bodies.parquet")
        frame.assign(vertices=[v[:cut] for v in frame.vertices]).to_parquet(
            copy() / "bodies.parquet"
        )
    frame.assign(body=frame.body.tolist()[::-1]).to_parquet(copy() / "bodies.parquet")
    cases = pd.read_parquet(right / "cases.parquet")
    for text in (
        "",
        "{",
        "[" * 50_000,
        "9" * 5000,
        '{"clear": {"tree": 1}}',
        '{"hit": {"point": ["1e999999999", "1", "1"]}}',
        '{"hit": 1}',
        "null",
    ):
        cases.assign(certificate=text).to_parquet(copy() / "cases.parquet")
        cases.assign(tags=text).to_parquet(copy() / "cases.parquet")
    for name in (
        "../../x",
        "/x",
        "a/../../x",
        "[/red]",
        "\x1b[31m",
        "x" * 5000,
        "",
        "..",
        "a\\b",
        "@@SCRIPT@@",
    ):
        cases.assign(scenario=name).to_parquet(copy() / "cases.parquet")
        cases.assign(case=[f"{name}/{i}" for i in range(len(cases))]).to_parquet(
            copy() / "cases.parquet"
        )


def _other(values: pd.Series):
    """The column with values of another type."""
    return (
        [f"word {i}" for i in range(len(values))]
        if values.dtype.kind in "iufb"
        else np.full(len(values), np.nan)
    )


def _files(folder: Path, texts, suffix: str) -> list[Path]:
    paths = [folder / f"{i:03d}.{suffix}" for i in range(len(texts))]
    for path, text in zip(paths, texts):
        path.write_text(text)
    return paths


def _latin(path: Path) -> Path:
    path.write_bytes(b"\xff\xfe\xe9" * 50)
    return path


def _folder(path: Path) -> Path:
    path.mkdir()
    return path


def _pipe(path: Path) -> Path:
    os.mkfifo(path)
    return path


def changed(content: dict, where: tuple, value) -> dict:
    content = json.loads(json.dumps(content))
    at = content
    for key in where[:-1]:
        at = at[key]
    at[where[-1]] = value
    return content
