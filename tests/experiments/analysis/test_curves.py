# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The figure of a table shows what the table says, every curve is named, and no two names touch."""

from itertools import combinations

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st

from experiments.analysis import metrics
from experiments.analysis.plots import curves
from experiments.analysis.tables import Table
from experiments.run.config import TableChoice

METHODS = (
    "ofg k=8",
    "ofg k=64",
    "brute-force",
    "fcl-convex",
    "fcl-mesh",
    "fcl-convex-exact",
    "bullet",
    "mujoco",
)
LEVELS = ("12", "80", "320", "1280")


def table(value="misses", count=lambda m, i: 5 * i, methods=METHODS) -> Table:
    rows = []
    for m, method in enumerate(methods):
        for i, level in enumerate(LEVELS):
            low, high = metrics.wilson(count(m, i), 20)
            numbers = (
                {"misses": count(m, i), "hits": 20, "miss_low": low, "miss_high": high}
                if value == "misses"
                else {
                    "median": 1000.0 * (m + 1) * 10**i,
                    "low": 900.0,
                    "high": 1e7,
                    "ratio": 2.0**i,
                }
            )
            rows.append({"method": method, "level": level, **numbers})
    text = pd.DataFrame({"method": methods, **dict.fromkeys(LEVELS, "")})
    choice = TableChoice(name="t", title="T.", value=value, scenarios=("face_count",))
    return Table("t", "T.", "", pd.DataFrame(rows), text, choice=choice)


def test_points_are_those_of_the_table():
    found = curves.series(table()).set_index(["method", "x"])
    assert found.y["bullet", 2] == 50 and found.low["bullet", 2] == pytest.approx(
        100 * metrics.wilson(10, 20)[0]
    )
    assert curves.series(table("net time")).set_index(["method", "x"]).y[
        "ofg k=64", 1
    ] == pytest.approx(20.0)  # us


def test_nothing_asked_is_no_point():
    empty = table()
    empty.numbers.loc[empty.numbers.level == "80", "hits"] = 0
    assert set(curves.series(empty).x) == {0, 2, 3}


def test_few_levels_and_other_columns_are_not_drawn():
    assert curves.drawable(table())
    short = table()
    assert not curves.drawable(
        Table("t", "T.", "", short.numbers, short.text.iloc[:, :3], choice=short.choice)
    )
    assert not curves.drawable(Table("t", "T.", "", short.numbers, short.text))


def test_an_engine_of_many_methods_goes_on_in_a_further_panel():
    many = [f"ofg k={k}" for k in range(1, 15)] + ["bullet"]
    groups = curves.panels(many)
    assert [engine for engine, _ in groups] == ["ofg", "ofg", "ofg", "pybullet"]
    assert [m for _, methods in groups for m in methods] == many and max(
        len(m) for _, m in groups
    ) <= curves.PER_PANEL


@pytest.mark.parametrize("value", ["misses", "net time", "ratio"])
def test_every_curve_is_named_once_and_names_do_not_touch(value):
    figure = curves.draw(table(value, lambda m, i: 0), "faces")
    figure.canvas.draw()
    named = []
    for axis in figure.axes:
        boxes = [t.get_window_extent() for t in axis.texts]
        assert not any(p.overlaps(q) for p, q in combinations(boxes, 2))
        named += [t.get_text() for t in axis.texts]
    plt.close(figure)
    assert sorted(named) == sorted(METHODS)


@given(st.lists(st.floats(-1, 2, allow_nan=False), min_size=1, max_size=9))
def test_names_are_moved_apart_in_their_order(heights):
    placed = curves.apart(heights, 0.1)
    order = np.argsort(heights, kind="stable")
    assert (
        (np.diff(np.array(placed)[order]) >= 0.1 - 1e-9).all()
        and 0 <= min(placed)
        and max(placed) <= 1 + 1e-9
    )


def test_the_pieces_own_error_is_drawn_as_no_engine():
    assert curves.panels(["bullet-coacd", "CoACD pieces"]) == [
        ("pybullet", ["bullet-coacd"]),
        ("no engine", ["CoACD pieces"]),
    ]
