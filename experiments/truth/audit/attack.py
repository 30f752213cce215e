# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""`python -m experiments.truth.audit.attack`: test the checker with thousands of corrupted
certificates.

Each mutation either makes a claim false (and must be refused), or weakens the evidence of a claim
that stays true (and may be accepted if the remaining evidence still proves it: "redundant"). False
claims are false by construction: a plane extended past the impact, a witness where the bodies are
apart, a flipped label. An acceptance of weakened evidence counts as redundant only if the same
mutated certificate also verifies by ball arithmetic alone, without the filter in doubles (not
tested for bodies with more than 400 faces together, because it is slow).
"""

from __future__ import annotations

import argparse
import copy
from collections import Counter, defaultdict
from dataclasses import replace
from fractions import Fraction

import numpy as np

from experiments.cases import families
from experiments.truth import check_many, label_many
from experiments.truth.check.obligations import FRAMES

FALSE, WEAKER = "must be refused", "refused unless redundant"


def mutations(rng, query, truth):
    """(name, kind, mutated truth) of every mutation that applies to this label."""
    c = truth.certificate
    if truth.label == "uncertain":
        return
    flipped = {"hit": "clear", "clear": "hit"}[truth.label]
    nan = float("nan")
    times = (
        {"t_lo": nan, "t_hi": nan}
        if flipped == "clear" or query.question == "overlap"
        else {"t_lo": 0.0, "t_hi": 0.0}
    )
    yield (
        "label flipped",
        FALSE,
        replace(truth, label=flipped, start=flipped, end=flipped, gap=0.0, **times),
    )
    yield "certificate dropped", FALSE, replace(truth, certificate={})
    if not truth.touching:
        yield "touching without a witness", FALSE, replace(truth, touching=True)
    if "touching" in c:
        yield "witness without its tag", FALSE, replace(truth, touching=False)
        for side in "ab":
            moved = copy.deepcopy(c["touching"])
            moved[side]["weights"][0] = str(
                Fraction(moved[side]["weights"][0]) + Fraction(1, 10**30)
            )
            yield (
                "touching weights off by 1e-30",
                FALSE,
                replace(truth, certificate={**c, "touching": moved}),
            )
    if truth.gap > 0:
        # the prover claims a tenth of the distance or more
        yield (
            "gap times 20",
            FALSE,
            replace(truth, gap=truth.gap * 20),
        )
    if truth.label == "hit" and query.question != "overlap" and truth.start == "clear":
        later = truth.t_hi + (1 - truth.t_hi) * 10 ** rng.uniform(-9, -1)
        stretched = _edit(c, "clear", lambda tree: _last(tree, later))
        if truth.t_hi < later < 1:
            yield (
                "separation stretched past the impact",
                FALSE,
                replace(truth, t_lo=later, t_hi=later, certificate=stretched),
            )
            yield (
                "bracket moved late",
                FALSE,
                replace(truth, t_lo=later, t_hi=max(later, truth.t_hi)),
            )
        yield "witness before the impact", FALSE, replace(truth, t_hi=truth.t_lo)
        earlier = truth.t_lo * (1 - 10 ** rng.uniform(-9, -1))
        yield "bracket moved early", FALSE, replace(truth, t_lo=earlier, t_hi=earlier)
        yield "start forged", FALSE, replace(truth, start="hit", t_lo=0.0, t_hi=0.0)
        if truth.end != "uncertain":
            yield (
                "end flipped",
                FALSE,
                replace(truth, end={"hit": "clear", "clear": "hit"}[truth.end]),
            )
        if "exact" in c:
            exact = copy.deepcopy(c["exact"])
            exact["time"] = str(
                Fraction(exact["time"]) + Fraction(int(rng.choice([-1, 1])), 10**40)
            )
            yield (
                "exact time off by 1e-40",
                FALSE,
                replace(truth, certificate={**c, "exact": exact}),
            )
            exact = copy.deepcopy(c["exact"])
            exact["a"]["weights"][0] = str(Fraction(exact["a"]["weights"][0]) + Fraction(1, 10**30))
            yield (
                "exact weights off by 1e-30",
                FALSE,
                replace(truth, certificate={**c, "exact": exact}),
            )
    for key in ("hit", "end_hit"):
        if key not in c:
            continue
        away = float(query.a.size + query.b.size) * rng.choice([-1, 1], 3)
        point = [
            str(Fraction(str(x) if isinstance(x, str) else x) + Fraction(float(d)))
            for x, d in zip(c[key]["point"], away)
        ]
        yield (
            "witness moved away",
            FALSE,
            replace(truth, certificate={**c, key: {**c[key], "point": point}}),
        )
        size = min(query.a.size, query.b.size) * 10 ** rng.uniform(-6, 0)
        point = [
            str(Fraction(str(x) if isinstance(x, str) else x) + Fraction(float(d)))
            for x, d in zip(point, rng.normal(size=3) * size - away)
        ]
        yield (
            "witness moved a little",
            WEAKER,
            replace(truth, certificate={**c, key: {**c[key], "point": point}}),
        )
        side = rng.choice(["a", "b"])
        if c[key][side] is not None:
            where = list(c[key][side])
            where[1 + rng.integers(4)] = where[1 + rng.integers(4)]
            if len(set(where[1:])) < 4:
                yield (
                    "tetrahedron flattened",
                    FALSE,
                    replace(truth, certificate={**c, key: {**c[key], side: where}}),
                )
            body = query.a if side == "a" else query.b
            where = [
                where[0],
                *rng.choice(len(body.pieces[where[0]].vertices), 4, replace=False).tolist(),
            ]
            yield (
                "tetrahedron exchanged",
                WEAKER,
                replace(truth, certificate={**c, key: {**c[key], side: where}}),
            )
    for key in ("clear", "end_clear"):
        if key not in c:
            continue
        nodes = _nodes(c[key]["tree"])
        yield (
            "plane reversed",
            FALSE,
            replace(truth, certificate=_edit(c, key, lambda tree: _tilt(rng, tree, None))),
        )
        yield (
            "plane tilted",
            WEAKER,
            replace(
                truth,
                certificate=_edit(c, key, lambda tree: _tilt(rng, tree, 10 ** rng.uniform(-4, 0))),
            ),
        )
        if any(len(n[0]) for n in nodes):
            yield (
                "segment dropped",
                WEAKER,
                replace(truth, certificate=_edit(c, key, lambda tree: _drop_segment(rng, tree))),
            )
            yield (
                "frame exchanged",
                WEAKER,
                replace(truth, certificate=_edit(c, key, lambda tree: _reframe(rng, tree))),
            )
        if any(n[1] for n in nodes):
            yield (
                "child dropped",
                FALSE,
                replace(truth, certificate=_edit(c, key, lambda tree: _drop_child(rng, tree))),
            )
            yield (
                "cut moved",
                WEAKER,
                replace(truth, certificate=_edit(c, key, lambda tree: _move_cut(rng, tree))),
            )
        for order in ("order_a", "order_b"):
            if order in c[key]:
                doubled = list(c[key][order])
                doubled[0] = doubled[-1]
                yield (
                    "element left out",
                    FALSE,
                    replace(truth, certificate={**c, key: {**c[key], order: doubled}}),
                )


def _edit(c, key, change):
    tree = copy.deepcopy(c[key]["tree"])
    change(tree)
    return {**c, key: {**c[key], "tree": tree}}


def _nodes(tree):
    return [tree] + ([n for child in tree[1][2] for n in _nodes(child)] if tree[1] else [])


def _some(rng, tree, has):
    found = [n for n in _nodes(tree) if n[has]]
    return found[rng.integers(len(found))]


def _last(tree, t):
    for node in _nodes(tree):
        if node[0] and not node[1]:
            node[0][-1][0] = max(t, node[0][-1][0])


def _tilt(rng, tree, angle):
    segments = _some(rng, tree, 0)[0]
    s = segments[rng.integers(len(segments))]
    n = np.array([float(Fraction(str(x) if isinstance(x, str) else x)) for x in s[2:]])
    s[2:] = (-n if angle is None else n / np.linalg.norm(n) + angle * rng.normal(size=3)).tolist()


def _drop_segment(rng, tree):
    segments = _some(rng, tree, 0)[0]
    del segments[rng.integers(len(segments))]


def _reframe(rng, tree):
    segments = _some(rng, tree, 0)[0]
    s = segments[rng.integers(len(segments))]
    s[1] = rng.choice([frame for frame in FRAMES if frame != s[1]])


def _drop_child(rng, tree):
    split = _some(rng, tree, 1)[1]
    del split[2][rng.integers(len(split[2]))]


def _move_cut(rng, tree):
    split = _some(rng, tree, 1)[1]
    split[1][rng.integers(len(split[1]))] += int(rng.choice([-1, 1]))


def campaign(cases: int, seed: int, names=None):
    """{mutation: Counter(refused, redundant, ACCEPTED)} and the list of wrong acceptances."""
    rng = np.random.default_rng(seed)
    counts, wrong = defaultdict(Counter), []
    for scenario in (families.get(n) for n in names) if names else families.scenarios().values():
        drawn = [scenario.case(seed, level, i) for level in scenario.levels for i in range(cases)]
        attacks = [
            (case, name, kind, mutated)
            for case, truth in zip(drawn, label_many(c.query for c in drawn))
            for name, kind, mutated in mutations(rng, case.query, truth)
        ]
        verdicts = check_many([(case.query, mutated) for case, _, _, mutated in attacks])
        for (case, name, kind, mutated), verdict in zip(attacks, verdicts):
            if not verdict.ok:
                counts[name]["refused"] += 1
            elif kind == WEAKER and (
                len(case.query.a.faces) + len(case.query.b.faces) > 400
                or check_many([(case.query, mutated)], doubles=False)[0].ok
            ):
                counts[name]["redundant"] += 1
            else:
                counts[name]["ACCEPTED"] += 1
                wrong.append(f"{case.id}: {name} was accepted ({kind})")
    return counts, wrong


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--cases", type=int, default=12, help="cases per level of every scenario")
    parser.add_argument("--seed", type=int, default=99)
    args = parser.parse_args()
    counts, wrong = campaign(args.cases, args.seed)
    for name, c in sorted(counts.items()):
        print(
            f"{name:40s} {sum(c.values()):6d}  refused {c['refused']:6d}  redundant"
            f" {c['redundant']:5d}  accepted wrongly {c['ACCEPTED']}"
        )
    print(f"{sum(sum(c.values()) for c in counts.values())} mutations")
    print("\n".join(wrong) or "none was accepted wrongly")
    raise SystemExit(len(wrong) > 0)


if __name__ == "__main__":
    main()
