# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Read a run from outside as data: its Python files are not executed, and a fault in it is reported
in one paragraph.
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
    """Open a run. Its Python files are executed only with `trust`; otherwise the recorded
    declarations of their methods and scenarios are used.
    """
    store = Store(folder)
    if trust:
        config.load_files(store.config)
    for notice in () if trust else declared.know(store):
        Console(stderr=True).print(given.markup(notice), highlight=False)
    return store


@contextmanager
def reading(*folders: Path) -> Iterator[None]:
    """Turn any exception caused by a folder or file from outside into an error of one paragraph.

    This is a safety net: record.py and rows.py should detect and name every fault, and an exception
    that gets this far is a bug in them.
    """
    try:
        yield
    except (ValueError, StoreError, ImportError, OSError, typer.Exit):
        raise
    except Exception as error:
        names = " or ".join(map(str, folders))
        raise StoreError(
            f"The contents of {names} are inconsistent ({type(error).__name__}:"
            f" {given.reason(error)}). The data was changed or is damaged; copy it again from its"
            " source, or repeat the run."
        ) from error
