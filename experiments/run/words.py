"""What methods say of themselves, made fit for a table: short, one line, valid text, and never an
error of ours.
"""

from __future__ import annotations

LONGEST = 200  # characters of an error's words
_READ = 4000  # characters of them that are looked at


def of_error(error: BaseException) -> str:
    """'ValueError: its first line'."""
    lines = text_of(error).splitlines()
    return plain(f"{type(error).__name__}: {lines[0] if lines else ''}")[:LONGEST]


def text_of(error: BaseException) -> str:
    """What it says, or that it cannot say it."""
    try:
        return plain(str(error))
    except BaseException as worse:  # a method's own __str__
        return f"(its words cannot be read: {type(worse).__name__})"


def plain(text: str) -> str:
    """A plain str that every file can hold; what is no valid Unicode is written as an escape."""
    return str.encode(text[:_READ], "utf-8", "backslashreplace").decode()
