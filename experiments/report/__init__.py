"""report.html: a run as one self-contained page, and the same page for one case."""

from __future__ import annotations

from ..store import Store


def report(store: Store) -> None:
    """Write RUN/report.html from the rows of a finished run. StoreError where the run is not finished or the disk is full."""
    from . import page, payload

    made = payload.of_run(store)
    store.write_text(page.page(made, f"{made['run']['title']}: collision detection, certified"), "report.html")
