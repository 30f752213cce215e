# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Who is sick must be named, and nobody else may have caught anything."""

import pandas as pd
import pytest

from experiments.drill import ward
from experiments.drill.command import Bench, Ending
from experiments.drill.faulty.kind import KINDS
from experiments.drill.faulty.methods import METHODS
from experiments.drill.outcome import FILES

KIND = KINDS["faulty-returns-none"]
WARNING = "Warning: faulty-returns-none answered nothing: returned NoneType."


def _rows(method, status, detail, hit):
    rows = [(case, method, status, hit, float("nan"), detail) for case in ("one", "two")]
    return pd.DataFrame(rows, columns=["case", "method", "status", "hit", "time", "detail"])


def _run(folder, rows):
    folder.mkdir()
    for name in FILES[:2]:
        (folder / name).write_bytes(b"as ever")
    rows.to_parquet(folder / FILES[2])
    return folder


GOOD = _rows("good", "ok", "", True)
ILL = _rows(KIND.name, "error", "returned NoneType, not a Verdict", None)


@pytest.mark.parametrize(
    "rows, text, why",
    [
        (pd.concat([GOOD, ILL]), WARNING, ""),
        (pd.concat([_rows("good", "ok", "", False), ILL]), WARNING, "good methods have changed"),
        (pd.concat([GOOD, ILL[:1]]), WARNING, "1 rows for 2 cases"),
        (pd.concat([GOOD, _rows(KIND.name, "ok", "", True)]), WARNING, "is 'ok'"),
        (pd.concat([GOOD, _rows(KIND.name, "error", " ", None)]), WARNING, "for the reason ' '"),
        (pd.concat([GOOD, _rows(KIND.name, "error", "x" * 2000, None)]), WARNING, "for the reason"),
        (pd.concat([GOOD, ILL]), "faulty-returns-none  0/0", "no warning names it"),
    ],
)
def test_what_is_wrong_is_said(rows, text, why, tmp_path):
    healthy = _run(tmp_path / "healthy", GOOD)
    one = ward.Ward(Bench((), tmp_path / "none.toml"), healthy)
    found = one._wrong(_run(tmp_path / "run", rows), Ending(0, text), [KIND])
    assert why in found and bool(why) == bool(found)


def test_kinds_are_added_to_the_configuration(tmp_path):
    one = ward.Ward(Bench((), ward.METHOD_FILE.parents[1] / "faulty.toml"), tmp_path)
    text = one._configuration([KIND], tmp_path / "run").read_text()
    assert '"faulty-returns-none"]' in text and "method_files" in text and '"fcl-mesh"' in text


def test_there_are_at_least_the_54_kinds_of_the_issue():
    assert len({method.name for method in METHODS}) == len(KINDS) >= 54
