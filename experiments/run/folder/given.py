# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Read files that may come from somebody else: completely, as text or JSON, or refuse them with
a message.
"""

from __future__ import annotations

import json
import os
import stat
from pathlib import Path
from typing import Any

from rich.markup import escape

MOST_TEXT = 16_000_000  #: bytes of a configuration, a manifest or a page
MOST_CASE = 512_000_000  #: bytes of a case in a separate file


class GivenError(ValueError):
    """A file that cannot be read; the message names it, the fault and the remedy."""


def regular(path: Path, what: str) -> int:
    """The bytes of a file. GivenError for a folder, a pipe or a device, from which a read could
    block forever.
    """
    try:
        found = os.stat(path)
    except (OSError, ValueError) as error:
        raise GivenError(f"{what} {shown(path)} cannot be opened: {reason(error)}.") from error
    if not stat.S_ISREG(found.st_mode):
        raise GivenError(
            f"{what} {shown(path)} is not a regular file. Give the path of a regular file."
        )
    return found.st_size


def text(path: Path, what: str, most: int = MOST_TEXT) -> str:
    """The content of a UTF-8 file. what: its kind, which begins the message. GivenError."""
    size = regular(path, what)
    if size > most:
        raise GivenError(
            f"{what} {shown(path)} has {size} bytes; the limit is {most}. It is probably another "
            "file."
        )
    try:
        found = Path(path).read_bytes().decode()
    except UnicodeDecodeError as error:
        raise GivenError(
            f"{what} {shown(path)} is not UTF-8 text (byte {error.start}). Save it as UTF-8, or"
            " give another file."
        ) from error
    except OSError as error:
        raise GivenError(f"{what} {shown(path)} cannot be read: {reason(error)}.") from error
    if "\0" in found:
        raise GivenError(
            f"{what} {shown(path)} contains a NUL byte, so it is not text. Give another file."
        )
    return found


def json_in(path: Path, what: str, most: int = MOST_TEXT) -> Any:
    """The content of a JSON file. GivenError."""
    try:
        return json.loads(text(path, what, most))
    except RecursionError as error:
        raise GivenError(f"{what} {shown(path)} is nested too deeply to be read.") from error
    except json.JSONDecodeError as error:
        raise GivenError(f"{what} {shown(path)} is not valid JSON: {error}.") from error
    except GivenError:
        raise
    except ValueError as error:  # a whole number of thousands of digits
        raise GivenError(
            f"{what} {shown(path)} contains a number that cannot be read: {clipped(str(error))}."
        ) from error


def reason(error: Exception) -> str:
    return clipped(getattr(error, "strerror", None) or str(error))


def printable(words: Any) -> str:
    """External text on one line with unprintable characters escaped, because a terminal
    interprets some of them.
    """
    return "".join(
        c if c.isprintable() else " " if c in "\n\t" else c.encode("unicode_escape").decode()
        for c in str(words)
    )


def shown(words: Any) -> str:
    return clipped(printable(words))


def clipped(words: str, most: int = 300) -> str:
    """The text on one line, shortened if it is long."""
    line = " ".join(words.split())
    return line if len(line) <= most else f"{line[: most - 40]}... ({len(line)} characters)"


def markup(words: Any) -> str:
    """External text that rich prints literally and not as markup."""
    return escape(printable(words))
