# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Print tables so that they fit the terminal."""

from __future__ import annotations

import sys

from rich.console import Console
from rich.table import Table as Grid

from experiments.run.folder.given import markup

console = Console(width=None if sys.stdout.isatty() else 160)  # a file has no terminal width


def print_table(table) -> None:
    """Print a table of a run; optional columns are dropped if the terminal is too narrow."""
    text, optional = table.text, list(table.optional)
    while optional and _width(text) > console.width:
        text = text.drop(columns=optional.pop(0))
    for columns in _strips(text):
        part = text[columns]
        print_grid(table.title, part.columns, list(part.itertuples(index=False)), table.caption)


def _strips(text) -> list[list[str]]:
    """Split the columns into strips that each fit the terminal; every strip repeats the first
    column.
    """
    first, *rest = text.columns
    strips = [[first]]
    for column in rest:
        if len(strips[-1]) > 1 and _width(text[[*strips[-1], column]]) > console.width:
            strips.append([first])
        strips[-1].append(column)
    return strips


def print_grid(title: str, columns, rows, caption: str = "") -> None:
    """Print a grid. Columns of numbers are right-aligned; the first column is never wrapped."""
    console.print(f"[bold]{markup(title)}[/]", highlight=False)
    grid = Grid(box=None, pad_edge=False, header_style="bold")
    for i, column in enumerate(columns):
        grid.add_column(
            markup(column).strip(),
            justify=(
                "left"
                if any(str(row[i])[:1].isalpha() and row[i] != "all" for row in rows)
                else "right"
            ),
            no_wrap=i == 0,
            overflow="fold",
        )
    for row in rows:
        grid.add_row(*map(markup, row))
    console.print(grid)
    console.print(markup(caption), style="dim", highlight=False)
    console.print()


def _width(text) -> int:
    return sum(max(len(str(v)) for v in (*text[c], c)) + 2 for c in text.columns)
