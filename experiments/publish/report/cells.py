# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Links from the cells of a table to the cases that they count.

A link is a set of conditions; `select` here and `casesOf` in page/data.js evaluate it alike.
"""

from __future__ import annotations

import json

import pandas as pd

from experiments.analysis.outcome import JUDGED
from experiments.analysis.tables.table import unmarked
from experiments.run import piece_truth
from experiments.run.bins import SIZES
from ofg import QUESTIONS

#: column of a table -> kind of the rows that it counts
COLUMNS = {
    "misses": "miss",
    "tunnelled": "tunnelled",
    "false alarms": "false alarm",
    "wrong": "wrong",
    "beyond": "beyond",
    "contained": "contained",
    "answered": "answered",
    "times": "timed",
    "median |error|": "timed",
    "latest": "late",
    "late": "late",
    "earliest": "early",
    "early": "early",
}
LABELS = {"cases": None, "hit": "hit", "clear": "clear", "uncertain": "uncertain"}
#: value of a table that a configuration defines -> kind of the rows that it covers
VALUES = {
    "misses": "judged hit",
    "false alarms": "judged clear",
    "wrong": "judged",
    "beyond": "judged",
    "tunnelled": "can tunnel",
    "answered": "asked",
    "time error": "timed",
    "latest": "timed",
    "earliest": "timed",
    "net time": "clocked",
    "gross time": "clocked",
    "build time": "clocked",
    "ratio": "clocked",
}
#: tables over the common cases, which no link can express
UNLINKED = ("common-", "ranks-")


def links(table, found: pd.DataFrame) -> list[list[dict | None]]:
    """A link, or None, for each cell of table.text.

    Keys of a link, all optional: method, question, scenario, level, band, sizes, situation, label;
    scenarios, levels (any of them); tag ([name, values], any of the values); detail (a prefix);
    kind (see `kinds`).
    """
    if table.choice:
        return _chosen(table, found)
    if table.name.startswith(UNLINKED):
        return [[None] * table.text.shape[1] for _ in range(len(table.text))]
    scenarios, bands = set(found.scenario.unique()), set(_bands(found))
    text, place = table.text, {}
    for question in QUESTIONS:
        if f"-{question}" in table.name:
            place["question"] = question
    for situation in ("deep", "near", "apart", "hit", "clear"):
        if table.name.endswith(f"-{situation}"):
            place["situation"] = situation
    if table.name.startswith("tunnelling"):
        place["scenarios"] = [n for n in scenarios if f" {n}" in table.caption]
    made = []
    for row in text.to_dict("records"):
        made.append(
            [
                _link(table.name, str(column), str(value), row, place, scenarios, bands)
                for column, value in row.items()
            ]
        )
    return made


def _chosen(table, found: pd.DataFrame) -> list[list[dict | None]]:
    """Links of a table that a configuration defines: a row per method, a column per value of its
    choice.
    """
    choice = table.choice
    place = {
        "kind": VALUES[choice.value],
        **({"question": choice.question} if choice.question else {}),
        **({"situation": choice.situation} if choice.situation else {}),
        **({"scenarios": list(choice.scenarios)} if choice.scenarios else {}),
    }
    columns = {
        str(column): _values(choice.columns, str(column), found)
        for column in table.text.columns[1:]
    }
    return [
        [
            None,
            *(
                (
                    {"method": row[0], **place, **columns[str(c)]}
                    if value != "-" and columns[str(c)] and row[0] != piece_truth.NAME
                    else None
                )
                for c, value in zip(table.text.columns[1:], row[1:])
            ),
        ]
        for row in table.text.astype(str).values.tolist()
    ]


def _values(name: str, column: str, found: pd.DataFrame) -> dict | None:
    """The condition that a column of such a table represents; the tables print numbers with six
    digits.
    """
    if name in ("scenario", "question", "situation", "band"):
        return {name: column}
    if name == "faces":
        return {"sizes": column}
    if name == "level":
        return {"levels": [v for v in sorted(found.level.unique()) if f"{v:g}" == column]}
    known = {json.loads(text).get(name) for text in found.tags.unique()} - {None}
    return {
        "tag": [
            name,
            sorted(
                v for v in known if v == column or (not isinstance(v, str) and f"{v:g}" == column)
            ),
        ]
    }


def _link(name, column, value, row, place, scenarios, bands) -> dict | None:
    if value in ("-", "", "0 (0)"):
        return None
    if name == "truth":
        return (
            {"scenario": row["scenario"], **({"label": LABELS[column]} if LABELS[column] else {})}
            if column in LABELS
            else None
        )
    if "method" not in row or column == "method" or row["method"] == piece_truth.NAME:
        return None
    link = {"method": unmarked(row["method"]), **place}
    if name == "unanswered":
        return (
            {**link, "kind": row["status"], "detail": row["detail"]} if column == "cases" else None
        )
    if name.startswith(("cost-", "ratio-")):
        return (
            {**link, "sizes": column, "kind": "clocked"}
            if column in {title for _, title in SIZES}
            else None
        )
    if name.startswith("tunnelling"):
        return {**link, "level": float(column), "kind": "judged hit"}
    if "question" not in place:
        return None
    if name.startswith("touching"):
        return {**link, "kind": "touching"} if column == "answered" else None
    if (
        name.startswith("scenarios-") and column in scenarios
    ):  # a scenario is called "contained", like a column of other tables
        return {**link, "scenario": column, "kind": "judged"}
    if column in bands:
        return {**link, "band": column, "kind": "judged"}
    return {**link, "kind": COLUMNS[column]} if column in COLUMNS else None


def select(
    found: pd.DataFrame, link: dict, clocked: set[tuple[str, str]] = frozenset()
) -> pd.DataFrame:
    """Rows of outcome.outcomes (with columns band, sizes, situation) that a link selects. clocked:
    pairs (method, case) that were timed.
    """
    keep = pd.Series(True, found.index)
    for key in ("method", "question", "scenario", "level", "band", "sizes", "situation", "label"):
        if key in link:
            keep &= found["case_label" if key == "label" else key] == link[key]
    for key, column in (("scenarios", "scenario"), ("levels", "level")):
        if key in link:
            keep &= found[column].isin(link[key])
    if "tag" in link:
        name, values = link["tag"]
        keep &= found.tags.map(
            {text: json.loads(text).get(name) in values for text in found.tags.unique()}
        )
    if "detail" in link:
        keep &= found.detail.fillna("").str.startswith(link["detail"])
    return found[keep & kinds(found, link.get("kind", "all"), clocked)]


def kinds(found: pd.DataFrame, kind: str, clocked=frozenset()) -> pd.Series:
    """Whether each row is of a kind.

    A kind is an outcome; "tunnelled", "wrong", "within" or "beyond" the method's tolerance; the
    denominator of a rate: "judged", "judged hit", "judged clear", "can tunnel", "asked",
    "answered"; "timed" (has an error of the time of impact), "late", "early"; "clocked" (has a
    query time); "all".
    """
    if kind == "all":
        return pd.Series(True, found.index)
    if kind in ("wrong", "within"):
        return found[kind]
    if kind == "beyond":
        return found.wrong & ~found.within
    if kind == "judged":
        return found.outcome.isin(JUDGED)
    if kind == "judged hit":
        return found.outcome.isin(JUDGED) & (found.label == "hit")
    if kind == "judged clear":
        return found.outcome.isin(JUDGED) & (found.label == "clear")
    if kind == "can tunnel":
        return found.can_tunnel
    if kind == "asked":
        return ~found.detail.fillna("").str.startswith("does not answer")
    if kind == "answered":
        return found.status == "ok"
    if kind == "timed":
        return found.error.notna()
    if kind in ("late", "early"):
        return found.error > 0 if kind == "late" else found.error < 0
    if kind == "tunnelled":
        return found.tunnelled
    if kind == "clocked":
        return pd.Series(
            [pair in clocked for pair in zip(found.method, found.case)], found.index, dtype=bool
        )
    return found.outcome == kind


def _bands(found: pd.DataFrame) -> list[str]:
    from experiments.analysis.views import gap_bands

    return gap_bands(found.relative_gap[:0])[1]
