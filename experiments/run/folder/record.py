# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Read the files of a run: every column is present, of its type and in its range, or the file is
refused.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pyarrow.parquet as parquet
from numpy.typing import ArrayLike
from pydantic import BaseModel, ConfigDict, ValidationError

from . import given, inside

MOST_BYTES = 4_000_000_000  #: of a file of rows, when unpacked
NAME, TEXT, NUMBER, FINITE, WHOLE, TRUTH = (
    "name",
    "text",
    "number",
    "finite number",
    "whole number",
    "truth value",
)
LABELS = ("hit", "clear", "uncertain")
QUESTION = ("overlap", "translation", "motion")
#: the content of a column: see COLUMNS
Kind = str | int | tuple[str, ...]
_SIDE: dict[str, Kind] = {"displacement": 3, "axis": 3, "angle": FINITE, "about": 3}
_SIDES = {f"{name}{side}": kind for side in ("", "_b") for name, kind in _SIDE.items()}

_TRUTH: dict[str, Kind] = {
    "label": LABELS,
    "t_lo": NUMBER,
    "t_hi": NUMBER,
    "start": LABELS,
    "end": LABELS,
    "gap": NUMBER,
    "certificate": TEXT,
    "precision": ("float32", "float64"),
    "touching": TRUTH,
    "reason": TEXT,
}
_BODY: dict[str, Kind] = {
    "body": NAME,
    "name": NAME,
    "kind": ("convex", "mesh", "union"),
    "vertices": 0,
    "faces": 0,
    "piece_vertices": 0,
    "piece_faces": 0,
}

#: file -> column -> its content: a kind above, one of several strings, or a list of so many finite
#: numbers (0: of any length).
COLUMNS: dict[str, dict[str, Kind]] = {
    "cases.parquet": {
        "case": NAME,
        "scenario": NAME,
        "level": FINITE,
        "question": QUESTION,
        "body_a": NAME,
        "body_b": NAME,
        "quaternion_a": 4,
        "position_a": 3,
        "quaternion_b": 4,
        "position_b": 3,
        **_SIDES,
        "size": FINITE,
        "faces": WHOLE,
        "tags": TEXT,
        "index": WHOLE,
        "attempt": WHOLE,
        **_TRUTH,
    },
    "bodies.parquet": _BODY,
    "pieces.parquet": {"case": NAME, "body_a": NAME, "body_b": NAME, **_TRUTH},
    "pieces-bodies.parquet": _BODY,
    "observations.parquet": {
        "case": NAME,
        "method": NAME,
        "status": ("ok", "unsupported", "error", "timeout"),
        "hit": TRUTH,
        "time": NUMBER,
        "detail": TEXT,
    },
    "timings.parquet": {
        "question": QUESTION,
        "faces": TEXT,
        "situation": TEXT,
        "method": NAME,
        "case": TEXT,
        "build_ns": FINITE,
        "rounds_ns": 0,
    },
    "stepping.parquet": {
        "scene": NAME,
        "contestant": NAME,
        "travel": FINITE,
        "runs": NUMBER,
        "tunnelled": NUMBER,
        "share": NUMBER,
        "low": NUMBER,
        "high": NUMBER,
        "us_per_step": NUMBER,
        "detail": TEXT,
    },
}
#: Columns that older runs, and references for `compare`, lack: rows.filled supplies their values.
LATER = {
    "index",
    "attempt",
    "precision",
    "touching",
    "reason",
    "about",
    *(c for c in _SIDES if c.endswith("_b")),
}
# may be missing
EMPTY = {
    ("observations.parquet", "hit"),
    ("timings.parquet", "build_ns"),
    ("timings.parquet", "rounds_ns"),
}
UNIQUE = {
    "cases.parquet": ["case"],
    "bodies.parquet": ["body"],
    "pieces.parquet": ["case"],
    "pieces-bodies.parquet": ["body"],
    "observations.parquet": ["case", "method"],
}


class RecordError(ValueError):
    """A file of a run that cannot be used; the message names it, the column or the row, and the
    remedy.
    """


class Facts(BaseModel):
    """The fields that are read from manifest.json, which may contain more."""

    model_config = ConfigDict(extra="allow")
    versions: dict[str, str | None] = {}
    started: str = "-"
    commit: str = "-"
    before: dict[str, Any] = {}


def facts(path: Path) -> dict[str, Any]:
    """The content of manifest.json. RecordError if it is invalid."""
    found: dict[str, Any] = given.json_in(path, "The file")
    try:
        Facts.model_validate(found)
    except ValidationError as error:
        raise _damaged(
            path,
            f"its field {'.'.join(map(str, error.errors()[0]['loc'])) or 'at the top'} is of the"
            " wrong type",
        ) from error
    return found


def read(path: Path, name: str = "") -> pd.DataFrame:
    """The rows of a parquet file, validated if it is listed in COLUMNS. RecordError, in one
    sentence, for an invalid file.
    """
    frame = _rows(path)
    why = "it has no rows" if name in UNIQUE and frame.empty else wrong(frame, name)
    if why is not None:
        raise _damaged(path, why)
    return frame


def wrong(frame: pd.DataFrame, name: str) -> str | None:
    """The first fault of the rows of a file listed in COLUMNS, if there is one."""
    return wrong_values(frame, name) or _doubled(frame, name)


def wrong_values(frame: pd.DataFrame, name: str) -> str | None:
    """The same for each row by itself."""
    for column, kind in COLUMNS.get(name, {}).items():
        if column not in frame:
            if column not in LATER or name.startswith("pieces"):  # these were never missing
                return f"it lacks the column '{column}'"
            continue
        row = _wrong(frame[column], kind, (name, column) in EMPTY)
        if row is not None:
            words = given.shown(repr(frame[column].iloc[row]))[:80]
            return (
                f"row {row} has {words} in the column '{column}', which must contain {_said(kind)}"
            )
    return None


def _doubled(frame: pd.DataFrame, name: str) -> str | None:
    if name in UNIQUE and (twice := frame.duplicated(UNIQUE[name])).any():
        row = int(np.flatnonzero(twice)[0])
        return f"row {row} is a duplicate ({given.shown(frame[UNIQUE[name]].iloc[row].tolist())})"
    return None


def _rows(path: Path) -> pd.DataFrame:
    given.regular(path, "The file")
    try:
        about = parquet.ParquetFile(path).metadata
        size = sum(about.row_group(i).total_byte_size for i in range(about.num_row_groups))
        if size > MOST_BYTES:
            raise ValueError(f"it would unpack to {size} bytes")
        return pd.read_parquet(path)
    except Exception as error:  # pyarrow raises errors of a dozen types
        raise _damaged(path, f"it cannot be read ({given.reason(error)})") from error


def _wrong(values: pd.Series, kind: Kind, may_be_empty: bool) -> int | None:
    """The first row with an invalid value."""
    if isinstance(kind, str) and kind in (NUMBER, FINITE, WHOLE, TRUTH):
        return _first(_wrong_numbers(values, kind, may_be_empty))
    if isinstance(kind, int):
        return _first([not _is_list(v, kind, may_be_empty) for v in values])
    try:
        place, words = pd.factorize(values, use_na_sentinel=False)
    except TypeError:  # lists and the like
        return 0
    fine: Callable[[Any], bool] = (
        is_name if kind == NAME else lambda v: isinstance(v, str) and (kind == TEXT or v in kind)
    )
    return _first(np.array([not fine(w) for w in words], bool)[place])


def is_name(value: object) -> bool:
    """Whether a text is printable and safe as a path: a case is scenario/level/index."""
    if not isinstance(value, str) or not value.strip() or not value.isprintable() or "\\" in value:
        return False
    return len(value) <= inside.LONGEST and not {"", ".", ".."} & set(value.split("/"))


def _wrong_numbers(values: pd.Series, kind: str, may_be_empty: bool) -> np.ndarray:
    """(n,) truth values. A NUMBER may be missing (NaN), a FINITE one may not; neither is
    infinite.
    """
    missing = values.isna().to_numpy()
    types = {TRUTH: ("boolean",), WHOLE: ("integer",)}.get(
        kind, ("integer", "floating", "mixed-integer-float")
    )
    if pd.api.types.infer_dtype(values[~missing]) not in (*types, "empty"):
        return np.ones(len(values), bool)
    bad = np.zeros(len(values), bool) if may_be_empty or kind == NUMBER else missing
    return (
        bad
        if kind == TRUTH
        else bad | np.isinf(values.astype("Float64").to_numpy(float, na_value=np.nan))
    )


def _is_list(value: object, size: int, may_be_empty: bool) -> bool:
    """Whether it is a flat array of finite numbers."""
    fine = isinstance(value, (np.ndarray, list)) and (not size or len(value) == size)
    array = np.asarray(value) if fine else np.empty(0, object)
    return (
        array.ndim == 1
        and array.dtype.kind in "iuf"
        and (may_be_empty or len(array) > 0)
        and bool(np.isfinite(array).all())
    )


def _said(kind: Kind) -> str:
    if isinstance(kind, tuple):
        return f"one of {', '.join(kind)}"
    if isinstance(kind, int):
        return f"a list of {kind or 'one or more'} finite numbers"
    return (
        f"a {kind}"
        if kind != NAME
        else f"a name of at most {inside.LONGEST} characters, without .. and \\"
    )


def _first(bad: ArrayLike) -> int | None:
    found = np.flatnonzero(np.asarray(bad, bool))
    return int(found[0]) if len(found) else None


def _damaged(path: Path, why: str) -> RecordError:
    return RecordError(
        f"{path} was changed or is damaged: {why}. Copy the run again from its source, or make it "
        "again."
    )
