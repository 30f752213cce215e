"""The memory that FCL's turns read before anything has written it: set, it rules out all that ran before."""

import os
import subprocess
import sys

import pytest

from baselines import fcl, registry
from experiments.scenarios import get

LINEAR = [f"{name} heap={heap}" for name in ("fcl-advancement-convex", "fcl-advancement-mesh", "fcl-naive-convex")
          for heap in fcl.HEAP]
FAMILIES = ("rotational_contact", "screw_wall", "spin_side")
TURNS = [get(name).case(2004, get(name).levels[-1], index).query for name in FAMILIES for index in range(6)]

pytestmark = pytest.mark.skipif(not fcl._repeatable(), reason="malloc hands out other blocks here")


def answer(spec, query):
    return registry.make(spec)[0].ready(query)()


def test_fcl_answers_the_same_beside_any_other_method():
    """Its turns read memory that nothing wrote: unset, an answer hung on the methods asked before."""
    others = ["fcl-convex-substeps n=4", "bullet-substeps n=4", "parry-substeps n=4"]
    others = [spec for spec in others if not registry.available(registry.methods()[spec.split()[0]])]
    orders = [*LINEAR, *others], [*others, *reversed(LINEAR)]
    first, again = ({(spec, i): repr(answer(spec, query))
                     for spec in order for i, query in enumerate(TURNS)} for order in orders)
    assert first == again
    assert all(registry.methods()[spec.split()[0]].repeatable for spec in LINEAR)
    assert any(first[LINEAR[0], i] != first[LINEAR[1], i] for i in range(len(TURNS)))


@pytest.mark.parametrize("heap", fcl.HEAP)
def test_fcl_answers_as_in_a_process_whose_whole_heap_is_set(heap):
    """Of all that FCL reads unset, only the motions rule its answers; glibc writes perturb ^ 0xFF."""
    program = f"""
import sys
from baselines import fcl
if sys.argv[1] == "whole":
    fcl._repeatable, fcl._fill_motions = (lambda: True), (lambda fill: None)
sys.path.insert(0, {os.path.dirname(__file__)!r})
from test_fcl_heap import TURNS, answer
print([answer(f"{{name}} heap={heap}", query) for query in TURNS
       for name in ("fcl-advancement-convex", "fcl-advancement-mesh", "fcl-naive-convex")])
"""
    tunables = f"glibc.malloc.tcache_count=0:glibc.malloc.perturb={fcl.HEAP[heap] ^ 0xFF}"
    said = [subprocess.run([sys.executable, "-c", program, which], capture_output=True, text=True, check=True,
                           env={**os.environ, **set_}).stdout
            for which, set_ in (("blocks", {}), ("whole", {"GLIBC_TUNABLES": tunables}))]
    assert said[0] == said[1] and "True" in said[0]
