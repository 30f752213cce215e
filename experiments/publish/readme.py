# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Insert the tables of a run into a Markdown page between markers, so that no figure is typed."""

from __future__ import annotations

import re
from pathlib import Path

MARK = re.compile(
    r"(<!-- table (?P<name>[\w-]+)(?: of (?P<run>[\w-]+))? -->\n).*?(<!-- end -->)", re.DOTALL
)


def fill(page: str, tables: Path) -> str:
    """The page with the text between `<!-- table NAME -->` and `<!-- end -->` replaced by
    tables/NAME.md.

    `<!-- table NAME of RUN -->` takes the table from the run folder RUN next to that of `tables`.
    Raises ValueError if the run has no table of that name.
    """

    def table(match: re.Match) -> str:
        folder = tables.parents[1] / match["run"] / "tables" if match["run"] else tables
        path = folder / f"{match['name']}.md"
        if not path.is_file():
            known = ", ".join(sorted(p.stem for p in folder.glob("*.md")))
            raise ValueError(
                f"The page has a marker for the table '{match['name']}', which the run does not"
                f" have. Its tables are: {known}."
            )
        return f"{match[1]}{path.read_text()}{match[4]}"

    return MARK.sub(table, page)
