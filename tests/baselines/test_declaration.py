# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""A method of somebody's own that declares too little is refused in a sentence, before anything is
made.
"""

import pytest

from baselines import declaration, registry
from baselines.contract import Method

FINE = {
    "name": "mine",
    "engine": "ofg",
    "imports": "ofg",
    "configuration": "default",
    "guarantee": "none",
    "questions": {"overlap"},
    "bodies": ["convex"],
    "solid": True,
    "prepare": lambda self, query: None,
}


def declared(**changes):
    said = {k: v for k, v in {**FINE, **changes}.items() if v is not ...}
    return type("Mine", (Method,), said)


def test_what_is_declared_in_full_has_no_fault():
    assert declaration.fault(declared()) == ""


def test_every_method_of_the_package_is_declared_in_full():
    assert {
        name: declaration.fault(cls)
        for name, cls in registry.methods().items()
        if cls.__module__.startswith("baselines.") and declaration.fault(cls)
    } == {}


@pytest.mark.parametrize(
    "changes, words",
    [
        ({"solid": ...}, "lacks solid"),
        ({"solid": ..., "bodies": ...}, "lacks bodies, solid"),
        ({"solid": 1}, "solid is 1"),
        ({"name": "two words"}, "no spaces"),
        ({"name": ""}, "must be text"),
        ({"engine": None}, "must be text"),
        ({"questions": {"overlaps"}}, "set of motion, overlap, translation"),
        ({"bodies": "convex"}, "must be a set"),
        ({"bodies": set()}, "must be a set"),
        ({"guarantee": "a\nb"}, "on one line"),
        ({"parameters": ["k"]}, "must be a dict"),
    ],
)
def test_each_fault_is_named(changes, words):
    assert words in declaration.fault(declared(**changes))


def test_what_is_no_method_is_named():
    assert "not the class of a method" in declaration.fault(
        int
    ) and "not the class of a method" in declaration.fault("mine")


def test_a_file_with_such_a_method_is_refused_by_name(tmp_path):
    """It ended the run with a traceback (AttributeError) after its folder had been made."""
    (tmp_path / "mine.py").write_text(
        "from baselines.contract import Method\nclass Mine(Method):\n    name = 'mine'\nMETHODS ="
        " [Mine]\n"
    )
    with pytest.raises(
        ValueError, match="methods of mine: Mine lacks engine, imports, configuration, guarantee"
    ):
        registry.load_file(tmp_path / "mine.py")
