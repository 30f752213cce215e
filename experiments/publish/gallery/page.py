"""Writes README.md of this folder from the scenarios themselves: python -m
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

Made by `python -m experiments.publish.gallery.page` from the scenarios in this folder; the
pictures by `python -m experiments.publish.gallery.draw experiments/cases/families/figures`. A is
blue, B is orange; the later places of a body that moves are pale, a straight arrow is its
displacement and a curved one its turn.

A family is one file. It draws two bodies and a motion at a level of difficulty, and *aims*: at a
gap, a feature, a time. What the right answer is, it does not say: that is certified afterwards,
by `experiments/truth`. Every family here declares `precision="float32"`: each number of a case,
those of its vertices included, is a float32 number, so that engines in single and double
precision are asked the same question.
"""
TAIL = """\
## How a gap of 1e-16 is reached

`placement.seat` rests A on B by one feature of each. Both bodies are moved in their own frames
until the contact is at the frame's origin and their features lie in the plane z = 0 to the bit;
both rotations are integer quaternions with a common part, so that the planes coincide exactly,
which the pose (a rotation N(q)/|q|^2, never normalised) can express. Then A's position *is* the
gap along the normal, a small number with seven digits of its own. Where a long path is wanted as
well, the path goes into A's position and the gap into B's: no sum of a large and a small number
is ever rounded. `tests/experiments/cases/families` checks this in rational arithmetic. A quarter
of the cases keep the world's axes (tag `aligned`), because exactly symmetrical input is where
engines fail.

`python -m experiments.truth.audit.aim` labels some cases of each level and prints how many are
hits, clear and uncertain, and how closely the certified gap comes to the one aimed at.

## A family of your own

Copy `feature_gap.py`, which is complete, change its name, and give the file's path wherever a
scenario's name is asked for. To make it one of these, put it into this folder (the file is called
like the scenario), say in `draw.py` which of its cases to show, and run the two commands at the
top of this page. A scenario draws everything from the `rng` it is given and returns a `Draft`;
`Scenario.case(seed, level, index)` makes the same case for the same arguments whatever was made
before. Bodies come from `experiments/cases/shapes.py` or from `ofg.Body`;
`experiments/cases/placement.py` has the constructions that several families share.
`redraw_if=("start-overlap",)` draws a sweep again whose truth is that it starts in overlap. Its
`precision` is "float64" unless it declares "float32": the case is then what was drawn, number for
number, and the tables mark engines that cannot hold it.
"""


def text() -> str:
    """The page, from the families that are files of this folder."""
    own = [s for s in scenarios().values() if (FOLDER / f"{s.name}.py").is_file()]
    parts = [HEAD]
    for question, asks in QUESTIONS.items():
        rows = [_row(s) for s in own if s.question == question]
        head = (
            "| family | | what it is | what it exposes | difficulty: levels |\n| --- | --- | --- |"
            " --- | --- |"
        )
        parts.append("\n".join([f"## {question}\n", asks + "\n", head, *rows, ""]))
    return "\n".join([*parts, TAIL])


def _row(s: Scenario) -> str:
    what = sys.modules[s.generate.__module__].__doc__.strip()
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
