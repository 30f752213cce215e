# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Paths inside a folder with untrusted content: names are checked, and links are not followed."""

from __future__ import annotations

from pathlib import Path

LONGEST = 200  #: characters of a name, which file systems support


class Outside(ValueError):
    """A name that leads out of its folder, or a link in the path. The message gives the remedy."""


def inside(folder: Path, *names: str) -> Path:
    """folder/names[0]/names[1]/..., for writing or deleting there. The folder itself may be a link.

    Raises Outside for a name that is not plain, and if a part of the path is a symbolic link or,
    before the last part, not a folder: writes then stay inside the folder.
    """
    path = Path(folder)
    for i, name in enumerate(names):
        path = path / checked(name, folder)
        if path.is_symlink():
            raise Outside(
                f"{path} is a symbolic link, which is not followed: nothing was written there. "
                "Remove the link, then repeat the command."
            )
        if i < len(names) - 1 and path.exists() and not path.is_dir():
            raise Outside(f"{path} is not a folder. Move it away, then repeat the command.")
    return path


def checked(name: str, folder: Path) -> str:
    """The name if it is that of a single file. Outside if not."""
    fine = isinstance(name, str) and name not in ("", ".", "..") and len(name) <= LONGEST
    if not fine or not name.isprintable() or "/" in name or "\\" in name:
        shown = repr(name)[:80]
        raise Outside(
            f"{shown} is not a valid file name in {folder}: a name has no slash and no "
            f"unprintable characters, is neither . nor .. and has at most {LONGEST} characters. "
            "Rename it at its source."
        )
    return name
