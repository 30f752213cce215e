# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Runs with faulty methods: each faulty method must be named, and no other may be affected."""

from __future__ import annotations

import json
import re
import tomllib
from dataclasses import dataclass, replace
from pathlib import Path

import pandas as pd

from .command import Attempt, Bench, Ending
from .faulty.kind import ERROR, TIMEOUT, Kind
from .outcome import EQUAL, FAILED, FILES, Outcome, misconduct

METHOD_FILE = Path(__file__).parent / "faulty" / "methods.py"
SIZE = 64 << 20  # maximum bytes of a run folder, whatever methods print
WORDS = 1000  # maximum characters of the reason in a row
SLOW = 900.0  # extra seconds of a run for each kind that waits for the wall deadline
BUSY = 60.0  # and for each other one
_NOTICE = re.compile(r"warning|answered n|no answer|nothing", re.IGNORECASE)


@dataclass(frozen=True)
class Ward:
    """bench: of the configuration without faulty methods. healthy: the folder of its undisturbed
    run.
    """

    bench: Bench
    healthy: Path

    def visit(self, kinds: list[Kind], place: Path) -> Outcome:
        """Run the configuration with these kinds added."""
        attempt = Attempt(replace(self.bench, config=self._configuration(kinds, place)), place)
        patience = attempt.bench.patience + sum(SLOW if k.slow else BUSY for k in kinds)
        ending = attempt.start().finish(patience)
        why = misconduct(ending) or self._wrong(attempt.folder, ending, kinds)
        return Outcome(FAILED, why) if why else Outcome(EQUAL)

    def _configuration(self, kinds: list[Kind], place: Path) -> Path:
        """A copy of the configuration beside the run, with the kinds among its methods."""
        place.mkdir(parents=True)
        text = self.bench.config.read_text()
        methods = [*tomllib.loads(text)["methods"], *(k.name for k in kinds)]
        lines = re.sub(
            r"^methods = .*$",
            lambda _: (
                f"methods = {json.dumps(methods)}\nmethod_files = {json.dumps([str(METHOD_FILE)])}"
            ),
            text,
            flags=re.MULTILINE,
        )
        path = place / self.bench.config.name
        path.write_text(lines)
        return path

    def _wrong(self, folder: Path, ending: Ending, kinds: list[Kind]) -> str:
        """The first fault of the run, or ""."""
        if ending.code:
            return f"exit code {ending.code}: {ending.reason}"
        for name in FILES[:2]:
            if (folder / name).read_bytes() != (self.healthy / name).read_bytes():
                return f"{name} has other bytes"
        found, healthy = (pd.read_parquet(f / FILES[2]) for f in (folder, self.healthy))
        if not _same(found[found.method.isin(set(healthy.method))], healthy):
            return "rows of good methods have changed"
        if (size := sum(p.stat().st_size for p in folder.rglob("*") if p.is_file())) > SIZE:
            return f"the run folder has {size >> 20} MiB"
        cases = list(dict.fromkeys(healthy.case))
        return next(
            filter(
                None, (_ill(found[found.method == k.name], k, cases, ending.text) for k in kinds)
            ),
            "",
        )


def _same(found: pd.DataFrame, expected: pd.DataFrame) -> bool:
    return found.reset_index(drop=True).to_json() == expected.reset_index(drop=True).to_json()


def _ill(rows: pd.DataFrame, kind: Kind, cases: list[str], text: str) -> str:
    """The fault of a faulty method's rows, or ""."""
    if list(rows.case) != cases:
        return f"{kind.name} has {len(rows)} rows for {len(cases)} cases"
    if strange := set(rows.status) - kind.statuses:
        row = rows[rows.status.isin(strange)].iloc[0]
        wanted = " or ".join(sorted(kind.statuses))
        return f"{kind.name} is '{row.status}' ({row.detail[:200]}), not {wanted}"
    for row in rows[rows.status.isin([ERROR, TIMEOUT])].itertuples():
        if not row.detail.strip() or len(row.detail) > WORDS or "nothing stopped me" in row.detail:
            return f"{kind.name} is '{row.status}' for the reason '{row.detail[:80]}'"
    silent = not (rows.status == "ok").any()
    if silent and not any(kind.name in line and _NOTICE.search(line) for line in _paragraphs(text)):
        return f"{kind.name} answered nothing, and no warning names it"
    return ""


def _paragraphs(text: str) -> list[str]:
    """The output, with lines folded by the terminal joined."""
    return [" ".join(block.split()) for block in re.split(r"\n\s*\n", text)] + text.splitlines()
