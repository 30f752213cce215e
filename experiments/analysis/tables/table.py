# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""One table: its numbers, its text, and the files in which it is stored."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd
from tabulate import tabulate

from experiments.run.config import TableChoice

MARK = " \u2020"  # a dagger after a name, explained in the caption


@dataclass(frozen=True)
class Table:
    """A table. numbers: the content of the CSV file. text: the cells as printed, usually with the
    same rows. headline: whether to print it at the end of a run. optional: columns of `text` that a
    narrow terminal omits, in the order in which they are dropped.
    """

    name: str
    title: str
    caption: str
    numbers: pd.DataFrame
    text: pd.DataFrame
    headline: bool = False
    optional: tuple[str, ...] = ()
    choice: TableChoice | None = None  #: of a table that the configuration asked for


def marked(names, which: set[str]) -> list[str]:
    """The names, with the mark appended to those in `which`."""
    return [f"{name}{MARK}" if name in which else name for name in names]


def unmarked(name: str) -> str:
    return name.removesuffix(MARK)


def texts(table: Table) -> dict[str, str]:
    """The files of a table: suffix -> content."""
    csv = table.numbers.to_csv(index=False, float_format="%.9g", lineterminator="\n")
    return {"csv": csv, "md": markdown(table), "tex": latex(table)}


def latex(table: Table) -> str:
    """A LaTeX table environment for the booktabs package. The user must rotate or shrink wide
    tables.
    """
    align = ["left"] + ["right"] * (table.text.shape[1] - 1)
    body = tabulate(
        table.text,
        headers=[str(c).strip() for c in table.text.columns],
        showindex=False,
        tablefmt="latex_booktabs",
        colalign=align,
        disable_numparse=True,
    )
    caption = f"{_tex(table.title)} {_tex(table.caption)}"
    return (
        f"\\begin{{table}}\n\\caption{{{caption}}}\n\\label{{tab:{table.name}}}\n"
        f"\\centering\n{body}\n\\end{{table}}\n"
    )


def _tex(text: str) -> str:
    """Text with LaTeX's special characters escaped, as tabulate does for cells."""
    special = {
        "\\": r"\textbackslash{}",
        "~": r"\textasciitilde{}",
        "^": r"\textasciicircum{}",
        "<": r"\ensuremath{<}",
        ">": r"\ensuremath{>}",
        **{c: "\\" + c for c in "&%$#_{}"},
    }
    return "".join(special.get(c, c) for c in text)


def markdown(table: Table) -> str:
    align = ["left"] + ["right"] * (table.text.shape[1] - 1)
    grid = table.text.to_markdown(index=False, colalign=align, disable_numparse=True)
    return f"**{table.title}** {table.caption}\n\n{grid}\n"


def of(count: int, total: int) -> str:
    """'3/40', or '-' if the total is 0."""
    return f"{count}/{total}" if total else "-"


def fraction(counts: pd.DataFrame, count: str, total: str) -> list[str]:
    return [of(c, t) for c, t in zip(counts[count], counts[total])]


def interval(counts: pd.DataFrame, name: str) -> list[str]:
    """Wilson interval in percent: '0.8-7.1'."""
    return [
        "-" if np.isnan(low) else f"{100 * low:.1f}-{100 * high:.1f}"
        for low, high in zip(counts[f"{name}_low"], counts[f"{name}_high"])
    ]


def share(count: int, total: int) -> str:
    return "all" if count == total else f"{count}/{total}"


def pivot(counts: pd.DataFrame, column: str, cell, order=None) -> pd.DataFrame:
    """A row per method and a column per value of `column`, with cell(row) as entry and '-' if there
    is none. Methods without any entry are omitted.
    """
    counts = counts.assign(cell=[cell(r) for r in counts.itertuples()])
    wide = counts.pivot(index="method", columns=column, values="cell")
    order = [c for c in order or counts[column].unique() if c in wide.columns]
    wide = wide.reindex(index=counts.method.unique(), columns=order).fillna("-")
    return wide[(wide != "-").any(axis=1)].rename_axis(columns=None).reset_index()
