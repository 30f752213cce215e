"""Which cases stand behind a cell of a table: a link is a few conditions that `select` here and `casesOf` in page/data.js read alike."""

from __future__ import annotations

import pandas as pd

from ofg import QUESTIONS

from ..timing import SIZES

#: column of a table -> kind of the rows that it counts
COLUMNS = {"misses": "miss", "tunnelled": "tunnelled", "false alarms": "false alarm", "in margin": "conservative", "answered": "answered",
           "times": "timed", "median |error|": "timed", "latest": "late", "late": "late", "earliest": "early", "early": "early"}
LABELS = {"cases": None, "hit": "hit", "clear": "clear", "uncertain": "uncertain"}
LABELLED = ("right", "miss", "false alarm", "conservative")


def links(table, found: pd.DataFrame) -> list[list[dict | None]]:
    """A link, or None, for each cell of table.text. Keys of a link, all optional: method, question, scenario, scenarios, level, band, sizes,
    situation, label, detail (its beginning), kind (see KINDS)."""
    scenarios, bands = set(found.scenario), set(_bands(found))
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
        made.append([_link(table.name, str(column), str(value), row, place, scenarios, bands) for column, value in row.items()])
    return made


def _link(name, column, value, row, place, scenarios, bands) -> dict | None:
    if value in ("-", "", "0 (0)"):
        return None
    if name == "truth":
        return {"scenario": row["scenario"], **({"label": LABELS[column]} if LABELS[column] else {})} if column in LABELS else None
    if "method" not in row or column == "method":
        return None
    link = {"method": row["method"], **place}
    if name == "unanswered":
        return {**link, "kind": row["status"], "detail": row["detail"]} if column == "cases" else None
    if name.startswith(("cost-", "ratio-")):
        return {**link, "sizes": column, "kind": "clocked"} if column in {title for _, title in SIZES} else None
    if name.startswith("tunnelling"):
        return {**link, "level": float(column), "kind": "judged hit"}
    if "question" not in place:
        return None
    if column in scenarios:
        return {**link, "scenario": column, "kind": "judged"}
    if column in bands:
        return {**link, "band": column, "kind": "judged"}
    return {**link, "kind": COLUMNS[column]} if column in COLUMNS else None


def select(found: pd.DataFrame, link: dict, clocked: set[tuple[str, str]] = frozenset()) -> pd.DataFrame:
    """Rows of metrics.outcomes (with columns band, sizes, situation) behind a link. clocked: (method, case) that were timed."""
    keep = pd.Series(True, found.index)
    for key in ("method", "question", "scenario", "level", "band", "sizes", "situation", "label"):
        if key in link:
            keep &= found[key] == link[key]
    if "scenarios" in link:
        keep &= found.scenario.isin(link["scenarios"])
    if "detail" in link:
        keep &= found.detail.fillna("").str.startswith(link["detail"])
    return found[keep & kinds(found, link.get("kind", "all"), clocked)]


def kinds(found: pd.DataFrame, kind: str, clocked=frozenset()) -> pd.Series:
    """KINDS: an outcome; "tunnelled", "wrong", "judged" (in the rates), "judged hit", "answered", "timed" (has an error of its time), "late",
    "early", "clocked", "all"."""
    if kind == "all":
        return pd.Series(True, found.index)
    if kind == "wrong":
        return found.outcome.isin(["miss", "false alarm"])
    if kind == "judged":
        return found.outcome.isin(LABELLED)
    if kind == "judged hit":
        return found.outcome.isin(LABELLED) & (found.label == "hit")
    if kind == "answered":
        return found.status == "ok"
    if kind == "timed":
        return found.error.notna()
    if kind in ("late", "early"):
        return found.error > 0 if kind == "late" else found.error < 0
    if kind == "tunnelled":
        return found.tunnelled
    if kind == "clocked":
        return pd.Series([pair in clocked for pair in zip(found.method, found.case)], found.index, dtype=bool)
    return found.outcome == kind


def _bands(found: pd.DataFrame) -> list[str]:
    from ..tables import gap_bands

    return gap_bands(found.relative_gap[:0])[1]
