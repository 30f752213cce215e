# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""GLOSSARY.md defines every column head that a run prints, and each link to it leads somewhere."""

import json
import re
from pathlib import Path

import pandas as pd
import pytest

from experiments.analysis import views
from experiments.analysis.tables import labels
from experiments.cases import families
from experiments.run.bins import SIZES
from ofg import QUESTIONS

ROOT = Path(__file__).parents[3]
PAGE = (ROOT / "experiments" / "GLOSSARY.md").read_text()
HEADINGS = re.findall(r"^### (.+)$", PAGE, re.M)
TERMS = {h.lower() for h in HEADINGS} | set(re.findall(r"columns? `([^`]+)`", PAGE))
RUNS = sorted(
    p.parent for p in (ROOT / "results").glob("*/config.json") if (p.parent / "tables").is_dir()
)


def anchor(heading: str) -> str:
    """The anchor that Markdown pages give a heading: no punctuation, hyphens for blanks."""
    return re.sub(r"[^\w -]", "", heading.lower()).strip().replace(" ", "-")


def names() -> set[str]:
    """Heads that are values, not terms: scenarios, sizes and bands."""
    gaps = pd.Series([0.0])
    bands = {*views.gap_bands(gaps)[1], *views.closeness(gaps)[1]}
    return {*families.scenarios(), *(name for _, name in SIZES), *bands}


def is_number(head: str) -> bool:
    try:
        float(head)
    except ValueError:
        return False
    return True


def heads(run: Path) -> set[str]:
    """The column heads of the tables that every run has, those of its own choice left out: beside
    "method" these are values of a tag or an axis.
    """
    config = json.loads((run / "config.json").read_text())
    chosen = tuple(table["name"] for table in config.get("tables", []))
    found = set()
    for path in (run / "tables").glob("*.md"):
        if not (chosen and path.stem.startswith(chosen)):
            row = next(line for line in path.read_text().splitlines() if line.startswith("|"))
            found |= set(split(row))
    return found


def split(row: str) -> list[str]:
    """The cells of a row; the head "median |error|" holds bars of its own."""
    return re.findall(r"(?<=\| )\s*((?:median \|error\|)|[^|]+?)\s*(?=\|)", row)


def term(head: str) -> str:
    """The head without the question that the leaderboard puts before it."""
    first, _, rest = head.partition(" ")
    return rest if first in QUESTIONS and rest else head


@pytest.mark.parametrize("run", RUNS, ids=lambda run: run.name)
def test_every_column_head_is_defined(run):
    found = {term(head) for head in heads(run)} - names()
    assert found, f"{run} has no tables"
    assert {head for head in found if not is_number(head)} - TERMS == set()


def test_the_heads_of_touching_cases_are_defined():
    # No committed run has such cases, so the table is made here.
    found = pd.DataFrame(
        {
            "method": ["ofg k=8"],
            "outcome": ["touching"],
            "status": ["ok"],
            "label": ["clear"],
            "hit": [True],
            "touching": [True],
            "wrong": [False],
            "within": [False],
            "can_tunnel": [False],
            "tunnelled": [False],
        }
    )
    table = labels.touching_table(found, "overlap")
    assert len(table.text) == 1 and set(table.text.columns) <= TERMS


def test_headings_give_anchors_of_their_own():
    anchors = [anchor(heading) for heading in HEADINGS]
    assert len(set(anchors)) == len(anchors) and all(anchors)


def test_links_to_it_lead_to_a_heading():
    known = {anchor(heading) for heading in re.findall(r"^#+ (.+)$", PAGE, re.M)}
    for page in (path for path in ROOT.glob("**/*.md") if ".venv" not in path.parts):
        named = re.findall(r"GLOSSARY\.md#([\w-]+)", page.read_text())
        assert set(named) <= known, page
