# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""ARTICLE.md names only what there is: functions, options, repairs, figures, tables, scenarios."""

import re
from pathlib import Path

import pytest

from experiments.cases import families
from ofg import REPAIRS
from ofg.options import core_options

OFG = Path(__file__).parents[2] / "ofg"
PAGE = (OFG / "ARTICLE.md").read_text()
HEADERS = "\n".join(p.read_text() for p in (OFG / "include" / "ofg").glob("*.hpp"))
ARTICLE = (OFG / "include" / "ofg" / "article.hpp").read_text()


def test_its_functions_are_there():
    named = set(re.findall(r"`article::(\w+)`", PAGE))
    assert len(named) >= 13
    assert all(re.search(rf"\b{name}\(", ARTICLE) for name in named)
    assert all(re.search(rf"\b{name}\(", HEADERS) for name in re.findall(r"`detail::(\w+)`", PAGE))


def test_every_function_of_the_article_has_its_line():
    """Every function of article.hpp is on the page, so that no step is done in silence."""
    defined = set(re.findall(r"^(?:\w[\w<>:]*) (\w+)\(", ARTICLE, re.M))
    assert defined and defined <= set(re.findall(r"`article::(\w+)`", PAGE))


@pytest.mark.parametrize("option", sorted(set(re.findall(r'`(\w+=(?:"[\w-]+"|[\w.-]+))`', PAGE))))
def test_its_options_are_taken(option):
    name, value = option.split("=")
    core_options(**{name: eval(value, {})})  # words of our own page


def test_its_repairs_are_all_there():
    listed = PAGE.split("## Repairs")[1]
    assert set(REPAIRS) == set(re.findall(r"`([a-z]+(?:-[a-z]+)*)`", listed)) - {"python"}


def test_its_links_figures_and_scenarios_are_there():
    links = re.findall(r"\]\(([^)]+)\)", PAGE)
    assert len(links) > 12 and all((OFG / link).is_file() for link in links)
    named = set(re.findall(r"`(article_\w+)`", PAGE))
    assert named == {name for name in families.scenarios() if name.startswith("article_")}
