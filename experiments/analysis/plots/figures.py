# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The accuracy-speed figure: wrong answers versus net time, with a curve per method and the Pareto
front.
"""

from __future__ import annotations

import io

import matplotlib

from baselines.label import curve_of, name_of

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from baselines import registry
from experiments.analysis import costs, metrics, outcome, views
from experiments.run.bins import SITUATIONS, SIZES, size_of
from experiments.run.folder.store import Store

# The palette of Okabe and Ito and three colours of Paul Tol, one per engine, which remain distinct
# under the common colour vision deficiencies; markers repeat the distinction in grey print.
COLOURS = (
    "#0072B2",
    "#D55E00",
    "#009E73",
    "#CC79A7",
    "#E69F00",
    "#56B4E9",
    "#000000",
    "#999933",
    "#882255",
    "#DDCC77",
)
MARKERS = "osD^vP*Xh<>pd8H"
GRAIN = 50.0  # ns: shorter net times are below the clock's resolution and are drawn at this value
LEAST = 20  # a panel needs at least so many certified cases


def accuracy_speed(store: Store) -> None:
    """Write one figure per question, with panels by range of faces and situation, as SVG and PNG to
    figures/.
    """
    points = joined(store)
    for question, part in points.groupby("question", sort=False):
        figure = draw(part, question)
        for suffix in ("svg", "png"):
            store.write_bytes(
                drawn(figure, suffix), "figures", f"accuracy-speed-{question}.{suffix}"
            )
        plt.close(figure)


def drawn(figure: plt.Figure, suffix: str) -> bytes:
    """The content of a figure's file; suffix: "svg" or "png"."""
    content = io.BytesIO()
    figure.savefig(
        content,
        format=suffix,
        dpi=160,
        bbox_inches="tight",
        metadata={"Date": None} if suffix == "svg" else None,
    )
    return content.getvalue()


def joined(store: Store) -> pd.DataFrame:
    """A row per question, range of faces, situation and method: net time (us), rate of wrong
    answers with its interval, and whether the method is on the Pareto front.

    Rates are over the common cases of a question and range of faces (shared). The rate of a method
    that answers less than half of the cases is over the cases that it answered (not shared); such
    a method is not on the front.
    """
    found = outcome.outcomes(store)
    found = found.assign(faces=size_of(found.faces))
    rates = pd.concat(
        [
            _rates(part).assign(question=question, faces=faces)
            for (question, faces), part in found.groupby(["question", "faces"], sort=False)
        ],
        ignore_index=True,
    )
    times = costs.costs(store).drop(columns=["low", "high"])
    points = times.merge(rates[rates.judged > 0], on=["question", "faces", "method"])
    points = points.assign(
        rate=points.wrong_rate,
        low=points.wrong_low,
        high=points.wrong_high,
        us=np.maximum(points.net, GRAIN) / 1e3,
    )
    panels = ["question", "faces", "situation"]
    points = points[points.groupby(panels).judged.transform("max") >= LEAST].assign(front=False)
    for _, group in points[points.shared].groupby(panels, sort=False):
        points.loc[pareto(group.us, group.rate), "front"] = True
    return points


def _rates(part: pd.DataFrame) -> pd.DataFrame:
    part = part[~part.detail.str.startswith("does not answer", na=False)]
    same, left_out = views.common(part)
    return pd.concat(
        [
            metrics.rates(same, ["method"]).assign(shared=True),
            metrics.rates(part[part.method.isin(left_out)], ["method"]).assign(shared=False),
        ],
        ignore_index=True,
    )


def pareto(cost: pd.Series, loss: pd.Series) -> list:
    """Index labels of the points that no other point dominates."""
    order = pd.DataFrame({"cost": cost, "loss": loss}).sort_values(["cost", "loss"])
    best_before = order.loss.cummin().shift(fill_value=np.inf)
    return list(order.index[order.loss < best_before])


def draw(part: pd.DataFrame, question: str) -> plt.Figure:
    """Draw panels: a column per range of faces, a row per situation."""
    sizes = [name for _, name in SIZES if name in set(part.faces)]
    rows = [name for name in SITUATIONS if name in set(part.situation)]
    figure, axes = plt.subplots(
        len(rows),
        len(sizes),
        figsize=(3.0 * len(sizes) + 1.2, 2.7 * len(rows) + 0.6),
        sharex="col",
        sharey=True,
        squeeze=False,
        layout="constrained",
    )
    styles = _styles(part.method)
    for line, situation in zip(axes, rows):
        for axis, faces in zip(line, sizes):
            inside = part[(part.faces == faces) & (part.situation == situation)]
            if len(inside):
                _panel(axis, inside, styles)
            else:
                axis.axis("off")
        line[0].set_ylabel(f"{situation}: wrong answers, %", fontsize=8)
    for axis, faces in zip(axes[0], sizes):
        axis.set_title(f"{faces} faces", fontsize=9)
    for axis in axes[-1]:
        axis.set_xlabel("net time per query, µs", fontsize=8)
    handles = [
        plt.Line2D([], [], color=c, marker=m, ms=5, lw=1, label=name)
        for name, (c, m) in styles.items()
    ]
    handles.append(
        plt.Line2D([], [], color="0.4", lw=4, alpha=0.35, label="Pareto front on common cases")
    )
    handles.append(
        plt.Line2D(
            [],
            [],
            color="0.4",
            marker="o",
            mfc="white",
            ls="",
            ms=5,
            label="hollow: answers less than half\nof the cases; rate over those",
        )
    )
    figure.legend(handles=handles, loc="outside right upper", fontsize=7, frameon=False)
    figure.suptitle(f"Accuracy versus speed: {question}, by situation", fontsize=10)
    return figure


def _panel(axis, part: pd.DataFrame, styles) -> None:
    front = part[part.front].sort_values("us")
    axis.plot(
        front.us, 100 * front.rate, color="0.4", lw=4, alpha=0.35, drawstyle="steps-post", zorder=1
    )
    for name, group in part.groupby(part.method.map(curve_of), sort=False):
        colour, marker = styles[name]
        axis.plot(group.us, 100 * group.rate, color=colour, lw=1, zorder=2)
        axis.errorbar(
            group.us,
            100 * group.rate,
            yerr=100 * np.abs([group.rate - group.low, group.high - group.rate]),
            fmt="none",
            ecolor=colour,
            elinewidth=0.5,
            alpha=0.6,
            zorder=2,
        )
        whole = group.shared
        axis.plot(
            group.us[whole],
            100 * group.rate[whole],
            color=colour,
            marker=marker,
            ms=5,
            ls="",
            zorder=3,
        )
        axis.plot(
            group.us[~whole],
            100 * group.rate[~whole],
            color=colour,
            marker=marker,
            ms=5,
            ls="",
            mfc="white",
            zorder=3,
        )
        for row in group.itertuples():
            if len(group) > 1 and row.Index in (group.index[0], group.index[-1]):
                # many points have rate 0
                place = (
                    {"xytext": (3, 3)}
                    if row.rate
                    else {"xytext": (0, 6), "rotation": 90, "ha": "center", "va": "bottom"}
                )
                axis.annotate(
                    row.method.split()[1],
                    (row.us, 100 * row.rate),
                    textcoords="offset points",
                    fontsize=6,
                    color=colour,
                    **place,
                )
    axis.set_xscale("log")
    axis.margins(x=0.08)
    span = np.log10(part.us.max() / part.us.min())
    axis.xaxis.set_major_locator(LogLocator(subs=(1.0,) if span > 2 else (1.0, 2.0, 5.0)))
    axis.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.xaxis.set_minor_formatter(NullFormatter())
    axis.set_yscale("symlog", linthresh=1, linscale=0.6)
    axis.set_ylim(-0.15, 110)
    axis.set_yticks([0, 1, 3, 10, 30, 100], ["0", "1", "3", "10", "30", "100"])
    axis.tick_params(labelsize=7)
    axis.grid(alpha=0.25, lw=0.5)


def _styles(methods) -> dict[str, tuple[str, str]]:
    """A colour per engine, a marker per curve of that engine."""
    known = registry.methods()
    styles, seen = {}, {}
    for name in dict.fromkeys(map(curve_of, methods)):
        engine = known[name_of(name)].engine if name_of(name) in known else name
        colour, count = seen.get(engine, (COLOURS[len(seen) % len(COLOURS)], 0))
        # if an engine has more curves than markers, further curves use unused colours
        more = count // len(MARKERS)
        styles[name] = (COLOURS[-more] if more else colour, MARKERS[count % len(MARKERS)])
        seen[engine] = (colour, count + 1)
    return styles
