# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The report in a real browser without a screen: it opens, counts as the run does, filters, leads
to cases, and plays them, without an error.
"""

import json
import os
import shutil

import numpy as np
import pandas as pd
import pytest

from experiments.analysis import costs, metrics, outcome
from experiments.cases.families import get
from experiments.cases.label import Truth
from experiments.publish.report import explain, glossary, report
from experiments.run.folder.rows import case_row

CHROMIUM = next(
    filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome", "chrome"))),
    None,
)


def absent(what: str) -> None:
    """Skips these tests, and says why; where a browser was promised (OFG_BROWSER=required, as in
    continuous integration) they fail.
    """
    (pytest.fail if os.environ.get("OFG_BROWSER") == "required" else pytest.skip)(
        f"the report is not tried in a browser: {what}"
    )


@pytest.fixture(scope="module")
def driver():
    try:
        from playwright import sync_api
    except ImportError:
        absent("playwright is not installed (pip install playwright)")
    if CHROMIUM is None:
        absent("no Chromium is here (apt-get install chromium)")
    with sync_api.sync_playwright() as driver:
        yield driver


@pytest.fixture(scope="module")
def browser(driver):
    browser = driver.chromium.launch(
        executable_path=CHROMIUM,
        args=["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
    )
    yield browser
    browser.close()


@pytest.fixture
def open_page(browser):
    """Opens a file; at the end there must have been no error, no warning of the page's own and no
    request to anywhere.
    """
    trouble, pages = [], []

    def opened(path, **options):
        page = browser.new_page(viewport={"width": 1280, "height": 900}, **options)
        page.on("console", lambda m: trouble.append(m.text) if m.type == "error" else None)
        page.on("pageerror", lambda e: trouble.append(str(e)))
        page.on(
            "request",
            lambda r: (
                trouble.append(f"asked for {r.url}")
                if not r.url.startswith(("file:", "blob:", "data:"))
                else None
            ),
        )
        page.set_default_timeout(30_000)
        page.goto(f"file://{path}")
        page.wait_for_selector("html[data-ready]")
        pages.append(page)
        return page

    yield opened
    for page in pages:
        page.close()
    assert trouble == []


@pytest.fixture(scope="module")
def written(run):
    report(run)
    return run.folder / "report.html"


@pytest.fixture(scope="module")
def found(run):
    return outcome.outcomes(run)


def choose(page, question: str) -> None:
    page.click(f"label[for=q-{question}]")


def until(page, condition: str) -> None:
    """Wait for a condition. Playwright's own way evaluates text in the page, which its
    Content-Security-Policy forbids.
    """
    for _ in range(300):
        if page.evaluate(condition):
            return
        page.wait_for_timeout(100)
    raise AssertionError(f"never came true: {condition}")


def board(page) -> pd.DataFrame:
    """The leaderboard as it stands on the page."""
    head, *rows = page.evaluate(
        "[...document.querySelectorAll('#leaderboard tr')].map((r) => [...r.children].map((c) =>"
        " [...c.childNodes].filter((n) => n.nodeName !== 'SMALL').map((n) =>"
        " n.textContent).join('')))"
    )
    return pd.DataFrame(rows, columns=[h.strip(" ↑↓") for h in head]).set_index("Method")


def test_the_glossary_is_embedded(open_page, written):
    page = open_page(written)
    shown = page.evaluate("[...document.querySelectorAll('#terms dt')].map((t) => t.textContent)")
    assert shown == [term for part in glossary.terms() for term, _ in part["terms"]]
    assert "False alarm" in shown and page.locator("nav a[href='#terms']").count() == 1


def test_every_outcome_has_a_badge(open_page, written):
    """The badge of "contained", and of answers wrong within the tolerance, read "undefined": the
    marks had another letter for the one and no capitals for the others.
    """
    page = open_page(written)
    shown = page.evaluate("[...Object.keys(D.codes), 'M', 'F'].map((c) => badge(c).textContent)")
    names = [*page.evaluate("Object.values(D.codes)"), "miss within", "false alarm within"]
    assert not [text for text in shown if "undefined" in text]
    assert all(name in text for name, text in zip(names, shown, strict=True))


def test_the_leaderboard_counts_as_the_run_does(open_page, written, found):
    page = open_page(written)
    for question in ("overlap", "translation", "motion"):
        choose(page, question)
        shown = board(page)
        rates = metrics.rates(found[found.question == question], ["method"]).set_index("method")
        answering = rates[rates.answered > 0]
        assert set(shown.index) == set(answering.index)
        for row in answering.itertuples():
            label = row.Index
            assert shown.loc[label, "Misses"] == (f"{row.misses}/{row.hits}" if row.hits else "–")
            assert shown.loc[label, "False alarms"] == (
                f"{row.false_alarms}/{row.clears}" if row.clears else "–"
            )
            if question != "overlap":
                assert shown.loc[label, "Tunnelled"] == (
                    f"{row.tunnelled}/{row.can_tunnel}" if row.can_tunnel else "–"
                )


def test_intervals_are_those_of_scipy(open_page, written):
    page = open_page(written)
    pairs = [(0, 1), (0, 30), (30, 30), (1, 3), (7, 160), (12, 2000), (1999, 2000)]
    assert np.allclose(
        page.evaluate("(pairs) => pairs.map(([k, n]) => wilson(k, n))", pairs),
        [metrics.wilson(k, n) for k, n in pairs],
        rtol=1e-9,
        atol=1e-12,
    )


def test_times_are_those_of_the_tables(open_page, written, run):
    page, names = (
        open_page(written),
        {
            "question": "question",
            "faces": "sizes",
            "situation": "situation",
        },
    )
    for by in [("question",), ("question", "faces"), ("question", "faces", "situation")]:
        for row in costs.costs(run, by).itertuples():
            link = {names[key]: getattr(row, key) for key in by}
            here = page.evaluate(
                "([label, link]) => cost(D.method.get(label), 'python', casesOf(link))",
                [row.method, link],
            )
            assert np.allclose(
                [here["gross"], here["net"], here["n"]], [row.gross, row.net, row.cases]
            ), (row.method, link)


def test_filters_narrow_every_figure(open_page, written, found):
    page = open_page(written)
    page.select_option("[data-name=Scenario]", "deep")
    until(page, "document.querySelector('.filters .count').textContent.startsWith('3 cases')")
    rates = metrics.rates(found[found.scenario == "deep"], ["method"]).set_index("method")
    assert (
        board(page)["Misses"] == [f"{rates.misses[m]}/{rates.hits[m]}" for m in board(page).index]
    ).all()
    until(
        page,
        "document.querySelector('#plot')?.data?.length > 0 ||"
        " document.querySelector('#plot').hidden",
    )
    page.click(".filters button:text('Reset')")
    until(page, "document.querySelector('#plot')?.data?.length > 0")
    points = page.evaluate(
        "document.querySelector('#plot').data.flatMap((t) => t.customdata || [])"
    )
    assert sorted(points) == sorted(board(page).index)
    page.select_option("[data-name='Vertical axis']", "misses")
    until(page, "document.querySelector('#plot').layout.yaxis.title.text.startsWith('misses')")
    choose(page, "motion")
    until(
        page,
        "document.querySelector('#plot').data.flatMap((t) => t.customdata ||"
        " []).includes('fcl-naive-mesh iterations=10')",
    )


def test_every_cell_by_difficulty_leads_to_its_cases(open_page, written):
    page = open_page(written)
    for question in ("overlap", "motion"):
        choose(page, question)
        cells = page.locator("#pivot td button")
        assert cells.count() >= 7
        for k in range(0, cells.count(), 4):
            text = cells.nth(k).inner_text()
            cells.nth(k).click()
            assert page.evaluate("G.list.length") == int(text.split("/")[0])
            assert page.locator(".card").count() == min(24, int(text.split("/")[0]))


def test_cells_of_saved_tables_lead_where_the_data_say(open_page, written, run, found):
    from experiments.analysis.views import gap_bands
    from experiments.publish.report import payload
    from experiments.publish.report.cells import select
    from experiments.run.bins import situation_of, size_of

    page, checked = open_page(written), 0
    frame = found.assign(
        band=gap_bands(found.relative_gap)[0],
        sizes=size_of(found.faces),
        situation=situation_of(found),
    )
    for table in payload.of_run(run)["tables"]:
        for link in (
            link for row in table["links"] for link in row if link and link.get("kind") != "clocked"
        ):
            there = page.evaluate(
                "(link) => casesOf(link).map((i) => D.cases.case[i])", json.loads(json.dumps(link))
            )
            assert sorted(there) == sorted(select(frame, link).case.unique()), link
            checked += 1
    assert checked > 100


def picture(page) -> str:
    return page.evaluate(
        "(() => { openView.scene().draw(); return"
        " document.querySelector('canvas.stage').toDataURL(); })()"
    )


def test_a_case_opens_plays_and_closes_by_keyboard(open_page, written):
    page = open_page(written)
    choose(page, "translation")
    page.select_option("[data-name=Method]", "ofg k=4")
    card = page.locator(".card").first
    card.focus()
    page.keyboard.press("Enter")
    page.wait_for_selector("#case[data-ready]")
    assert (
        page.evaluate(
            "(() => { const gl = openView.scene().renderer.getContext(), p = new Uint8Array(4 *"
            " gl.drawingBufferWidth * gl.drawingBufferHeight); openView.scene().draw();"
            " gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA,"
            " gl.UNSIGNED_BYTE, p); return p.filter((v, i) => i % 4 === 3 && v > 0).length; })()"
        )
        > 1000
    )
    page.click(".jumps button:text('start')")
    start = picture(page)
    assert "separates them" in page.inner_text(".said")
    page.click(".play")
    until(page, "Number(document.querySelector('.time').value) > 0.05")
    page.click(".play")
    assert picture(page) != start
    page.click(".jumps button:text('impact')")
    assert "inside both bodies" in page.inner_text(".said")
    page.focus("canvas.stage")
    before = picture(page)
    page.keyboard.press("ArrowLeft")
    assert picture(page) != before
    with_selections = picture(page)
    page.uncheck(".toggles label:has-text('OFG') input")
    assert picture(page) != with_selections
    page.keyboard.press("Escape")
    until(page, "!document.querySelector('#case').open")
    assert page.evaluate("document.activeElement.classList.contains('card')")


def test_planes_of_the_page_separate_the_bodies_over_the_certified_time(open_page, written):
    """Of every case that the page can draw: the tightest plane has a clearance at every time up to
    the impact, the point lies in both boxes.
    """
    page = open_page(written)
    worst = page.evaluate("""async () => {
      const found = [];
      for (const i of Object.keys(D.drawn).map(Number)) {
        const g = await geometryOf(i), c = D.cases;
        const until = c.label[i] === "hit" ? c.t_lo[i] : g.moving ? 1 : 0;
        if (!g.proof.clear) continue;
        for (let k = 0; k <= 40; k++) {
          const plane = planeAt(g, g.proof.clear, until * k / 40);
          found.push([c.case[i], plane ? plane.gap / c.size[i] : null]);
        }
      }
      return found;
    }""")
    assert len(worst) > 400
    assert all(gap is not None and gap > -1e-13 for _, gap in worst), [
        w for w in worst if w[1] is None or w[1] <= -1e-13
    ][:3]


def test_dark_and_narrow(open_page, written):
    page = open_page(written, color_scheme="dark")
    shades = []
    for _ in range(2):
        shades.append(page.evaluate("getComputedStyle(document.body).backgroundColor"))
        page.click(".theme")
    assert shades[0] != shades[1]
    page.set_viewport_size({"width": 420, "height": 800})
    until(page, "document.documentElement.scrollWidth <= window.innerWidth")


def test_one_case_from_a_run_and_from_a_file(open_page, run, found, tmp_path):
    missed = found[
        (found.question == "motion") & (found.outcome == "miss") & (found.method == "ofg k=4")
    ].case.iloc[0]
    made = explain.from_run(run, missed)
    explain.save(made, tmp_path / "case.json")
    texts = [explain.page(m, {}) for m in (made, explain.from_file(tmp_path / "case.json"))]
    assert texts[0] == texts[1]
    (tmp_path / "case.html").write_text(texts[0])
    page = open_page(tmp_path / "case.html")
    verdicts = page.evaluate(
        "[...document.querySelectorAll('#verdicts tbody tr')].map((r) =>"
        " [r.children[0].textContent, r.children[1].firstChild.textContent.slice(2)])"
    )
    part = found[(found.case == missed) & ~found.detail.str.startswith("does not answer")]
    assert dict(verdicts) == dict(zip(part.method, part.outcome))
    page.click(".jumps button:text('start')")
    assert "separates them" in page.inner_text(".said")


def test_both_bodies_are_where_their_motions_put_them(open_page, tmp_path):
    """Both turn about points of theirs; the page's poses are Python's, relative to A's start."""
    case = get("both_moving").case(2004, 1.5, 1)
    assert case.tags["turns about"] == "point"
    truth = Truth("clear", start="clear", end="clear")
    said = pd.DataFrame(columns=explain.COLUMNS).astype({"hit": "boolean", "time": float})
    made = explain.Explained(case, truth, case_row(case, truth, 0), said)
    (tmp_path / "case.html").write_text(explain.page(made, {}))
    page = open_page(tmp_path / "case.html")
    q = case.query
    for t in (0.0, 0.3, 1.0):
        seen = page.evaluate(f"geometryOf(0).then((g) => [g.poseA({t}), g.poseB({t})])")
        poses = q.motion.pose_at(q.pose_a, t), q.motion_b.pose_at(q.pose_b, t)
        for js, pose in zip(seen, poses):
            np.testing.assert_allclose(np.reshape(js["R"], (3, 3)), pose.rotation, atol=1e-14)
            np.testing.assert_allclose(js["p"], pose.position - q.pose_a.position, atol=1e-13)
    legend = page.inner_text(".legend")
    assert "A, moving" in legend and "B, moving" in legend
    assert page.inner_text(".facts").count("about its point") == 2
