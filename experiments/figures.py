"""The accuracy-versus-speed figure: wrong answers against net time, a curve per method, the Pareto front marked."""

from __future__ import annotations

from functools import partial

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from baselines import registry

from . import metrics
from .store import Store
from .timing import SIZES, size_of

# Okabe and Ito's palette and three of Paul Tol's, one for each engine there is, told apart by every common colour vision; markers repeat the distinction in grey print.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#999933", "#882255", "#DDCC77")
MARKERS = "osD^vP*Xh<>p"
GRAIN = 50.0  # ns: net times below what the clock can tell are drawn there
LEAST = 20  # certified cases without which a panel says nothing


def accuracy_speed(store: Store) -> None:
    """One figure per question, a panel per range of faces, as SVG and PNG in figures/."""
    points = joined(store)
    for question, part in points.groupby("question", sort=False):
        figure = draw(part, question)
        for suffix in ("svg", "png"):
            metadata = {"Date": None} if suffix == "svg" else None
            store.write_file(partial(figure.savefig, dpi=160, bbox_inches="tight", format=suffix, metadata=metadata),
                             "figures", f"accuracy-speed-{question}.{suffix}")
        plt.close(figure)


def joined(store: Store) -> pd.DataFrame:
    """A row per question, range of faces and method: net time (us), wrong rate with its interval, whether on the Pareto front."""
    found = metrics.outcomes(store)
    found = found.assign(faces=size_of(found.faces))
    rates = metrics.rates(found, ["question", "faces", "method"])
    rates["wrong"], rates["judged"] = rates.misses + rates.false_alarms, rates.hits + rates.clears
    points = metrics.costs(store, ("question", "faces")).drop(columns=["low", "high"]).merge(rates[rates.judged > 0], on=["question", "faces", "method"])
    points["rate"] = points.wrong / points.judged
    intervals = [metrics.wilson(w, n) for w, n in zip(points.wrong, points.judged)]
    points["low"], points["high"] = zip(*intervals) if intervals else ((), ())
    points["us"] = np.maximum(points.net, GRAIN) / 1e3
    points = points[points.groupby(["question", "faces"]).judged.transform("max") >= LEAST].assign(front=False)
    for _, group in points[points.answered == points.asked].groupby(["question", "faces"], sort=False):
        points.loc[pareto(group.us, group.rate), "front"] = True
    return points


def pareto(cost: pd.Series, loss: pd.Series) -> list:
    """Index labels of the points that no other beats in both."""
    order = pd.DataFrame({"cost": cost, "loss": loss}).sort_values(["cost", "loss"])
    best_before = order.loss.cummin().shift(fill_value=np.inf)
    return list(order.index[order.loss < best_before])


def draw(part: pd.DataFrame, question: str) -> plt.Figure:
    panels = [name for _, name in SIZES if name in set(part.faces)]
    figure, axes = plt.subplots(1, len(panels), figsize=(3.3 * len(panels) + 1.2, 3.9), sharey=True, squeeze=False, layout="constrained")
    styles = _styles(part.method)
    for axis, faces in zip(axes[0], panels):
        _panel(axis, part[part.faces == faces], styles)
        axis.set_title(f"{faces} faces", fontsize=9)
        axis.set_xlabel("net time per query, µs", fontsize=8)
    axes[0, 0].set_ylabel("wrong answers, % of certified cases", fontsize=8)
    handles = [plt.Line2D([], [], color=c, marker=m, ms=5, lw=1, label=name) for name, (c, m) in styles.items()]
    handles.append(plt.Line2D([], [], color="0.4", lw=4, alpha=0.35, label="Pareto front (of those that answer all)"))
    handles.append(plt.Line2D([], [], color="0.4", marker="o", mfc="white", ls="", ms=5, label="hollow: answers only part of the cases"))
    figure.legend(handles=handles, loc="outside right upper", fontsize=7, frameon=False)
    figure.suptitle(f"Accuracy against speed: {question}", fontsize=10)
    return figure


def _panel(axis, part: pd.DataFrame, styles) -> None:
    front = part[part.front].sort_values("us")
    axis.plot(front.us, 100 * front.rate, color="0.4", lw=4, alpha=0.35, drawstyle="steps-post", zorder=1)
    for name, group in part.groupby(part.method.map(curve), sort=False):
        colour, marker = styles[name]
        axis.plot(group.us, 100 * group.rate, color=colour, lw=1, zorder=2)
        axis.errorbar(group.us, 100 * group.rate, yerr=100 * np.abs([group.rate - group.low, group.high - group.rate]), fmt="none", ecolor=colour, elinewidth=0.5, alpha=0.6, zorder=2)
        whole = group.answered == group.asked
        axis.plot(group.us[whole], 100 * group.rate[whole], color=colour, marker=marker, ms=5, ls="", zorder=3)
        axis.plot(group.us[~whole], 100 * group.rate[~whole], color=colour, marker=marker, ms=5, ls="", mfc="white", zorder=3)
        for row in group.itertuples():
            if len(group) > 1 and row.Index in (group.index[0], group.index[-1]):
                place = {"xytext": (3, 3)} if row.rate else {"xytext": (0, 6), "rotation": 90, "ha": "center", "va": "bottom"}  # many share the line of 0
                axis.annotate(row.method.split()[1], (row.us, 100 * row.rate), textcoords="offset points", fontsize=6, color=colour, **place)
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


def curve(label: str) -> str:
    """What the points of one curve have in common: the label without the parameter that the curve runs over."""
    name, *words = label.split()
    return " ".join([name, *words[1:]])


def _styles(methods) -> dict[str, tuple[str, str]]:
    """A colour per engine, a marker per curve of that engine."""
    known = registry.methods()
    styles, seen = {}, {}
    for name in dict.fromkeys(map(curve, methods)):
        engine = known[name.split()[0]].engine if name.split()[0] in known else name
        colour, count = seen.get(engine, (COLOURS[len(seen) % len(COLOURS)], 0))
        more = count // len(MARKERS)  # an engine with more curves than markers goes on in colours that other engines leave
        styles[name] = (COLOURS[-more] if more else colour, MARKERS[count % len(MARKERS)])
        seen[engine] = (colour, count + 1)
    return styles
