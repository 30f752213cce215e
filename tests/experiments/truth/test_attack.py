# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Corrupted certificates: each mutation makes a claim false or unsupported, and the checker must
refuse it.
"""

from __future__ import annotations

import copy
from dataclasses import replace

import numpy as np
import pytest

from experiments.truth import check, check_many, label
from experiments.truth.audit.attack import campaign

from .draw import composite_query, convex_query


def labelled(question, want, count, seed):
    rng = np.random.default_rng(seed)
    while count:
        query = convex_query(rng, question)
        truth = label(query)
        if truth.label == want:
            count -= 1
            yield rng, query, truth


def refused(query, truth, **changes):
    certificate = copy.deepcopy(dict(truth.certificate))
    for key, change in changes.pop("inside", {}).items():
        certificate[key] = change(certificate[key])
    return not check(query, replace(truth, certificate=certificate, **changes)).ok


@pytest.mark.parametrize("question", ("translation", "motion"))
def test_separation_cannot_be_stretched_past_the_impact(question):
    for _, query, truth in labelled(question, "hit", 15, 4):
        if truth.start != "clear":
            continue
        later = truth.t_hi + (1 - truth.t_hi) * 1e-9

        def stretch(clear):
            segments, split = clear["tree"]
            segments[-1][0] = later
            return clear

        assert refused(query, truth, t_lo=later, t_hi=later, inside={"clear": stretch})
        assert refused(query, truth, t_lo=later, t_hi=max(later, truth.t_hi))


@pytest.mark.parametrize("question", ("translation", "motion"))
def test_an_early_witness_is_refused(question):
    for _, query, truth in labelled(question, "hit", 15, 5):
        if truth.start == "clear":
            assert refused(query, truth, t_hi=truth.t_lo)
            assert refused(query, truth, t_lo=truth.t_lo * 0.5, t_hi=truth.t_hi * 0.5)


def test_a_flipped_label_is_refused():
    for question in ("overlap", "translation", "motion"):
        for _, query, truth in labelled(question, "clear", 5, 6):
            assert refused(query, truth, label="hit", start="hit", end="hit", gap=-1.0)
            assert refused(query, truth, gap=truth.gap * 1.5 + 1e-9)
            assert refused(query, replace(truth, certificate={}))
        for _, query, truth in labelled(question, "hit", 5, 7):
            assert refused(
                query,
                truth,
                label="clear",
                start="clear",
                end="clear",
                gap=0.0,
                t_lo=np.nan,
                t_hi=np.nan,
            )
            assert refused(query, replace(truth, certificate={}))


def test_a_witness_moved_out_of_its_tetrahedra_is_refused():
    for _, query, truth in labelled("overlap", "hit", 30, 8):
        far = query.a.size + query.b.size

        def move(hit):
            hit["point"] = [float(x) + far for x in map(_float, hit["point"])]
            return hit

        assert refused(query, truth, inside={"hit": move})
        assert refused(
            query, truth, inside={"hit": lambda hit: {**hit, "a": [0, *hit["a"][1:4], hit["a"][1]]}}
        )


def _float(x):
    p, _, q = str(x).partition("/")
    return float(x) if not isinstance(x, str) else int(p) / int(q or 1)


def test_a_small_campaign_of_all_mutations_is_refused():
    """The full one, thousands of each, is `python -m experiments.truth.audit.attack`."""
    names = [
        "feature_gap",
        "hooked_ls",
        "through_hole",
        "thin_wall",
        "concave_rotation",
        "linked_tori",
    ]
    counts, wrong = campaign(1, 5, names)
    assert not wrong
    assert sum(sum(c.values()) for c in counts.values()) > 400 and len(counts) >= 18


def test_balls_alone_agree_with_the_doubles():
    """On true certificates and on nearly true ones: gaps claimed a hair more or less than what is
    there.
    """
    rng = np.random.default_rng(12)
    asked = []
    for question in ("overlap", "translation", "motion"):
        for _ in range(12):
            query = convex_query(rng, question)
            truth = label(query)
            asked.append((query, truth))
            if truth.gap > 0:
                asked += [
                    (query, replace(truth, gap=truth.gap * (1 + x)))
                    for x in (1e-12, 1e-9, 1e-3, 0.1)
                ]
    assert [c.ok for c in check_many(asked)] == [c.ok for c in check_many(asked, doubles=False)]


def test_junk_anywhere_in_a_certificate_is_refused_without_harm_to_the_rest():
    """Nothing raises, and the honest label in the same batch still verifies. What is accepted (a
    later end of an instant, the null of a mesh) has to be accepted by balls alone too.
    """
    rng = np.random.default_rng(13)
    junk = ["x", "1/0", None, float("nan"), float("inf"), -1, 1e308, [], {}, True, "0x1"]
    honest = convex_query(rng, "overlap")
    good = (honest, label(honest))
    refusals = total = 0
    for question in ("overlap", "translation", "motion"):
        for draw in (convex_query, composite_query):
            for _ in range(6):
                query = draw(rng, question)
                truth = label(query)
                for _ in range(25):
                    certificate = copy.deepcopy(dict(truth.certificate))
                    if _spoil(rng, certificate, junk[rng.integers(len(junk))]) is None:
                        continue
                    verdicts = check_many(
                        [good, (query, replace(truth, certificate=certificate)), good]
                    )
                    assert verdicts[0].ok and verdicts[2].ok
                    total += 1
                    refusals += not verdicts[1].ok
                    if verdicts[1].ok and draw is convex_query:
                        assert check_many(
                            [(query, replace(truth, certificate=certificate))], doubles=False
                        )[0].ok
    assert refusals > 0.6 * total


def _spoil(rng, node, junk):
    """Replace one leaf, chosen by walking down at random; None if there is none."""
    while True:
        keys = list(node) if isinstance(node, dict) else list(range(len(node)))
        if not keys:
            return None
        key = keys[rng.integers(len(keys))]
        if not isinstance(node[key], (dict, list)) or not node[key] or rng.random() < 0.05:
            node[key] = junk
            return key
        node = node[key]
