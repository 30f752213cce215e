# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Messages of methods made fit for a table: short, one line, valid text, and never an error of
their own.
"""

from __future__ import annotations

LONGEST = 200  # characters of an error's message
_READ = 4000  # characters of it that are examined


def of_error(error: BaseException) -> str:
    """'ValueError: its first line'."""
    lines = text_of(error).splitlines()
    return plain(f"{type(error).__name__}: {lines[0] if lines else ''}")[:LONGEST]


def text_of(error: BaseException) -> str:
    """Its text, or a note that its text cannot be read."""
    try:
        return plain(str(error))
    except BaseException as worse:  # a method's own __str__
        return f"(its words cannot be read: {type(worse).__name__})"


def plain(text: str) -> str:
    """A plain str that every file can hold; invalid Unicode is escaped."""
    return str.encode(text[:_READ], "utf-8", "backslashreplace").decode()
