# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""FCL reads memory that nothing has written; set before each call, it leaves no trace of others."""

import os
import subprocess
import sys

import pytest

from baselines import fcl, registry
from experiments.cases.families import get

NAMES = ("fcl-advancement-convex", "fcl-advancement-mesh", "fcl-naive-convex")
LINEAR = [f"{name} heap={heap}" for name in NAMES for heap in fcl.HEAP]
FAMILIES = [get(name) for name in ("rotational_contact", "screw_wall", "spin_side")]
TURNS = [f.case(2004, f.levels[-1], index).query for f in FAMILIES for index in range(6)]

pytestmark = pytest.mark.skipif(
    not fcl.repeatable(pytest.importorskip("fcl")), reason="malloc hands out other blocks here"
)


def answer(spec, query):
    return registry.make(spec)[0].ready(query)()


def test_fcl_answers_the_same_beside_any_other_method():
    """Unset, that memory made an answer hang on the methods that were asked before."""
    others = [
        f"{name}-substeps"
        for name in ("fcl-convex", "bullet", "parry")
        if not registry.available(registry.methods()[name])
    ]
    orders = [*LINEAR, *others], [*others, *reversed(LINEAR)]
    first, again = (
        {(spec, i): repr(answer(spec, query)) for spec in order for i, query in enumerate(TURNS)}
        for order in orders
    )
    assert first == again
    assert all(registry.methods()[spec.split()[0]].repeatable for spec in LINEAR)
    assert any(first[LINEAR[0], i] != first[LINEAR[1], i] for i in range(len(TURNS)))


@pytest.mark.parametrize("heap", fcl.HEAP)
def test_fcl_answers_as_in_a_process_whose_whole_heap_is_set(heap):
    """Of all that FCL reads unset, the motions alone matter. glibc writes perturb ^ 0xFF."""
    program = f"""
import sys
from baselines import fcl
if sys.argv[1] == "whole":
    fcl.repeatable, fcl.fill_motions = (lambda fcl: True), (lambda fill: None)
sys.path.insert(0, {os.path.dirname(__file__)!r})
from test_fcl_heap import NAMES, TURNS, answer
print([answer(f"{{name}} heap={heap}", query) for query in TURNS for name in NAMES])
"""
    tunables = f"glibc.malloc.tcache_count=0:glibc.malloc.perturb={fcl.HEAP[heap] ^ 0xFF}"
    said = [
        subprocess.run(
            [sys.executable, "-c", program, which],
            capture_output=True,
            text=True,
            check=True,
            env={**os.environ, **set_},
        ).stdout
        for which, set_ in (("blocks", {}), ("whole", {"GLIBC_TUNABLES": tunables}))
    ]
    assert said[0] == said[1] and "True" in said[0]
