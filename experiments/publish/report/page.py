# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Write one self-contained HTML file from the template, styles, scripts, libraries and data."""

from __future__ import annotations

import html
import re
from pathlib import Path

from .payload import encode, pack

HERE = Path(__file__).parent
SCRIPTS = (
    "data.js",
    "text.js",
    "filters.js",
    "board.js",
    "plot.js",
    "pivot.js",
    "tables.js",
    "geometry.js",
    "camera.js",
    "lines.js",
    "selections.js",
    "proof.js",
    "scene.js",
    "words.js",
    "case.js",
    "gallery.js",
    "run.js",
    "glossary.js",
    "main.js",
)
#: in this order, as later rules override earlier ones
STYLES = ("colours.css", "base.css", "tables.css", "gallery.css", "case.css", "screens.css")
MARK = re.compile("@@(TITLE|STYLE|STORES|SCRIPT)@@")
LIBRARIES = ("plotly-basic.min.js", "three.min.js")


def page(payload: dict, title: str) -> str:
    """The text of the page. Its Content-Security-Policy forbids every request to a network."""
    content = dict(payload)
    bodies = content.pop("bytes")
    blocks = {"data": encode(content), "bytes": pack(bodies)}
    wanted = LIBRARIES if content["mode"] == "run" else LIBRARIES[1:]
    blocks.update(
        {
            name.split("-")[0].split(".")[0]: pack((HERE / "vendor" / name).read_bytes())
            for name in wanted
        }
    )
    stores = "\n".join(
        f'<script type="application/octet-stream" id="{name}">{text}</script>'
        for name, text in blocks.items()
    )
    script = "\n".join((HERE / "page" / name).read_text() for name in SCRIPTS)
    made = (HERE / "page" / "page.html").read_text()
    parts = {
        "TITLE": html.escape(title),
        "STYLE": "".join((HERE / "page" / "style" / name).read_text() for name in STYLES),
        "STORES": stores,
        "SCRIPT": script,
    }
    return MARK.sub(lambda mark: parts[mark[1]], made)  # one pass, as a title may contain a mark
