# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The terms of experiments/GLOSSARY.md, embedded in the report: the page loads no other file."""

from __future__ import annotations

import re
from pathlib import Path

PAGE = Path(__file__).parents[2] / "GLOSSARY.md"


def terms() -> list[dict]:
    """The sections of the glossary in its order: {"section", "terms": [[term, definition], ...]}.

    Definitions are one line of Markdown text with `code` in backticks.
    """
    parts = re.split(r"^## (.+)$", PAGE.read_text(), flags=re.MULTILINE)[1:]
    return [
        {"section": section, "terms": _entries(body)}
        for section, body in zip(parts[::2], parts[1::2])
    ]


def _entries(body: str) -> list[list[str]]:
    parts = re.split(r"^### (.+)$", body, flags=re.MULTILINE)[1:]
    return [[term, " ".join(text.split())] for term, text in zip(parts[::2], parts[1::2])]
