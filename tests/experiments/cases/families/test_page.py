# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The page and the pictures are those of the scenarios as they are."""

import pytest
from PIL import Image

from experiments.cases.families import scenarios
from experiments.publish.gallery import draw, page

OWN = [name for name in scenarios() if (page.FOLDER / f"{name}.py").is_file()]


def test_page_is_up_to_date():
    assert page.text() == (page.FOLDER / "README.md").read_text(encoding="utf-8"), (
        "experiments/cases/families/README.md is out of date: run python -m"
        " experiments.publish.gallery.page"
    )


def test_every_row_of_a_table_is_one_line():
    # A docstring of two lines broke its row in two, and with it the table.
    rows = [line for line in page.text().splitlines() if line.startswith("| [")]
    assert len(rows) == len(OWN) and all(row.endswith(" |") for row in rows)


@pytest.mark.parametrize("name", OWN)
def test_every_family_has_a_view_and_a_small_picture(name):
    assert name in draw.VIEWS, "say in draw.py which case shows this family best"
    path = page.FOLDER / "figures" / f"{name}.png"
    assert path.is_file(), (
        "run python -m experiments.publish.gallery.draw experiments/cases/families/figures"
    )
    assert path.stat().st_size < 60_000
    assert Image.open(path).text["case"] == draw.caption(draw.pictured(name)), (
        "the picture is out of date: run python -m experiments.publish.gallery.draw"
        " experiments/cases/families/figures"
    )


def test_picture_shows_both_bodies(tmp_path):
    draw.draw("deep", tmp_path / "deep.png")
    colours = Image.open(tmp_path / "deep.png").convert("RGB").getcolors(1 << 16)
    ink = sum(n for n, _ in colours)
    blue = sum(n for n, (r, g, b) in colours if b > r + 40)
    orange = sum(n for n, (r, g, b) in colours if r > b + 40)
    assert blue > 0.05 * ink and orange > 0.05 * ink
