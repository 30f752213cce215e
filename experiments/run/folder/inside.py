"""Paths inside a folder that somebody else may have filled: names are checked, links are not
followed.
"""

from __future__ import annotations

from pathlib import Path

LONGEST = 200  #: characters of a name, which file systems take whole


class Outside(ValueError):
    """A name that would lead out of its folder, or a link in the way. The message says what
    to do.
    """


def inside(folder: Path, *names: str) -> Path:
    """folder/names[0]/names[1]/..., for writing or deleting there. The folder itself may be a link.

    Outside for a name that is no plain one, and where a part of the path is a symbolic link or,
    before the last, no folder: what is written then stays in the folder.
    """
    path = Path(folder)
    for i, name in enumerate(names):
        path = path / checked(name, folder)
        if path.is_symlink():
            raise Outside(
                f"{path} is a symbolic link, which is not followed: nothing was written "
                "there. Remove the link, then say the same again."
            )
        if i < len(names) - 1 and path.exists() and not path.is_dir():
            raise Outside(f"{path} is no folder. Move it away, then say the same again.")
    return path


def checked(name: str, folder) -> str:
    """The name, which is that of one file. Outside if not."""
    fine = isinstance(name, str) and name not in ("", ".", "..") and len(name) <= LONGEST
    if not fine or not name.isprintable() or "/" in name or "\\" in name:
        shown = repr(name)[:80]
        raise Outside(
            f"{shown} is no name of a file in {folder}: a name has no slash and nothing that cannot"
            f" be printed, is neither . nor .. and has {LONGEST} characters at most. Rename it"
            " where it comes from."
        )
    return name
