"""One table: its numbers, its text, and the files that it is written to."""

from __future__ import annotations

from dataclasses import dataclass

import pandas as pd
from tabulate import tabulate

from .config import TableChoice

MARK = " \u2020"  # a dagger behind a name: the caption says what it means


@dataclass(frozen=True)
class Table:
    """numbers: what CSV holds. text: what people read; same rows. headline: printed at the end of a run; the others on demand.
    optional: columns of text that a narrow terminal leaves out, the first to go first."""

    name: str
    title: str
    caption: str
    numbers: pd.DataFrame
    text: pd.DataFrame
    headline: bool = False
    optional: tuple[str, ...] = ()
    choice: TableChoice | None = None  #: of a table that the configuration asked for


def marked(names, which: set[str]) -> list[str]:
    """Names with the mark behind those that are in `which`."""
    return [f"{name}{MARK}" if name in which else name for name in names]


def unmarked(name: str) -> str:
    return name.removesuffix(MARK)


def texts(table: Table) -> dict[str, str]:
    """The files of a table: suffix -> content."""
    csv = table.numbers.to_csv(index=False, float_format="%.9g", lineterminator="\n")
    return {"csv": csv, "md": markdown(table), "tex": latex(table)}


def latex(table: Table) -> str:
    """A table environment for the booktabs package. Wide ones are for the reader to turn or to shrink."""
    align = ["left"] + ["right"] * (table.text.shape[1] - 1)
    body = tabulate(table.text, headers=[str(c).strip() for c in table.text.columns], showindex=False, tablefmt="latex_booktabs", colalign=align, disable_numparse=True)
    return f"\\begin{{table}}\n\\caption{{{_tex(table.title)} {_tex(table.caption)}}}\n\\label{{tab:{table.name}}}\n\\centering\n{body}\n\\end{{table}}\n"


def _tex(text: str) -> str:
    """Text as LaTeX prints it; tabulate does the same for cells."""
    special = {"\\": r"\textbackslash{}", "~": r"\textasciitilde{}", "^": r"\textasciicircum{}", "<": r"\ensuremath{<}", ">": r"\ensuremath{>}",
               **{c: "\\" + c for c in "&%$#_{}"}}
    return "".join(special.get(c, c) for c in text)


def markdown(table: Table) -> str:
    align = ["left"] + ["right"] * (table.text.shape[1] - 1)
    return f"**{table.title}** {table.caption}\n\n{table.text.to_markdown(index=False, colalign=align, disable_numparse=True)}\n"
