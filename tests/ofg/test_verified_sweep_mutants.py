# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""What proves the sweeps of verified OFG, left out piece by piece: the fuzzer must notice."""

import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
COMPILER = shutil.which("g++") or shutil.which("c++")
QUERIES = 100_000  # most mutants end within a thousand

PLANE, MARCH, MOTION = "verified_plane.hpp", "verified_march.hpp", "verified_motion.hpp"
RAY = "verified_translation.hpp"
MUTANTS = {
    "none": None,
    "the bound of a fixed plane halved": (
        PLANE,
        "return up * (turned(a,",
        "return 0.5 * (turned(a,",
    ),
    "the bound of a turning plane halved": (
        PLANE,
        "return up * (part(own.axis)",
        "return 0.5 * (part(own.axis)",
    ),
    "the bound of an edge plane halved": (
        PLANE,
        "return up * (w * w * far",
        "return 0.5 * (w * w * far",
    ),
    "the chord's quadratic with the wrong sign": (
        PLANE,
        "bend = 0.5 * bound * h * h",
        "bend = -0.5 * bound * h * h",
    ),
    "the edge plane's bound without the translation": (
        PLANE,
        "w * w * far + 2 * w * length(m.d)",
        "w * w * far",
    ),
    "the turning plane's bound without the drift": (PLANE, "+ 2 * w * drift)", ")"),
    "the other body's turn left out": (PLANE, " + v * v * across * other.swing);", ");"),
    "no margin": (MOTION, "slack = (256 + 4 * angle)", "slack = (0 * angle)"),
    "the late Newton": (
        MARCH,
        "impact.set(from, then.t), name(then, plane",
        "impact.set(then.t, then.t), name(then, plane",
    ),
    "no overlap at the end of a bracket": (MARCH, "&& meets(then)) {", ") {"),
    "the start not asked exactly": (
        MARCH,
        "if (from == 0 && (at_start() ||",
        "if (from == 0 && (false ||",
    ),
    "hulls that part where they do not": (MARCH, "if (!(rate > 0)) continue;", ""),
    "a ray without margin": (
        RAY,
        "gap = -s.height - at.slack * length(n)",
        "gap = -s.height",
    ),
    "a ray that starts inside": (RAY, "(start() || over(time, v))", "over(time, v)"),
    "a ray that ends late": (
        RAY,
        "impact.set(from, to);\n    else",
        "impact.set(to, to);\n    else",
    ),
}


@pytest.mark.skipif(COMPILER is None, reason="no C++ compiler is installed")
@pytest.mark.timeout(900)
@pytest.mark.parametrize("name", MUTANTS)
def test_the_fuzzer_notices(name, tmp_path):
    include = tmp_path / "include" / "ofg"
    shutil.copytree(ROOT / "ofg/include/ofg", include)
    if MUTANTS[name]:
        file, old, new = MUTANTS[name]
        source = (include / file).read_text()
        assert source.count(old) == 1, f"the mutation does not fit {file} any more"
        (include / file).write_text(source.replace(old, new))
    fuzz = tmp_path / "fuzz"
    command = [COMPILER, "-std=c++20", "-O1", "-ffp-contract=off", "-w", f"-I{include.parent}"]
    made = subprocess.run(
        [*command, ROOT / "tests/ofg/native/fuzz_sweep.cpp", "-o", fuzz],
        capture_output=True,
        text=True,
    )
    assert made.returncode == 0, made.stderr
    queries = str(QUERIES if MUTANTS[name] else 10_000)
    done = subprocess.run([fuzz, queries, "200", "3"], capture_output=True, text=True)
    if MUTANTS[name]:
        assert done.returncode == 1, done.stdout
    else:
        assert done.returncode == 0 and "no fault" in done.stdout, done.stdout
