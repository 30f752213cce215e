# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The conformance suite itself: methods with one fault each must fail the property that is about
it.
"""

from pathlib import Path

import pytest

from baselines import conformance, registry

FAULTY = Path(__file__).with_name("faulty.py")


@pytest.mark.parametrize(
    "name, title, word",
    [
        ("faulty-never", "far apart is clear, deep overlap is a hit", "answered clear"),
        ("faulty-never", "contained bodies are detected by solid methods only", "not detected"),
        ("faulty-fickle", "gives the same answer again", "then"),
        ("faulty-careless", "refuses what it does not declare", "does not raise Unsupported"),
        ("faulty-mute", "refuses what it does not declare", "without a reason"),
        ("faulty-late", "hits a head-on sweep at its time", "more than 0.01"),
        ("faulty-one-eyed", "detects a body that moves towards it", "missed"),
        ("faulty-spinning", "detects what B hits as it rotates", "B by 1.0472: answered clear"),
        ("faulty-spinning", "rotates about the given point", "A rotates about (-10, 0, 0)"),
        ("faulty-aborting", "far apart is clear, deep overlap is a hit", "SIGABRT"),
    ],
)
def test_fault_is_found(name, title, word):
    cls = registry.load_file(FAULTY)[name]
    found = {t: (ok, detail) for t, ok, detail in conformance.check(cls())}
    ok, detail = found[title]
    assert not ok and word in detail
    # a process that died did not cost the other properties
    assert len(found) == len(conformance.PROPERTIES)


def test_a_method_that_never_heard_of_b_moving_is_right_about_it():
    found = {
        t: (ok, detail)
        for t, ok, detail in conformance.check(registry.load_file(FAULTY)["faulty-unaware"]())
    }
    assert found["detects a body that moves towards it"] == (True, "")


def test_nothing_else_is_found():
    failed = [
        title
        for title, ok, _ in conformance.check(registry.load_file(FAULTY)["faulty-aligned"]())
        if not ok
    ]
    assert failed == ["does not depend on the frame"]
