"""Runs of others are read as data: their own files are not run, and what is strange in them is said
in a paragraph.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import typer
from rich.console import Console

from experiments.run import config, declared
from experiments.run.folder import given
from experiments.run.folder.store import Store, StoreError


def opened(folder: Path, trust: bool) -> Store:
    """A run to be read. Its own files are run with trust alone; what they declare was recorded."""
    store = Store(folder)
    if trust:
        config.load_files(store.config)
    for notice in () if trust else declared.know(store):
        Console(stderr=True).print(given.markup(notice), highlight=False)
    return store


@contextmanager
def reading(*folders: Path) -> Iterator[None]:
    """What a folder or a file from outside makes fail, however strange, is an error of one
    paragraph and no traceback.

    A net: record.py and rows.py find what is wrong and name it, or that is a fault of theirs.
    """
    try:
        yield
    except (ValueError, StoreError, ImportError, OSError, typer.Exit):
        raise
    except Exception as error:
        names = " or ".join(map(str, folders))
        raise StoreError(
            f"What {names} holds does not fit together ({type(error).__name__}:"
            f" {given.reason(error)}). It was changed or is damaged; take it anew from where it was"
            " made, or make it again."
        ) from error
