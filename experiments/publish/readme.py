"""Tables of a run in a Markdown page, between markers, so that no figure there is ever typed."""

from __future__ import annotations

import re
from pathlib import Path

MARK = re.compile(
    r"(<!-- table (?P<name>[\w-]+)(?: of (?P<run>[\w-]+))? -->\n).*?(<!-- end -->)", re.DOTALL
)


def fill(page: str, tables: Path) -> str:
    """The page with what stands between `<!-- table NAME -->` and `<!-- end -->` replaced by
    tables/NAME.md.

    `<!-- table NAME of RUN -->` takes it from the run folder RUN beside that of `tables`.
    ValueError if the run has no table of that name.
    """

    def table(match: re.Match) -> str:
        folder = tables.parents[1] / match["run"] / "tables" if match["run"] else tables
        path = folder / f"{match['name']}.md"
        if not path.is_file():
            known = ", ".join(sorted(p.stem for p in folder.glob("*.md")))
            raise ValueError(
                f"The page asks for the table '{match['name']}', which the run does not have. It"
                f" has: {known}."
            )
        return f"{match[1]}{path.read_text()}{match[4]}"

    return MARK.sub(table, page)
