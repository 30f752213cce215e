# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""What proves the answers of verified OFG, left out piece by piece: the fuzzer must notice."""

import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
COMPILER = shutil.which("g++") or shutil.which("c++")
QUERIES = 40_000  # most mutants end within a hundred

PORTAL, POSE, MAIN = "verified_portal.hpp", "verified_pose.hpp", "verified.hpp"
SINGLE, HULL, FINE = "simd/opposing_body.hpp", "verified_hull.hpp", "verified_fine.hpp"
EXACT = "verified_exact.hpp"
MUTANTS = {
    "none": None,
    "no full support": (SINGLE, "if (!q.complete) {", "if (false) {"),
    "no margin of a plane": (
        POSE,
        "return s.height < -at.slack * length(n);",
        "return s.height < 0;",
    ),
    "no margin of a plane in single precision": (
        SINGLE,
        "return at < 0 && at * at > q.gap * q.gap * inner(d, d);",
        "return at < 0;",
    ),
    "no margin of a portal": (
        POSE,
        "margin * length(n) + 16 * unit_roundoff * wide * (size + margin)",
        "0 * (margin + wide + size)",
    ),
    "no margin of a portal in single precision": (
        SINGLE,
        "!(sure > doubt)",
        "!(sure + 0 * doubt > 0)",
    ),
    "no margin of a plane in twice the digits": (
        FINE,
        "const double size = 1.001 * at.slack * wide(n);",
        "const double size = 0;",
    ),
    "no margin of a portal in twice the digits": (
        FINE,
        "if (!(std::abs(height) > 1.001 * doubt)",
        "if (!(std::abs(height) > 0 * doubt)",
    ),
    "doubles alone rank near-tied vertices in twice the digits": (
        FINE,
        "- 128 * unit_roundoff * hull.radius * length(axis);",
        ";",
    ),
    "a portal without area": (
        PORTAL,
        "if (!still_meeting(at, proof)) return false;",
        "",
    ),
    "a portal without area in single precision": (
        SINGLE,
        "if (!holds(v0, v, q.gap)) continue;",
        "",
    ),
    "no exact fallback": (
        MAIN,
        "meets_exactly(a, b, pa, pb, ended, proof.axis) ? Verdict::meeting : Verdict::apart",
        "Verdict::apart",
    ),
    "no exact fallback, the other way": (
        MAIN,
        "meets_exactly(a, b, pa, pb, ended, proof.axis) ? Verdict::meeting : Verdict::apart",
        "Verdict::meeting",
    ),
    "doubles alone rank near-tied vertices in the exact step": (
        EXACT,
        "- 128 * unit_roundoff * hull_.radius * length(axis);",
        ";",
    ),
    "any plane keeps apart in the exact step": (
        EXACT,
        "return dot(n, s).sign() <= 0;",
        "return dot(n, s).sign() <= 1;",
    ),
    "an inscribed ball of an open surface": (
        HULL,
        "if (!faces.empty() && closed(faces)) inner",
        "inner",
    ),
    "a cache of other bodies": (
        MAIN,
        "if (cache.a != a.number || cache.b != b.number) return false;",
        "",
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
        [*command, ROOT / "tests/ofg/native/fuzz_verified.cpp", "-o", fuzz],
        capture_output=True,
        text=True,
    )
    assert made.returncode == 0, made.stderr
    queries = str(QUERIES if MUTANTS[name] else 4000)
    done = subprocess.run([fuzz, queries, "200", "5"], capture_output=True, text=True)
    if MUTANTS[name]:
        assert done.returncode == 1, done.stdout
    else:
        assert done.returncode == 0 and "no fault" in done.stdout, done.stdout
