# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""`python -m experiments.truth.audit.crosscheck`: compare the labels with two judges that share
nothing with the prover or the checker.

CGAL's exact kernel (Debian: apt-get install libcgal-dev) tests instants in rationals: every
overlap; for translations also the exact time and just before it; for rotating sweeps, rational
rotations within 1e-60 of instants outside the bracket. An engine (FCL) samples every sweep densely
in doubles. Disagreements are printed with their case; DISAGREEMENTS.md explains the known ones.
"""

from __future__ import annotations

import argparse
import shutil
import subprocess
import tempfile
from collections import Counter
from pathlib import Path

import flint
import numpy as np
from flint import arb, fmpq

from experiments.cases import families
from experiments.truth import label_many
from experiments.truth.check.balls import add, mul, rational, rotation, vector

SAMPLES = 400


def compile_judge(folder: Path) -> Path | None:
    """Build the CGAL program in `folder`; None with a printed reason if the compiler or the
    library is missing.
    """
    compiler = shutil.which("g++") or shutil.which("c++")
    if not compiler:
        print("CGAL: SKIPPED, no C++ compiler was found")
        return None
    program = folder / "crosscheck"
    built = subprocess.run(
        [
            compiler,
            "-std=c++17",
            "-O2",
            "-w",
            "-DNDEBUG",
            str(Path(__file__).with_suffix(".cpp")),
            "-o",
            program,
            "-lmpfr",
            "-lgmp",
        ],
        capture_output=True,
        text=True,
    )
    if built.returncode:
        reason = next(
            (line for line in built.stderr.splitlines() if "error" in line), "compiler error"
        )
        print(
            f"CGAL: SKIPPED, the judge does not compile ({reason.strip()}). On Debian: apt-get"
            " install libcgal-dev"
        )
        return None
    return program


def rational_turn(motion, t):
    """Rational rotation matrix within about 1e-60 of Rot(k/|k|, theta t), exactly orthogonal:
    from a rational quaternion.
    """
    with flint.ctx.workprec(300):
        k = [arb(c) for c in vector(motion.axis)]
        length = sum((c * c for c in k), arb(0)).sqrt()
        s, c = (arb(rational(motion.angle) * t) / 2).sin_cos()
        q = [c] + [s * x / length for x in k]
        scale = 2**220
        return rotation(*[fmpq(int((x * scale).mid().floor().unique_fmpz() or 0)) for x in q])


def instant(query, t) -> str:
    """One case for the judge: both bodies at time t (a rational)."""
    sides = (query.a, query.pose_a, query.motion), (query.b, query.pose_b, query.motion_b)
    return (
        f"case {' '.join(_solid(body, _placed(pose, motion, t)) for body, pose, motion in sides)}\n"
    )


def _placed(pose, motion, t):
    """The position of a vertex at time t, in rationals."""
    R, turns = rotation(*map(rational, pose.quaternion)), bool(motion.angle and t)
    turn, about = rational_turn(motion, t) if turns else None, vector(motion.about)
    shift = add(vector(pose.position), vector(motion.displacement), t)

    def place(v):
        if not turns:
            return add(mul(R, vector(v)), shift)
        return add(add(mul(turn, mul(R, add(vector(v), about, -1))), mul(R, about)), shift)

    return place


def _solid(body, place) -> str:
    def points(vertices):
        return f"{len(vertices)} " + " ".join(str(c) for v in vertices for c in place(v))

    if body.kind == "mesh":
        return f"M {points(body.vertices)} {len(body.faces)} " + " ".join(
            map(str, body.faces.ravel().tolist())
        )
    return f"C {len(body.pieces)} " + " ".join(points(p.vertices) for p in body.pieces)


def claims(query, truth, dense=0):
    """(time, meets?, what) that follow from a label and that closed sets can decide; at `dense`
    more instants of a sweep.
    """
    if truth.touching:
        return []  # the judge's sets are closed: they intersect if these touch
    early, late = fmpq(10**9 - 1, 10**9), fmpq(10**9 + 1, 10**9)
    if query.question == "overlap":
        return [(fmpq(0), truth.label == "hit", "overlap")]
    found = [
        (fmpq(int(t == "1")), name == "hit", f"at t = {t}")
        for t, name in (("0", truth.start), ("1", truth.end))
        if name != "uncertain"
    ]
    if truth.label == "clear":
        return found + [
            (fmpq(i, dense + 7), False, f"clear at {i}/{dense + 7}") for i in range(1, dense + 7)
        ]
    if truth.start == "clear":
        lo, hi = rational(truth.t_lo), rational(truth.t_hi)
        found += [(lo * fmpq(1, 2), False, "half way"), (lo * early, False, "before the bracket")]
        found += [
            (lo * fmpq(i, dense + 1), False, "before the bracket") for i in range(1, dense + 1)
        ]
        if not (query.motion.angle or query.motion_b.angle):
            found += [(hi, True, "end of the bracket"), (lo, False, "start of the bracket")]
            if exact := truth.certificate.get("exact"):
                p, _, q = exact["time"].partition("/")
                time = fmpq(int(p), int(q or 1))
                found += [
                    (time, True, "exact time (touching)"),
                    (time * (1 - fmpq(1, 2**90)), False, "2^-90 before the exact time"),
                ]
        elif hi * late <= 1 and truth.gap < -1e-6 * min(query.a.size, query.b.size):
            found += [(hi * late, True, "after the bracket")]
    return found


def against_cgal(program, labelled, budget: int, dense: int = 0) -> list[str]:
    """Disagreements with the exact kernel; `budget` bounds the work by triangles of an instant;
    dense: see `claims`.
    """
    asked, text = [], []
    skipped = 0
    for name, query, truth in labelled:
        if truth.label == "uncertain":
            continue
        if len(query.a.faces) + len(query.b.faces) > budget:
            skipped += 1
            continue
        for t, meets, what in claims(query, truth, dense):
            asked.append((name, meets, what))
            text.append(instant(query, t))
    answers = subprocess.run(
        [program], input="".join(text), capture_output=True, text=True
    ).stdout.split()
    kinds = Counter(what.split(" at ")[0].split(" = ")[0] for _, _, what in asked)
    print(
        f"CGAL: {len(answers)} of {len(asked)} instants answered ({dict(kinds)}); {skipped} labels"
        f" skipped: over {budget} faces"
    )
    wrong = [
        f"CGAL {name}: {what}: certified {'meet' if meets else 'apart'}, CGAL reports "
        f"{'meet' if a == '1' else 'apart'}"
        for (name, meets, what), a in zip(asked, answers)
        if meets != (a == "1")
    ]
    if len(answers) < len(asked):
        wrong.append(f"CGAL stopped at {asked[len(answers)]}")
    return wrong


def against_engine(labelled) -> list[str]:
    """Disagreements with FCL's hull-hull overlap test at SAMPLES instants of every sweep of two
    convex bodies. Gaps below 1e-5 of the size are not tested, because FCL's own tolerance
    dominates there.
    """
    import fcl

    wrong, sampled, silent = [], 0, 0
    for name, query, truth in labelled:
        if (
            truth.label == "uncertain"
            or query.question == "overlap"
            or {query.a.kind, query.b.kind} != {"convex"}
        ):
            continue
        size = min(query.a.size, query.b.size)
        a, b = (
            fcl.CollisionObject(
                fcl.Convex(
                    x.vertices,
                    len(x.faces),
                    np.hstack([np.full((len(x.faces), 1), 3), x.faces]).ravel(),
                )
            )
            for x in (query.a, query.b)
        )
        met = []
        for t in np.linspace(0, 1, SAMPLES):
            for body, start, motion in (
                (a, query.pose_a, query.motion),
                (b, query.pose_b, query.motion_b),
            ):
                pose = motion.pose_at(start, t)
                body.setTransform(fcl.Transform(pose.rotation, pose.position))
            met.append(fcl.collide(a, b, fcl.CollisionRequest(), fcl.CollisionResult()) > 0)
        times = np.linspace(0, 1, SAMPLES)[met]
        sampled += 1
        if truth.label == "clear" and len(times) and truth.gap > 1e-5 * size:
            wrong.append(
                f"FCL {name}: meets at t = {times[0]:.6g}, certified clear by"
                f" {truth.gap / size:.2g} of the size"
            )
        if (
            truth.label == "hit"
            and truth.start == "clear"
            and (times < truth.t_lo * (1 - 1e-4) - 1e-5).any()
        ):
            wrong.append(
                f"FCL {name}: meets at t = {times[0]:.6g}, certified clear up to {truth.t_lo:.6g}"
            )
        if truth.label == "hit" and not len(times):
            silent += 1  # too short for the sampling, or shallow
            if truth.end == "hit" and -truth.gap > 1e-3 * size:
                wrong.append(
                    f"FCL {name}: never meets, certified to end {-truth.gap / size:.2g} deep"
                )
    print(
        f"FCL: {sampled} sweeps at {SAMPLES} instants each; {silent} certified hits were too short"
        " or shallow for the samples"
    )
    return wrong


def against_itself(labelled) -> list[str]:
    """Labels that change when A and B are exchanged."""
    wrong = []
    for (name, query, truth), other in zip(
        labelled, label_many(q.swapped() for _, q, _ in labelled)
    ):
        said = [(t.label, t.start, t.touching) for t in (truth, other)]
        timed = truth.label == other.label == "hit" and query.question != "overlap"
        apart = timed and not (truth.t_lo <= other.t_hi and other.t_lo <= truth.t_hi)
        if said[0] != said[1] or apart:
            wrong.append(
                f"swapped {name}: {said[0]} at {truth.t_lo:.17g} became {said[1]} at"
                f" {other.t_lo:.17g}"
            )
    print(f"swapped: {len(labelled)} labels repeated with A and B exchanged, {len(wrong)} changed")
    return wrong


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--cases", type=int, default=4, help="cases per level of every scenario")
    parser.add_argument("--seed", type=int, default=77)
    parser.add_argument(
        "--faces",
        type=int,
        default=1500,
        help="largest number of faces of both bodies for which CGAL is used",
    )
    parser.add_argument(
        "--dense",
        type=int,
        default=0,
        help="additional instants of every sweep for which CGAL is used",
    )
    parser.add_argument("--scenarios", nargs="+", help="these families only")
    args = parser.parse_args()
    labelled = []
    for scenario in map(families.get, args.scenarios or families.scenarios()):
        cases = [
            scenario.case(args.seed, level, i)
            for level in scenario.levels
            for i in range(args.cases)
        ]
        labelled += [(c.id, c.query, t) for c, t in zip(cases, label_many(c.query for c in cases))]
    print(f"{len(labelled)} labels: {dict(Counter(t.label for _, _, t in labelled))}")
    with tempfile.TemporaryDirectory() as folder:
        program = compile_judge(Path(folder))
        wrong = against_cgal(program, labelled, args.faces, args.dense) if program else []
    wrong += against_engine(labelled) + against_itself(labelled)
    print("\n".join(wrong) or "no disagreement")
    raise SystemExit(len(wrong) > 0)


if __name__ == "__main__":
    main()
