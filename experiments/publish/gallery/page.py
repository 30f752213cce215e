# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Write the README of the scenario families from the scenarios: python -m
experiments.publish.gallery.page
"""

from __future__ import annotations

import sys
from pathlib import Path

from experiments.cases.families import scenarios
from experiments.cases.scenario import Scenario

FOLDER = Path(__file__).parents[2] / "cases" / "families"
QUESTIONS = {
    "overlap": "Do the two bodies overlap at the given poses?",
    "translation": "Do they meet while they move in straight lines, and when?",
    "motion": "Do they meet while they turn and move, and when?",
}
HEAD = """\
# Scenario families

`python -m experiments.publish.gallery.page` writes this page from the scenarios in this folder, and
`python -m experiments.publish.gallery.draw experiments/cases/families/figures` draws the pictures.
A is blue and B is orange. Later places of a moving body are pale, a straight arrow is its
displacement, and a curved arrow is its turn.

A family is one file. It draws two bodies and a motion at a level of difficulty, and *aims* at a
gap, a feature or a time. It does not state the right answer, which `experiments/truth` certifies
afterwards. Every family here declares `precision="float32"`: each number of a case, including
those of its vertices, is a float32 number, so that engines in single and double precision receive
the same query.
"""
TAIL = """\
## How a gap of 1e-16 is reached

`placement.seat` rests A on B by one feature of each. Both bodies are moved in their own frames
until the contact is at the origin of the frame and their features lie exactly in the plane z = 0.
Both rotations are integer quaternions with a common factor, so that the planes coincide exactly;
the pose can represent this, because its rotation is N(q)/|q|^2 and is never normalised. Then A's
position *is* the gap along the normal, a small number with seven digits of its own. If a long path
is required as well, the path goes into A's position and the gap into B's: no sum of a large and a
small number is ever rounded. `tests/experiments/cases/families` checks this in rational
arithmetic. A quarter of the cases keep the world's axes (tag `aligned`), because engines fail on
exactly symmetrical input.

`python -m experiments.truth.audit.aim` labels some cases of each level. It prints how many are
hit, clear and uncertain, and how closely the certified gap matches the gap aimed at.

## A family of your own

Copy `feature_gap.py`, which is complete, change its name, and pass the path of the file wherever
the name of a scenario is required. To add it to these families, put it into this folder (the file
has the name of the scenario), select in `draw.py` which of its cases to show, and run the two
commands at the top of this page. A scenario draws everything from its argument `rng` and returns a
`Draft`; `Scenario.case(seed, level, index)` returns the same case for the same arguments,
independent of earlier calls. Bodies come from `experiments/cases/shapes.py` or from `ofg.Body`;
`experiments/cases/placement.py` provides the constructions that several families share.
`redraw_if=("start-overlap",)` rejects a draw of a sweep that is certified to start in overlap, and
draws again. The `precision` is "float64" unless the scenario declares "float32"; a float64 case
consists of exactly the numbers that were drawn, and the tables mark engines that cannot represent
it.
"""


def text() -> str:
    """The page, from the families that are files of this folder."""
    own = [s for s in scenarios().values() if (FOLDER / f"{s.name}.py").is_file()]
    parts = [HEAD]
    for question, asks in QUESTIONS.items():
        rows = [_row(s) for s in own if s.question == question]
        head = (
            "| family | | description | exposes | difficulty: levels |\n| --- | --- | --- |"
            " --- | --- |"
        )
        parts.append("\n".join([f"## {question}\n", asks + "\n", head, *rows, ""]))
    return "\n".join([*parts, TAIL])


def _row(s: Scenario) -> str:
    # One line, however the docstring is wrapped: a row of a table ends at a line break.
    what = " ".join(sys.modules[s.generate.__module__].__doc__.split())
    picture = f'<img src="figures/{s.name}.png" width="220" alt="{s.name}">'
    return (
        f"| [{s.name}]({s.name}.py) | {picture} | {what} | {s.exposes} | {s.axis}:"
        f" {_levels(s.levels)} |"
    )


def _levels(levels) -> str:
    """Pairs of both signs in one: "±0.1, ±0.01"."""
    both = {v for v in levels if v and -v in levels}
    return ", ".join(
        f"±{abs(v):g}" if v in both else f"{v:g}" for v in levels if v not in both or v > 0
    )


if __name__ == "__main__":
    (FOLDER / "README.md").write_text(text(), encoding="utf-8")
