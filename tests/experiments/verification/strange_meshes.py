# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Malformed meshes, mutated one by one, as a stranger may send them."""

import itertools
import os
import struct
from pathlib import Path

import numpy as np

NUMBERS = ("nan", "inf", "1e999", "1e308", "x", "", "9" * 400)
CUBE = np.array(list(itertools.product((0.0, 1.0), repeat=3)))
FACES = np.array(
    [
        [0, 1, 3],
        [0, 3, 2],
        [4, 6, 7],
        [4, 7, 5],
        [0, 4, 5],
        [0, 5, 1],
        [2, 3, 7],
        [2, 7, 6],
        [0, 2, 6],
        [0, 6, 4],
        [1, 5, 7],
        [1, 7, 3],
    ]
)


def meshes(folder: Path) -> list[Path]:
    """Files for Body.from_file, none of which is a body."""
    made = {}
    for number in NUMBERS:
        made[f"vertex-{len(made)}.obj"] = obj(first=f"v {number} 0 0")
        made[f"vertex-{len(made)}.off"] = off(first=f"{number} 0 0")
    for index in (0, -1, -99, 9, 10**6, 2**31, 2**63, 10**30, "x", "1/2/3/4", "", "1.5"):
        made[f"index-{len(made)}.obj"] = obj(face=f"f 1 2 {index}")
    for index in (-1, 8, 10**6, 2**31, 10**30, "x", "1.5"):
        made[f"index-{len(made)}.off"] = off(face=f"3 0 1 {index}")
    for head in (
        "0 0 0",
        "8 12",
        "-8 12 0",
        "8 -12 0",
        "10000000000 12 0",
        "8 10000000000 0",
        "x 12 0",
        "8 12 0 0 0",
        "7 12 0",
        "9 12 0",
    ):
        made[f"head-{len(made)}.off"] = off(head=head)
    for name in ("empty", "nothing", "nul", "noise"):
        for suffix in ("obj", "off", "stl", "ply", "glb"):
            made[f"{name}.{suffix}"] = {
                "empty": b"",
                "nothing": b"\n\n",
                "nul": b"\0" * 4096,
                "noise": bytes(range(256)) * 9,
            }[name]
    for count in (0, 1, 12, 10**6, 2**32 - 1):
        made[f"count-{count}.stl"] = (
            b"\0" * 80 + struct.pack("<I", count) + b"\xff" * 50 * min(count, 3)
        )
    made["open.obj"] = obj(faces=FACES[2:])
    made["sheet.obj"] = obj(faces=FACES[:1])
    made["flat.off"] = off(vertices=CUBE * [1, 1, 0])
    made["points.off"] = off(faces=FACES[:0])
    made["twice.obj"] = obj(faces=np.concatenate([FACES, FACES[:1]]))
    made["turned.obj"] = obj(faces=np.concatenate([FACES[:1, ::-1], FACES[1:]]))
    paths = []
    for name, content in made.items():
        paths.append(folder / name)
        paths[-1].write_bytes(content if isinstance(content, bytes) else content.encode())
    (folder / "folder.obj").mkdir()
    os.mkfifo(folder / "pipe.obj")
    return [*paths, folder / "folder.obj", folder / "pipe.obj"]


def obj(first="v 0 0 0", face="f 1 2 4", faces=FACES) -> str:
    rows = [f"v {x} {y} {z}" for x, y, z in CUBE], [f"f {a} {b} {c}" for a, b, c in faces + 1]
    return "\n".join([first, *rows[0][1:], face, *rows[1][1:]]) + "\n"


def off(first="0 0 0", face="3 0 1 3", head="8 12 0", vertices=CUBE, faces=FACES) -> str:
    rows = [f"{x} {y} {z}" for x, y, z in vertices], [f"3 {a} {b} {c}" for a, b, c in faces]
    head = head if len(faces) == len(FACES) else f"8 {len(faces)} 0"
    first = first if vertices is CUBE else rows[0][0]
    return (
        "\n".join(["OFF", head, first, *rows[0][1:], *([face] * bool(len(faces))), *rows[1][1:]])
        + "\n"
    )
