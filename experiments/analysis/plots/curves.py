# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Draw a table along an axis: rates or times by level, with a panel per engine and OFG in each for
comparison.
"""

from __future__ import annotations

import matplotlib

from baselines.label import name_of

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import pandas as pd

from baselines import registry
from experiments.analysis.tables import Table
from experiments.analysis.tables.chosen import COUNTS
from experiments.cases import families
from experiments.run import piece_truth
from experiments.run.folder.store import Store

from .figures import COLOURS, GRAIN, MARKERS, drawn

LEAST = 3  # a curve needs at least so many levels
PER_PANEL = 6  # curves per panel; further curves of an engine get another panel
# None: the scenarios name the axis
AXES = {
    "level": None,
    "band": "signed gap over size",
    "faces": "faces of the larger body",
}
VALUES = {
    "net time": ("median", "net time per query, µs", 1e-3),
    "gross time": ("median", "gross time per query, µs", 1e-3),
    "build time": ("median", "build time per query, µs", 1e-3),
    "ratio": ("ratio", "ratio of net time to the reference's", 1.0),
}


def save(store: Store, tables: list[Table]) -> None:
    """Write figures/NAME.svg and .png for every table along an axis."""
    known = families.scenarios()
    for table in filter(drawable, tables):
        names = table.choice.scenarios or [c.name for c in store.config.scenarios]
        figure = draw(
            table,
            AXES[table.choice.columns]
            or " / ".join(dict.fromkeys(known[name].axis for name in names if name in known)),
        )
        for suffix in ("svg", "png"):
            store.write_bytes(drawn(figure, suffix), "figures", f"{table.name}.{suffix}")
        plt.close(figure)


def drawable(table: Table) -> bool:
    choice = table.choice
    return bool(
        choice
        and choice.columns in AXES
        and (choice.value in COUNTS or choice.value in VALUES)
        and table.text.shape[1] > LEAST
    )


def series(table: Table) -> pd.DataFrame:
    """A row per method and level: x (index of the level), y, low, high. Rates are in percent;
    levels whose total is 0 have no row.
    """
    value, numbers = table.choice.value, table.numbers
    place = {name: i for i, name in enumerate(table.text.columns[1:])}
    if value in COUNTS:
        count, total, interval, _ = COUNTS[value]
        found = numbers[numbers[total] > 0]
        y, low, high = (
            100 * found[count] / found[total],
            100 * found[f"{interval}_low"],
            100 * found[f"{interval}_high"],
        )
    else:
        column, _, unit = VALUES[value]
        found, least = numbers, 0.0 if value == "ratio" else GRAIN * unit
        y, low, high = (np.maximum(found[c] * unit, least) for c in (column, "low", "high"))
    return pd.DataFrame(
        {
            "method": found.method,
            "x": found[table.choice.columns].map(place),
            "y": y,
            "low": low,
            "high": high,
        }
    ).sort_values("x", kind="stable")


def panels(methods: list[str]) -> list[tuple[str, list[str]]]:
    """Pairs of an engine and at most PER_PANEL of its methods, in the order of the table."""
    known, own = registry.methods(), {}
    for label in methods:
        name = name_of(label)
        engine = (
            "no engine"
            if label == piece_truth.NAME
            else known[name].engine
            if name in known
            else name
        )
        own.setdefault(engine, []).append(label)
    return [
        (engine, labels[i : i + PER_PANEL])
        for engine, labels in own.items()
        for i in range(0, len(labels), PER_PANEL)
    ]


def draw(table: Table, axis_name: str) -> plt.Figure:
    points, ticks = series(table), list(table.text.columns[1:])
    groups = panels(list(dict.fromkeys(points.method)))
    reference = "ofg k=8" if "ofg k=8" in set(points.method) else None
    columns = min(3, len(groups))
    rows = -(-len(groups) // columns)
    figure, axes = plt.subplots(
        rows,
        columns,
        figsize=(3.6 * columns, 2.5 * rows + 0.5),
        sharex=True,
        sharey=True,
        squeeze=False,
        layout="constrained",
    )
    for axis, (engine, methods) in zip(axes.flat, groups):
        _scale(axis, table.choice.value, points)
        axis.set_title(engine, fontsize=9)
        axis.set_xlim(-0.2, len(ticks) - 0.8)
        axis.set_xticks(
            range(len(ticks)),
            ticks,
            rotation=90 if max(map(len, ticks)) > 4 or len(ticks) > 8 else 0,
        )
        if reference and reference not in methods:
            own = points[points.method == reference]
            axis.plot(own.x, own.y, color="0.6", lw=1, ls=(0, (3, 2)), zorder=1)
        _lines(axis, points, methods)
    for axis in axes.flat[len(groups) :]:
        axis.set_visible(False)
    for i in range(len(groups) - columns, len(groups)):  # the lowest panel of each column
        axes.flat[i].tick_params(labelbottom=True)
    figure.supylabel(
        (
            VALUES[table.choice.value][1]
            if table.choice.value in VALUES
            else f"{table.choice.value}, % of certified cases"
        ),
        fontsize=8,
    )
    figure.supxlabel(axis_name + (f"   (dashed: {reference})" if reference else ""), fontsize=8)
    figure.suptitle(table.title, fontsize=10)
    figure.canvas.draw()  # places the axes, which the labels need
    for axis, (_, methods) in zip(axes.flat, groups):
        _labels(axis, points, methods)
    return figure


def _scale(axis, value: str, points: pd.DataFrame) -> None:
    if value in COUNTS:
        axis.set_ylim(-3, 103)
    elif (points.y > 0).any():
        axis.set_yscale("log")
        axis.set_ylim(points.y[points.y > 0].min() / 1.5, points.y.max() * 1.5)
    axis.tick_params(labelsize=7)
    axis.grid(alpha=0.25, lw=0.5)


def _lines(axis, points: pd.DataFrame, methods: list[str]) -> None:
    for i, method in enumerate(methods):
        own, colour = points[points.method == method], COLOURS[i]
        axis.plot(own.x, own.y, color=colour, marker=MARKERS[i], ms=3.5, lw=1, zorder=3)
        axis.fill_between(own.x, own.low, own.high, color=colour, alpha=0.12, lw=0, zorder=2)


def _labels(axis, points: pd.DataFrame, methods: list[str]) -> None:
    """Write the name of each curve at its right end; names that would overlap are moved apart."""
    ends = [(m, points[points.method == m].iloc[-1]) for m in methods]
    heights = [
        axis.transAxes.inverted().transform(axis.transData.transform((end.x, max(end.y, 1e-300))))[
            1
        ]
        for _, end in ends
    ]
    gap = 8.5 / (axis.bbox.height / axis.figure.dpi * 72)  # 8.5 points of the panel's height
    for i, y in zip(range(len(ends)), apart(heights, gap)):
        axis.annotate(
            ends[i][0],
            (1.02, y),
            xycoords="axes fraction",
            fontsize=6,
            va="center",
            color=COLOURS[i],
            annotation_clip=False,
        )


def apart(heights: list[float], gap: float) -> list[float]:
    """The heights, moved apart so that neighbours differ by at least `gap` and keep their order,
    within [0, 1] if they fit.
    """
    order = np.argsort(heights, kind="stable")
    placed = np.clip(np.asarray(heights, float)[order], 0, 1)
    for i in range(1, len(placed)):
        placed[i] = max(placed[i], placed[i - 1] + gap)
    if len(placed) and placed[-1] > 1:
        placed[-1] = 1.0
        for i in range(len(placed) - 2, -1, -1):
            placed[i] = min(placed[i], placed[i + 1] - gap)
    found = np.empty(len(placed))
    found[order] = placed
    return list(found)
