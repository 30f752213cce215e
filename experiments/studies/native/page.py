# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The page of the native study."""

from __future__ import annotations

import pandas as pd

from . import preparation, targets
from .classes import CLASSES, CONTROL, LIBRARIES, V3, library
from .measuring import CELL
from .ratios import CACHE, MPR, SCREENED, VERIFIED
from .summary import OURS, steps

REPAIRED = "ofg k=8 repairs=all"
ALIKE = [*CELL, "mode"]
ORDER = {
    "mode": ("cold", "warm", "batch", "coherent"),
    "situation": ("gap", "apart", "near", "contact", "shallow", "deep", "clear", "hit"),
}


def page(
    rows: pd.DataFrame,
    facts: list[str],
    ratios: pd.DataFrame,
    growths: pd.DataFrame,
    parts: bool = True,
) -> str:
    """Markdown. rows: as `summary` gives them. facts: what was built and measured.

    ratios, growths: as ratios.py gives them. parts: with tables of every contestant and of OFG's
    steps.
    """
    rows = ordered(rows)
    lines = ["# Native study", "", *facts, builds(rows), "", *_targets(ratios, growths), *LEGEND]
    for name in CLASSES:
        if (rows["class"] == name).any():
            shown = overview(class_of(rows, name), ratios[ratios["class"] == name])
            lines += ["", f"## {title(name)}", "", markdown(shown)]
    lines += _preparation(rows, ratios)
    if parts:
        lines += [*details(rows), *_steps(rows)]
    return "\n".join(lines) + "\n"


LEGEND = [
    (
        "Nanoseconds per query, net of the cost of an empty call and the clock: the median over"
        " rounds (three rounds for a method that takes half a second per round), then over blocks"
        " of queries. Each cell shows the fastest configuration of a library, whether or not its"
        " answers are right; brackets give its wrong answers among the certified cases. Ratio:"
        f" {OURS} over the fastest library ({SCREENED} in batch cells), paired by block, with its"
        " 95 % bootstrap interval. Engine / verified: how many times the time of"
        f" {VERIFIED} the fastest engine takes that answers all cases of the cell and none wrongly;"
        f" mpr / verified: likewise {MPR}, the same method without opposing faces. {CONTROL}: the"
        " fastest engine without an error behind the bounding and inscribed spheres of"
        f" {VERIFIED}, a control."
    ),
    "",
    (
        "cold: each pair once, with its own bodies. warm: many poses of one pair, one call each."
        " batch: the same poses in one call; no engine offers this, so * marks the time of its"
        " single calls. coherent: small steps along a trajectory, with each engine's cache as well;"
        f" {VERIFIED} and {MPR} keep what they proved."
    ),
]


def class_of(rows: pd.DataFrame, name: str) -> pd.DataFrame:
    """The rows of a class; of AVX-512 with the engines in their builds for x86-64-v3."""
    own = rows[rows["class"] == name]
    theirs = rows[(rows["class"] == V3) & (rows.engine.map(library) != "OFG")]
    return pd.concat([own, theirs]) if name == "AVX-512" else own


def ordered(rows: pd.DataFrame) -> pd.DataFrame:
    """By mode, situation, question and shape; sizes stay in the order in which they were asked."""
    places = {column: {word: i for i, word in enumerate(words)} for column, words in ORDER.items()}
    keys = rows.assign(
        **{
            column: rows[column].map(place).astype(float).fillna(99)
            for column, place in places.items()
        }
    )
    at = keys.sort_values([*ORDER, "question", "bodies"], kind="stable").index
    return rows.loc[at]


def builds(rows: pd.DataFrame) -> str:
    """How each library was built."""
    each = rows.groupby(["build", "isa"], sort=False, observed=True).size().index
    engines = [f"{build} ({isa})" for build, isa in each if isa not in CLASSES.values()]
    own = {build for build, isa in each if isa in CLASSES.values()}
    return f"Builds: OFG by {', '.join(sorted(own))}; {'; '.join(engines)}."


def title(name: str) -> str:
    """The title of a class of builds."""
    theirs = "generic" if name == "generic" else f"{V3}"
    return f"OFG with {CLASSES[name]}, engines in {theirs} builds (or their only build)"


def overview(rows: pd.DataFrame, ratios: pd.DataFrame) -> pd.DataFrame:
    """A row per cell and mode: OFG verified and as written, screened and repaired; each library.

    ratios: of the same class.
    """
    made = []
    for key, cell in with_single_calls(rows).groupby(ALIKE, sort=False, observed=True):
        row = dict(zip(ALIKE, key))
        kept = CACHE if row["mode"] == "coherent" else ""
        for name in (VERIFIED, MPR):
            row[name] = shown(cell[cell.engine == name + kept], named=False)
        sure = cell.misses + cell.false_alarms == 0
        row[CONTROL] = shown(cell[sure & (cell.engine.map(library) == CONTROL)])
        for name in (OURS, SCREENED, REPAIRED):
            row[name] = shown(cell[cell.engine == name], named=False)
        for name in LIBRARIES.values():
            row[name] = shown(cell[cell.engine.map(library) == name])
        own = cell[cell.engine == (SCREENED if row["mode"] == "batch" else OURS)]
        row["ratio"] = next((quotient(r) for _, r in own.iterrows()), "-")
        here = ratios[(ratios[ALIKE].astype(str) == [*map(str, key)]).all(axis=1)]
        for against in ("engine", "mpr"):
            some = here[here.against == against]
            row[f"{against} / verified"] = next((quotient(r) for _, r in some.iterrows()), "-")
        made.append(row)
    return pd.DataFrame(made)


def with_single_calls(rows: pd.DataFrame) -> pd.DataFrame:
    """The rows, and in batch cells those of the engines' single calls as well, marked."""
    cells = rows[rows["mode"] == "batch"][CELL].drop_duplicates()
    single = rows[(rows["mode"] == "warm") & (rows.engine.map(library) != "OFG")]
    single = single.merge(cells, on=CELL).assign(mode="batch", single=True)
    return ordered(pd.concat([rows.assign(single=False), single], ignore_index=True))


def _targets(ratios: pd.DataFrame, growths: pd.DataFrame) -> list[str]:
    """What verified OFG was to reach, where any cell of it was measured."""
    made = targets.table(ratios, growths)
    if (made.reached == "-").all():
        return []
    text = (
        f"Of {VERIFIED}, set before it was measured. Reached: the cells with a ratio as asked, of"
        " those measured. By the interval: the cells whose whole 95 % interval is as asked. In"
        " batches it is compared with single calls of the engines."
    )
    return ["## Targets", "", text, "", markdown(made), ""]


def _preparation(rows: pd.DataFrame, ratios: pd.DataFrame) -> list[str]:
    made = preparation.table(rows, ratios)
    if made.empty:
        return []
    return ["", "## Preparing bodies", "", preparation.LEGEND, "", markdown(made)]


def shown(cell: pd.DataFrame, named: bool = True) -> str:
    """The row of least time: ns, its name, its wrong answers."""
    for row in cell.sort_values("ns").head(1).itertuples():
        wrong, known = row.misses + row.false_alarms, row.hits + row.clears
        name = f" {row.engine}" if named else ""
        star = "*" if row.single else ""
        return f"{row.ns:,.0f}{star}{name}" + (f" [{wrong:.0f}/{known:.0f}]" if wrong else "")
    return "-"


def quotient(row: pd.Series) -> str:
    """The ratio of a row, with its interval."""
    return "-" if pd.isna(row.ratio) else f"{row.ratio:.2f} ({row.low:.2f}-{row.high:.2f})"


def details(rows: pd.DataFrame) -> list[str]:
    """For each mode and situation, every method in the V3 builds by size of hull."""
    lines = [
        "",
        f"## All methods: OFG with {CLASSES[V3]}, engines in {V3} builds",
        "",
        (
            f"Each cell: ns; the ratio to {OURS} (for OFG, to the fastest engine); wrong answers."
            " rows.parquet also has the other shapes, builds and OFG in single precision."
        ),
    ]
    left = "to step|precision=float"
    rows = rows[(rows["class"] == V3) & ~rows.engine.astype(str).str.contains(left)]
    rows = rows[~rows.bodies.isin(["ico", "cube"])]
    for (mode, situation), part in rows.groupby(["mode", "situation"], sort=False, observed=True):
        order = part.groupby("engine", observed=True).ns.median().sort_values().index
        part = part.assign(
            place=part.bodies.astype(str)
            + " "
            + part.faces.astype(str)
            + " "
            + part.question.astype(str),
            shown=part.apply(_detail, axis=1),
        )
        grid = part.pivot(index="engine", columns="place", values="shown").loc[order]
        grid = grid[list(dict.fromkeys(part.place))].fillna("-").reset_index()
        lines += ["", f"### {mode}, {situation}", "", markdown(grid)]
    return lines


def _detail(row: pd.Series) -> str:
    wrong, known = row.misses + row.false_alarms, row.hits + row.clears
    return f"{row.ns:,.0f}; {quotient(row)}" + (f"; {wrong:.0f}/{known:.0f}" if wrong else "")


def _steps(rows: pd.DataFrame) -> list[str]:
    if not rows.engine.astype(str).str.contains("to step").any():
        return []
    return [
        "",
        f"## Steps of OFG, {CLASSES[V3]}, ns",
        "",
        "Many poses of one pair. The time of a step is the difference to the run that stops"
        " before it.",
        "",
        markdown(steps(rows, V3)),
    ]


def markdown(table: pd.DataFrame) -> str:
    """A Markdown table without padding."""
    head = "| " + " | ".join(map(str, table.columns)) + " |"
    lines = [head, "|" + "---|" * len(table.columns)]
    cells = (
        [f"{v:,.0f}" if isinstance(v, float) else str(v) for v in row]
        for row in table.itertuples(index=False)
    )
    return "\n".join([*lines, *("| " + " | ".join(row) + " |" for row in cells)])
