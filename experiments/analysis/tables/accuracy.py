# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The tables of accuracy, in two views: all cases that a method answered, and common cases."""

from __future__ import annotations

import pandas as pd

from experiments.analysis import metrics, outcome, views
from experiments.run import piece_truth
from ofg import QUESTIONS

from .table import MARK, Table, fraction, interval, marked, of, pivot, share

BEYOND = "Beyond: wrong answers outside the method's documented tolerance (table methods)."
CONTAINED = (
    "Contained: hits inside another body that a test of surfaces cannot detect; they enter no rate."
)
OWN = (
    "Each method over the certified cases that it answered, which differ between methods, with 95 %"
    " Wilson intervals in percent."
)


def leaderboards(found: pd.DataFrame) -> list[Table]:
    """The table of all questions, lowest share of wrong answers first; no table for a run with a
    single question.
    """
    if found.question.nunique() < 2:
        return []
    counts = metrics.rates(found, ["method"])
    counts = counts.sort_values(["wrong_rate", "wrong_high"], kind="stable", na_position="last")
    single = outcome.out_of_their_depth(found)
    text = pd.DataFrame(
        {
            "method": marked(counts.method, single),
            "answered": [share(a, n) for a, n in zip(counts.answered, counts.asked)],
            "wrong": fraction(counts, "wrong", "judged"),
            "95 %": interval(counts, "wrong"),
            "beyond": fraction(counts, "beyond", "judged"),
        }
    )
    each = metrics.rates(found, ["method", "question"])
    for question in found.question.unique():
        kinds = (("misses", "hits", "missed"), ("false_alarms", "clears", "false"))
        own = (
            each[each.question == question]
            .set_index("method")[[c for kind in kinds for c in kind[:2]]]
            .reindex(counts.method, fill_value=0)
        )
        for count, total, name in kinds:
            counts[f"{question}_{count}"], counts[f"{question}_{total}"] = (
                own[count].to_numpy(),
                own[total].to_numpy(),
            )
            text[f"{question} {name}"] = fraction(own, count, total)
    if counts.contained.any():
        text["contained"] = counts.contained.astype(str).to_list()
    numbers = counts[
        [
            "method",
            "asked",
            "answered",
            "wrong",
            "judged",
            "wrong_low",
            "wrong_high",
            "beyond",
            "contained",
            *(c for c in counts if c.startswith(tuple(QUESTIONS))),
        ]
    ]
    caption = _caption(
        f"Lowest share of wrong answers first. {OWN} The tables common-* compare the same cases.",
        counts,
        single,
    )
    return [
        Table(
            "leaderboard",
            "Leaderboard, all questions.",
            caption,
            numbers,
            text,
            False,
            _there(text, "95 %", "contained"),
        )
    ]


def accuracy_table(part: pd.DataFrame, question: str) -> Table:
    counts = metrics.rates(part, ["method"])
    single = outcome.out_of_their_depth(part)
    text = pd.DataFrame(
        {
            "method": marked(counts.method, single),
            "answered": [share(a, n) for a, n in zip(counts.answered, counts.asked)],
            "misses": fraction(counts, "misses", "hits"),
            "95 %": interval(counts, "miss"),
        }
    )
    if question != "overlap":
        text["tunnelled"] = fraction(counts, "tunnelled", "can_tunnel")
    text["false alarms"] = fraction(counts, "false_alarms", "clears")
    text["95 % "] = interval(counts, "alarm")  # the blank keeps the two names apart
    text["wrong"], text["beyond"] = (
        fraction(counts, "wrong", "judged"),
        fraction(counts, "beyond", "judged"),
    )
    if counts.contained.any():
        text["contained"] = counts.contained.astype(str)
    return Table(
        f"accuracy-{question}",
        f"Accuracy, {question}.",
        _caption(OWN, counts, single) + piece_truth.note(part),
        counts,
        text,
        True,
        _there(text, "95 %", "95 % ", "contained", "tunnelled", "wrong"),
    )


def common_table(part: pd.DataFrame, question: str) -> Table:
    """Methods compared on the same cases, fewest wrong answers first."""
    same, left_out = views.common(part)
    counts = metrics.rates(same, ["method"])
    counts = (
        counts.assign(rank=views.ranked(counts)).sort_values("rank", kind="stable")
        if len(counts)
        else counts.assign(rank=[])
    )
    single = outcome.out_of_their_depth(same)
    text = pd.DataFrame(
        {
            "rank": counts["rank"].astype(str),
            "method": marked(counts.method, single),
            "wrong": fraction(counts, "wrong", "judged"),
            "95 %": interval(counts, "wrong"),
            "beyond": fraction(counts, "beyond", "judged"),
            "misses": fraction(counts, "misses", "hits"),
            "false alarms": fraction(counts, "false_alarms", "clears"),
        }
    )
    if len(counts) and counts.contained.any():
        text["contained"] = counts.contained.astype(str)
    caption = (
        f"The {same.case.nunique()} of {part.case.nunique()} cases that all these methods answered;"
        f" fewest wrong answers first. {_left_out(left_out)}"
    )
    return Table(
        f"common-{question}",
        f"Accuracy on common cases, {question}.",
        _caption(caption.strip(), counts, single),
        counts,
        text[["method", *(c for c in text if c != "method")]],
        True,
        _there(text, "95 %", "contained"),
    )


def rank_table(part: pd.DataFrame, question: str) -> Table:
    """The rank on common cases, by band of |gap| / size, and with the same weight for each
    scenario.
    """
    same, _ = views.common(part)
    if same.empty:
        return Table(f"ranks-{question}", "", "", same, pd.DataFrame())
    counts, order = views.by_closeness(same)
    weighted, total = views.by_scenario(same), metrics.rates(same, ["method"])
    numbers = counts[["method", "band", "rank", "wrong", "beyond", "judged"]].merge(
        weighted, on="method"
    )
    text = pivot(counts, "band", lambda r: f"{r.rank} ({r.wrong})", order)
    text = text.merge(
        pd.DataFrame(
            {
                "method": total.method,
                "all": [f"{k} ({w})" for k, w in zip(views.ranked(total), total.wrong)],
            }
        ),
        on="method",
    )
    text = text.merge(
        pd.DataFrame(
            {
                "method": weighted.method,
                "by scenario": [
                    f"{k} ({100 * w:.2g} %)"
                    for k, w in zip(weighted.weighted_rank, weighted.weighted)
                ],
            }
        ),
        on="method",
    )
    sizes = counts.groupby("band").judged.max()
    n = same.scenario.nunique()
    caption = (
        f"Rank (number of wrong answers) on the cases of the table common-{question}, by"
        " clearance or penetration depth over size"
        f" ({', '.join(f'{band}: {sizes[band]} cases' for band in order if band in sizes)}). By"
        f" scenario: rank by the mean share of wrong answers over the {n} scenarios, each of weight"
        f" 1/{n}."
    )
    return Table(f"ranks-{question}", f"Ranks, {question}.", caption, numbers, text.astype(str))


def scenario_table(part: pd.DataFrame, question: str) -> Table:
    counts = metrics.rates(part, ["method", "scenario"])
    return Table(
        f"scenarios-{question}",
        f"Wrong answers by scenario, {question}.",
        "Misses and false alarms of the certified cases answered; - if the method answered none."
        f"{piece_truth.note(part)}",
        counts[
            [
                "method",
                "scenario",
                "misses",
                "false_alarms",
                "beyond",
                "contained",
                "hits",
                "clears",
            ]
        ],
        pivot(counts, "scenario", lambda r: of(r.wrong, r.judged)),
    )


def gap_table(part: pd.DataFrame) -> Table:
    bands, order = views.gap_bands(part.relative_gap)
    counts = metrics.rates(part.assign(band=bands).dropna(subset=["band"]), ["method", "band"])
    return Table(
        "gap-overlap",
        "Wrong answers by signed gap over size, overlap.",
        "Columns left of 0 count misses (overlapping bodies), columns right of 0 count false alarms"
        " (separated bodies).",
        counts[
            ["method", "band", "misses", "false_alarms", "beyond", "contained", "hits", "clears"]
        ],
        pivot(counts, "band", lambda r: of(r.wrong, r.judged), order),
    )


def _there(text: pd.DataFrame, *names: str) -> tuple[str, ...]:
    """Those of the names that are columns."""
    return tuple(name for name in names if name in text)


def _caption(text: str, counts: pd.DataFrame, single: set[str]) -> str:
    contained = f" {CONTAINED}" if len(counts) and counts.contained.any() else ""
    mark = (
        f" {MARK.strip()}: the method computes or stores bodies in single precision, to which some"
        " of its cases are not rounded."
        if single
        else ""
    )
    return f"{text} {BEYOND}{contained}{mark}"


def _left_out(methods: list[str]) -> str:
    if not methods:
        return ""
    return f"Methods that answered less than half of the cases are omitted: {', '.join(methods)}."
