# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""What the page is given equals what the run holds; every linked cell of a table leads to exactly
the cases it counts; nothing points outside.
"""

import base64
import gzip
import json
import re

import numpy as np
import pytest

from experiments.analysis import outcome, tables, views
from experiments.publish.report import certificate, gallery, page, payload, report, shapes
from experiments.publish.report.cells import links, select
from experiments.run.bins import situation_of, size_of
from experiments.run.folder.rows import cases_of
from experiments.run.timing import FLOOR, LOST, PROBE


@pytest.fixture(scope="module")
def given(run):
    return payload.of_run(run)


@pytest.fixture(scope="module")
def found(run):
    found = outcome.outcomes(run)
    return found.assign(
        band=views.gap_bands(found.relative_gap)[0],
        sizes=size_of(found.faces),
        situation=situation_of(found).where(found.label != "uncertain", "uncertain"),
    )


def test_letters_are_the_outcomes(given, found):
    place = {case: i for i, case in enumerate(given["cases"]["case"])}
    words = given["codes"]
    for label, letters in zip(given["labels"], given["outcome"]):
        part = found[found.method == label]
        assert [words[letters[place[c]].lower()] for c in part.case] == part.outcome.tolist()
        assert [letters[place[c]].isupper() for c in part.case] == part.within.tolist()
        assert len(letters) == len(place) and letters.count(".") == len(place) - len(part)


def test_times_and_errors_are_those_of_the_run(given, found):
    place = {case: i for i, case in enumerate(given["cases"]["case"])}
    for name in ("time", "error"):
        for label, (at, values) in zip(given["labels"], given[name]):
            part = found[(found.method == label) & found[name].notna()]
            assert dict(zip(at, values)) == dict(zip(part.case.map(place), part[name]))


#: kind of a link -> those of its rows that the number before the stroke counts
COUNTED = {
    "judged": lambda rows: rows.outcome.isin(["miss", "false alarm"]),
    "judged hit": lambda rows: rows.outcome == "miss",
    "judged clear": lambda rows: rows.outcome == "false alarm",
    "can tunnel": lambda rows: rows.tunnelled,
    "asked": lambda rows: rows.status == "ok",
}


def counted(text: str) -> int | None:
    """The number that a cell of an accuracy table counts: 3 of '3/40', of '3', of '12/80'; None
    where it is no count.
    """
    match = re.fullmatch(r"(\d+)(?:/\d+)?", text)
    return int(match[1]) if match else None


def test_every_linked_cell_leads_to_the_rows_it_counts(run, found):
    times = run.read("timings.parquet")
    times = times[~times.method.isin([PROBE, LOST]) & (times.case != FLOOR)]
    clocked, checked = set(zip(times.method, times.case)), set()
    for table in tables.build(run):
        for row, row_links in zip(table.text.astype(str).values.tolist(), links(table, found)):
            for column, text, link in zip(table.text.columns, row, row_links):
                if link is None:
                    continue
                rows = select(found, link, clocked)
                number, (_, _, total) = counted(text), text.partition("/")
                kind = link.get("kind", "all")
                if table.name == "truth":
                    assert rows.case.nunique() == number, (table.name, column, text)
                elif text == "all":
                    assert len(rows) == len(select(found, {**link, "kind": "all"}))
                elif kind in COUNTED:
                    assert len(rows) == int(total) and COUNTED[kind](rows).sum() == number, (
                        table.name,
                        column,
                        text,
                    )
                elif kind == "timed":
                    assert len(rows) and (column != "times" or len(rows) == number), (
                        table.name,
                        column,
                        text,
                    )
                elif kind == "clocked":
                    assert len(rows), (table.name, column, text)
                elif column in ("latest", "earliest"):
                    assert len(rows) or text == "0"
                else:
                    assert len(rows) == number, (table.name, column, text)
                checked.add(table.name)
    assert {
        "truth",
        "accuracy-overlap",
        "scenarios-motion",
        "gap-overlap",
        "time-of-impact-motion",
        "cost-overlap-near",
        "by-level",
        "by-form",
        "by-band",
        "walls",
        "by-faces-near",
        "answers",
        "errors",
    } <= checked


def test_bodies_come_back_bit_for_bit(run, given):
    bodies, done = given["bodies"], 0
    rows = run.read("cases.parquet")
    for i, (case, _) in enumerate(cases_of(rows, run.read("bodies.parquet"))):
        for index, body in zip(given["drawn"][i], (case.query.a, case.query.b)):
            entry = bodies[index]
            for (start, kind, count), array in (
                (entry["v"], body.vertices),
                (entry["f"], body.faces),
            ):
                assert np.array_equal(
                    np.frombuffer(given["bytes"], "<" + kind, 3 * count, start).reshape(-1, 3),
                    array,
                )
            done += 1
    assert done == 2 * len(rows)
    assert len({(b["v"][0], b["f"][0]) for b in bodies}) == len(bodies)


def test_a_full_page_leaves_bodies_out_and_the_gallery_comes_first(run, monkeypatch):
    monkeypatch.setattr(payload, "BYTES", 3000)
    made = payload.of_run(run)
    assert 0 < len(made["drawn"]) < len(made["cases"]["case"]) and len(made["bytes"]) <= 3000
    wanted = gallery.gallery(outcome.outcomes(run))
    assert made["cases"]["case"][next(iter(made["drawn"]))] in wanted


def test_planes_cover_the_time_that_the_certificate_is_for(run):
    seen = set()
    for case, truth in cases_of(run.read("cases.parquet"), run.read("bodies.parquet")):
        made = certificate.drawable(truth.certificate)
        if "clear" not in made:
            continue
        convex = case.query.a.kind == case.query.b.kind == "convex"
        until = (
            0.0
            if case.query.question == "overlap"
            else 1.0
            if truth.label == "clear"
            else truth.t_lo
        )
        leaves = made["clear"]["leaves"]
        assert max(leaf[1] for leaf in leaves) == until and min(leaf[0] for leaf in leaves) == 0.0
        if convex:
            assert [leaf[0] for leaf in leaves[1:]] == [leaf[1] for leaf in leaves[:-1]]
        seen.add((case.query.question, convex))
    assert {("overlap", True), ("overlap", False), ("translation", True), ("motion", True)} <= seen


def test_planes_separate_the_elements_they_are_for(run):
    """At the start, where both frames of a plane agree, in doubles."""
    seen = 0
    for case, truth in cases_of(run.read("cases.parquet"), run.read("bodies.parquet")):
        q, proof = case.query, certificate.drawable(truth.certificate).get("clear")
        for s, _, _, *n, a0, a1, b0, b1 in proof["leaves"] if proof else ():
            if s > 0:
                continue
            points = []
            for body, pose, key, lo, hi in (
                (q.a, q.pose_a, "order_a", a0, a1),
                (q.b, q.pose_b, "order_b", b0, b1),
            ):
                elements = (
                    [body.vertices[f] for f in body.faces]
                    if body.kind == "mesh"
                    else [p.vertices for p in body.pieces]
                )
                order = proof.get(key, range(len(elements)))[slice(lo, hi)]
                points.append(
                    np.concatenate([elements[i] for i in order]) @ pose.rotation.T
                    + (pose.position - q.pose_a.position)
                )
            assert (points[1] @ n).min() > (points[0] @ n).max() - 1e-9 * q.a.size, case.id
            seen += 1
    assert seen > 10


def test_the_page_names_no_network_holds_the_data_and_is_the_same_when_made_again(run, given):
    report(run)
    text = (run.folder / "report.html").read_text()
    assert (
        not re.search(r"""\b(?:src|href|action|poster|data)\s*=\s*["']?\s*(?:https?:)?//""", text)
        and "@import" not in text
        and "url(http" not in text
    )
    assert "default-src 'none'" in text
    block = re.search(r'<script type="application/octet-stream" id="data">([^<]*)</script>', text)[
        1
    ]
    assert json.loads(gzip.decompress(base64.b64decode(block))) == json.loads(
        json.dumps(payload._plain({k: v for k, v in given.items() if k != "bytes"}))
    )
    assert page.page(given, f"{given['run']['title']}: collision detection, certified") == text


def test_what_the_page_says_of_ofg_is_what_the_run_observed(run, given):
    said = (
        run.read("observations.parquet").query("status == 'ok'").set_index(["case", "method"]).hit
    )
    pairs = [
        (given["cases"]["case"][place], label, x["hit"])
        for place, overlays in given["ofg"].items()
        for label, x in overlays.items()
    ]
    assert len(pairs) > 30 and {hit for *_, hit in pairs} == {True, False}
    assert [hit for *_, hit in pairs] == [said[case, label] for case, label, _ in pairs]


def test_a_large_selection_is_counted_and_not_drawn(run, given, monkeypatch):
    monkeypatch.setattr(shapes, "SELECTED", 5)
    made = payload.of_run(run)["ofg"]
    sizes = set()
    for place, overlays in given["ofg"].items():
        for label, x in overlays.items():
            for side in "ab":
                assert made[place][label][f"n{side}"] == x[f"n{side}"] == len(x[side])
                assert made[place][label][side] == (x[side] if len(x[side]) <= 5 else [])
                sizes.add(len(x[side]) <= 5)
    assert sizes == {True, False}
