"""report.html: a run as one self-contained page, and the same page for one case."""

from __future__ import annotations

from collections.abc import Sequence

from experiments.run.folder.store import Store


def report(store: Store, tables: Sequence | None = None) -> None:
    """Write RUN/report.html from the rows of a finished run. StoreError where the run is not
    finished or the disk is full.

    tables: those of the run (tables.build), if they are made already.
    """
    from . import page, payload

    made = payload.of_run(store, tables)
    store.write_text(
        page.page(made, f"{made['run']['title']}: collision detection, certified"), "report.html"
    )
