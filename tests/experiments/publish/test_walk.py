# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""WALK.md tells the truth: its blocks print what it shows, its functions are where it says."""

import re

import pytest

from experiments.publish import walk

PAGE = walk.PAGE.read_text(encoding="utf-8")
FOLDERS = ["cases", "truth", "run", "analysis", "publish", "cli"]


def test_its_output_is_that_of_its_blocks():
    assert walk.fill(PAGE) == PAGE, "run python -m experiments.publish.walk"


def test_its_steps_go_down_the_folders_and_never_back_up():
    assert re.findall(r"^## \d\. (\w+):", PAGE, re.M) == FOLDERS
    for part in PAGE.split("\n## ")[1:]:
        at = FOLDERS.index(re.match(r"\d\. (\w+)", part)[1])
        files = re.findall(r"`(\w+)/[\w/]+\.py`", part)
        assert files and {FOLDERS.index(folder) for folder in files} == {at}


@pytest.mark.parametrize("name, file", re.findall(r"`(?:\w+\.)?(\w+)`\s+in\s+`([\w/]+\.py)`", PAGE))
def test_its_functions_are_where_it_says(name, file):
    assert re.search(rf"^ *def {name}\(", (walk.ROOT / "experiments" / file).read_text(), re.M)
