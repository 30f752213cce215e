# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""report.html: one self-contained page for a run, and the same page for a single case."""

from __future__ import annotations

from collections.abc import Sequence

from experiments.run.folder.store import Store


def report(store: Store, tables: Sequence | None = None) -> None:
    """Write RUN/report.html from the rows of a finished run. Raises StoreError if the run is not
    finished or the disk is full.

    tables: the run's tables (tables.build), if they have been built already.
    """
    from . import page, payload

    made = payload.of_run(store, tables)
    store.write_text(
        page.page(made, f"{made['run']['title']}: collision detection, certified"), "report.html"
    )
