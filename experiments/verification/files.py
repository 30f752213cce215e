# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The files of a run compared with the hashes in its manifest."""

from __future__ import annotations

from experiments.run.folder import given, manifest
from experiments.run.folder.store import Store

from .findings import Findings


def check(store: Store, found: Findings) -> None:
    """Refuses a file that changed or is missing. A file that the manifest does not list becomes
    a note.
    """
    hashes = _recorded(store, found)
    if hashes is None:
        return
    now = manifest.hashes(store.folder)
    for name, digest in hashes.items():
        if name not in now:
            found.refuse(name, "the file is missing, but the manifest lists it")
        elif now[name] != digest:
            found.refuse(
                name, "the file changed after the run: its hash differs from the manifest's"
            )
    if other := sorted(set(now) - set(hashes)):
        found.note(f"Not listed in manifest.json, and not checked: {', '.join(other)}.")


def _recorded(store: Store, found: Findings) -> dict[str, str] | None:
    if not store.has("manifest.json"):
        return found.note("This run has no manifest.json and records no hashes.")
    try:
        hashes = given.json_in(store.folder / "manifest.json", "The file").get("sha256")
        if hashes is None:
            return found.note("This run records no hashes.")
        return dict(hashes)
    except (ValueError, TypeError, AttributeError) as error:
        return found.refuse("manifest.json", f"it cannot be read ({given.reason(error)})")
