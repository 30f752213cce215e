# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""What proves the answers about surfaces and unions, left out piece by piece: the fuzzer must
notice.
"""

import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
COMPILER = shutil.which("g++") or shutil.which("c++")
QUERIES = 8000  # most mutants end within a hundred

SIDES, TREE, SOLID = "verified_sides.hpp", "verified_tree.hpp", "verified_solid.hpp"
CROSSING, SURFACE = "verified_crossing.hpp", "verified_surface.hpp"
MUTANTS = {
    "none": [],
    "no exact fallback": [(SIDES, "return exactly(a, b, c, d);", "return det > 0 ? 1 : -1;")],
    "no margin of doubles": [(SIDES, "if (det > doubt) return 1;", "if (det > 0) return 1;")],
    "points on a plane": [
        (
            SIDES,
            "return n.x.sign() ? n.x.sign() : n.y.sign() ? n.y.sign() : n.z.sign();",
            "return 0;",
        )
    ],
    "a move along one axis": [
        (SIDES, "n.x.sign() ? n.x.sign() : n.y.sign() ? n.y.sign() : n.z.sign()", "n.x.sign()")
    ],
    "a move that depends on the order": [
        (SIDES, "Number(double(p.moves) - double(a.moves))", "Number(double(p.moves))")
    ],
    "boxes that are not rounded outward": [
        (TREE, "float(extent[i] + 0x1p-20)", "float(extent[i])"),
        (TREE, "margin = 0x1p-16f", "margin = 0"),
    ],
    "no containment": [(SOLID, "crossing.contained(answer.counts.evaluated)", "false")],
    "one shell for all": [
        (SURFACE, "if (!seen[std::size_t(shell)]) shells", "if (shells.empty()) shells")
    ],
    "one sign of two": [(CROSSING, " && sides_(a, a2, b2, b) < 0;", ";")],
    "faces wound one way": [(CROSSING, "turn_a = above_a[n] < 0", "turn_a = false")],
    "no exact fallback of a face and a piece": [
        (SOLID, "return meets_exactly(hull, triangle, ph, pt, Portal(), axis);", "return false;")
    ],
    "no piece inside a surface": [
        (SOLID, "crossing.winding(inside, a.surface, false, answer.counts.evaluated) != 0", "false")
    ],
}


@pytest.mark.skipif(COMPILER is None, reason="no C++ compiler is installed")
@pytest.mark.timeout(900)
@pytest.mark.parametrize("name", MUTANTS)
def test_the_fuzzer_notices(name, tmp_path):
    include = tmp_path / "include" / "ofg"
    shutil.copytree(ROOT / "ofg/include/ofg", include)
    for file, old, new in MUTANTS[name]:
        source = (include / file).read_text()
        assert source.count(old) == 1, f"the mutation does not fit {file} any more"
        (include / file).write_text(source.replace(old, new))
    fuzz = tmp_path / "fuzz"
    command = [COMPILER, "-std=c++20", "-O1", "-ffp-contract=off", "-w", f"-I{include.parent}"]
    made = subprocess.run(
        [*command, ROOT / "tests/ofg/native/fuzz_solid.cpp", "-o", fuzz],
        capture_output=True,
        text=True,
    )
    assert made.returncode == 0, made.stderr
    queries = str(QUERIES if MUTANTS[name] else 500)
    done = subprocess.run([fuzz, queries, "300", "5"], capture_output=True, text=True)
    if MUTANTS[name]:
        assert done.returncode == 1, done.stdout
    else:
        assert done.returncode == 0 and "no fault" in done.stdout, done.stdout
