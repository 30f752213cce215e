"""The page of the native study."""

from __future__ import annotations

import pandas as pd

from .classes import CLASSES, LIBRARIES, library
from .measuring import CELL
from .summary import OURS, steps

REPAIRED = "ofg k=8 repairs=all"
SCREENED = "ofg k=8 screen=True"
ALIKE = [*CELL, "mode"]


def page(rows: pd.DataFrame, times: pd.DataFrame, facts: list[str], parts: bool = True) -> str:
    """Markdown. rows, times: as `summary` and `measure` give them. facts: what was built and asked.

    parts: with a table of every contestant too.
    """
    lines = ["# Native study", "", *facts, "", *_legend()]
    for name in CLASSES:
        if (rows["class"] == name).any():
            lines += ["", f"## {title(name)}", "", markdown(overview(rows[rows["class"] == name]))]
    if parts:
        lines += details(rows)
        lines += ["", "## Steps of OFG, AVX2, ns", "", *_legend_of_steps(),
                  markdown(steps(times, CLASSES["x86-64-v3"]).round(0))]
    return "\n".join(lines) + "\n"


def _legend() -> list[str]:
    return [
        "Nanoseconds per query: medians over rounds, then over blocks, less what the call and the"
        " clock cost. Of each library the configuration that took least stands in the cell,"
        " whatever it answers; behind it, in brackets, its wrong answers of the certified cases, if"
        " there are any. Batch: OFG answers all poses in one call, the engines have no such call"
        " and stand with their single calls, marked *."
    ]


def _legend_of_steps() -> list[str]:
    return ["Many poses of one pair: differences of runs that stop after a step.", ""]


def title(name: str) -> str:
    """What stands in a class."""
    builds = {"generic": "engines in generic builds", "x86-64-v3": "engines in x86-64-v3 builds",
              "AVX-512": "engines in x86-64-v3 builds"}
    return f"OFG with {CLASSES[name]}, {builds[name]}"


def overview(rows: pd.DataFrame) -> pd.DataFrame:
    """A row per cell and mode; OFG as written, with its screen and repaired; each library."""
    made = []
    for key, cell in with_single_calls(rows).groupby(ALIKE, sort=False):
        row = dict(zip(ALIKE, key))
        for name in (OURS, SCREENED, REPAIRED):
            row[name] = _shown(cell[cell.engine == name], named=False)
        for name in LIBRARIES.values():
            row[name] = _shown(cell[cell.engine.map(library) == name])
        made.append(row)
    return pd.DataFrame(made)


def with_single_calls(rows: pd.DataFrame) -> pd.DataFrame:
    """The rows, and in batch cells those of the engines' single calls as well, marked."""
    cells = rows[rows["mode"] == "batch"][CELL].drop_duplicates()
    single = rows[(rows["mode"] == "warm") & (rows.engine.map(library) != "OFG")]
    return pd.concat([rows, single.merge(cells, on=CELL).assign(mode="batch", single=True)])


def fastest(cell: pd.DataFrame) -> pd.DataFrame:
    """The row of least time; none of none."""
    return cell.sort_values("ns").head(1)


def _shown(cell: pd.DataFrame, named: bool = True) -> str:
    for row in fastest(cell).itertuples():
        wrong, known = row.misses + row.false_alarms, row.hits + row.clears
        star = "*" if getattr(row, "single", False) is True else ""
        return (f"{row.ns:,.0f}{star}" + (f" {row.engine}" if named else "")
                + (f" [{wrong:.0f}/{known:.0f}]" if wrong else ""))
    return "-"


def details(rows: pd.DataFrame) -> list[str]:
    """A table for each class, mode and situation: every contestant against sizes."""
    lines = ["", "## Every contestant", "",
             f"ns; in brackets the quotient with {OURS} of the same class, call by call, block by"
             " block, with its 95 % bootstrap interval; then wrong answers of certified cases."]
    rows = rows[~rows.engine.str.contains("to step")]
    for (name, mode, situation), part in rows.groupby(["class", "mode", "situation"], sort=False):
        if name == "AVX-512":
            part = part[part.isa == CLASSES[name]]
        order = part.groupby("engine").ns.median().sort_values().index
        part = part.assign(place=part.bodies + " " + part.faces, shown=part.apply(_detail, axis=1))
        grid = part.pivot(index="engine", columns="place", values="shown").loc[order]
        grid = grid[list(dict.fromkeys(part.place))].fillna("-").reset_index()
        lines += ["", f"### {title(name)}: {mode}, {situation}", "", markdown(grid)]
    return lines


def _detail(row: pd.Series) -> str:
    wrong, known = row.misses + row.false_alarms, row.hits + row.clears
    over = "" if pd.isna(row.ratio) else f" ({row.ratio:.2f}, {row.low:.2f}-{row.high:.2f})"
    return f"{row.ns:,.0f}{over}" + (f" {wrong:.0f}/{known:.0f}" if wrong else "")


def markdown(table: pd.DataFrame) -> str:
    """A Markdown table, thin: no padding."""
    head = "| " + " | ".join(map(str, table.columns)) + " |"
    lines = [head, "|" + "---|" * len(table.columns)]
    cells = ([f"{v:,.0f}" if isinstance(v, float) else str(v) for v in row]
             for row in table.itertuples(index=False))
    return "\n".join([*lines, *("| " + " | ".join(row) + " |" for row in cells)])
