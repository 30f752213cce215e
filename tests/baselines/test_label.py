# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""A label leads to its method and back, and is read in one place."""

import re
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from baselines import registry
from baselines.label import curve_of, name_of, parse

ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize("name", registry.methods())
def test_the_label_of_a_method_has_its_name(name):
    label = registry.methods()[name]().label
    assert name_of(label) == parse(label)[0] == name
    assert set(parse(label)[1]) <= set(registry.methods()[name].parameters)


@given(st.text())
def test_any_text_is_a_label_or_refused(text):
    try:
        name, chosen = parse(text)
    except ValueError as error:
        assert "parameter=value" in str(error)
    else:
        assert name == name_of(text) and all(chosen.values())


def test_a_curve_runs_over_the_first_parameter():
    assert curve_of("ofg k=8 repairs=all") == "ofg repairs=all"
    assert curve_of("fcl-convex") == "fcl-convex"


def test_no_other_file_takes_a_label_apart():
    """Eight places did, each in its own way."""
    found = [
        str(path.relative_to(ROOT))
        for folder in ("baselines", "experiments")
        for path in (ROOT / folder).rglob("*.py")
        if re.search(r"(label|spec|method\"\])\.split\((\" \")?\)", path.read_text())
    ]
    assert found == ["baselines/label.py"]
