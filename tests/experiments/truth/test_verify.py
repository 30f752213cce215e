# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Verification by the checker alone, and what the checker may import."""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import replace

import numpy as np

from experiments.run.folder.rows import _certificate
from experiments.truth import Truth, label, label_many, verify
from ofg import Body, Pose, Query

from .draw import composite_query, convex_query


def test_certificates_survive_json_and_verify():
    rng = np.random.default_rng(9)
    queries = [
        draw(rng, question)
        for question in ("overlap", "translation", "motion")
        for draw in (convex_query, composite_query)
        for _ in range(6)
    ]
    truths = label_many(queries)
    stored = [replace(t, certificate=json.loads(json.dumps(t.certificate))) for t in truths]
    result = verify(zip(queries, stored))
    assert result.ok and sum(result.verified.values()) == len(queries)


def test_a_forged_label_is_found_and_named():
    rng = np.random.default_rng(10)
    queries = [convex_query(rng, "overlap") for _ in range(20)]
    truths = label_many(queries)
    truths[7] = replace(truths[7], label="clear" if truths[7].label == "hit" else "hit")
    result = verify(zip(queries, truths))
    assert [i for i, _, _ in result.refused] == [7] and "label 7" in str(result)


def test_uncertain_labels_are_counted_by_reason():
    rng = np.random.default_rng(11)
    result = verify([(convex_query(rng, "overlap"), Truth("uncertain", reason="touching"))] * 3)
    assert result.ok and result.uncertain == {"touching": 3}


def test_the_checker_imports_no_prover_and_no_engine():
    """In a process of its own that stubs the package, so that only the checker's own imports
    load.
    """
    code = """
import importlib, sys, types, pathlib
import experiments
folder = pathlib.Path(experiments.__file__).parent / "truth"
package = types.ModuleType("experiments.truth"); package.__path__ = [str(folder)]
sys.modules["experiments.truth"] = package
importlib.import_module("experiments.truth.check.checker")
ours = sorted(m.split(".")[-1] for m in sys.modules if m.startswith("experiments.truth."))
files = ["balls", "check", "checker", "float_filter", "geometry", "obligations", "proof"]
assert ours == files, ours
engines = {"fcl", "pybullet", "mujoco", "scipy", "trimesh", "ofg._core", "ofg"} & set(sys.modules)
assert not engines, engines
"""
    subprocess.run([sys.executable, "-c", code], check=True, capture_output=True)


def test_a_witness_counts_pieces_from_0_and_what_is_no_certificate_is_refused():
    cube = Body.convex([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)])
    query = Query("overlap", cube, cube, Pose(), Pose(position=(1, 0, 0)))
    truth = label(query)
    back = json.loads(json.dumps(truth.certificate))
    back["touching"]["a"]["piece"] = -1
    forged = [replace(truth, certificate=c) for c in (truth.certificate, back, "{", "", 5, None)]
    result = verify((query, t) for t in forged)
    assert [i for i, _, _ in result.refused] == [1, 2, 3, 4, 5]
    assert [_certificate(text) for text in ("{", '{"a": 1}')] == ["{", {"a": 1}]
