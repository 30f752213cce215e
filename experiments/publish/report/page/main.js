// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Builds the page.
const section = (id, title, intro, ...content) =>
  el(
    "section",
    { id, "aria-labelledby": `${id}-title` },
    el("h2", { id: `${id}-title` }, title),
    intro ? el("p", { class: "intro" }, intro) : "",
    content,
  );

function head() {
  const c = D.cases,
    uncertain = c.label.filter((l) => l === "uncertain").length,
    r = D.run;
  const tiles = [
    [
      (D.n - uncertain).toLocaleString("en"),
      "certified cases" + (uncertain ? `, ${uncertain} uncertain` : ""),
    ],
    [D.labels.length, "methods and configurations"],
    [new Set(c.scenario).size, "scenarios"],
    [(D.n * D.labels.length).toLocaleString("en"), "pairs of case and method"],
    [
      r.noise === null ? "–" : percent(r.noise),
      r.noise > 0.25 ? "timing noise: disturbed" : "timing noise",
    ],
  ];
  return el(
    "header",
    { class: "top" },
    el(
      "div",
      { class: "bar-top" },
      el("strong", {}, "ofg-bench"),
      el(
        "nav",
        { "aria-label": "Sections" },
        [
          ["board", "Leaderboard"],
          ["speed", "Accuracy and speed"],
          ["by", "By difficulty"],
          ["cases", "Gallery"],
          ["tables", "Tables"],
          ["run", "About this run"],
          ["terms", "Glossary"],
        ].map(([id, t]) => el("a", { href: `#${id}` }, t)),
      ),
      themeButton(),
    ),
    el("h1", {}, r.title),
    el("p", { class: "intro" }, r.about),
    el(
      "p",
      { class: "intro" },
      "Every label is certified: its proof is stored with the case and was checked by a program " +
        "that is independent of all engines. A ",
      el("b", {}, "miss"),
      " (false negative) is a certified hit answered clear; a ",
      el("b", {}, "false alarm"),
      " (false positive) is a certified clear case answered hit. Click on a figure to see its " +
        "cases. The ",
      el("a", { href: "#terms" }, "glossary"),
      " defines all terms.",
    ),
    el(
      "ul",
      { class: "tiles" },
      tiles.map(([n, t]) => el("li", {}, el("b", {}, String(n)), el("span", {}, t))),
    ),
  );
}

function themeButton() {
  return el(
    "button",
    {
      type: "button",
      class: "theme",
      title: "light or dark",
      "aria-label": "switch between light and dark",
      onclick: () => {
        const dark =
          (document.documentElement.dataset.theme ||
            (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light")) === "dark";
        document.documentElement.dataset.theme = dark ? "light" : "dark";
        recolour();
      },
    },
    "◐",
  );
}

function recolour() {
  if (D.mode === "run") {
    drawPlot();
    drawGallery();
  }
  openView?.recolour();
}

function runPage() {
  const app = document.getElementById("app");
  app.replaceChildren(
    head(),
    el("div", {
      id: "filters",
      class: "filters",
      role: "group",
      "aria-label": "Filter of the cases",
    }),
    el(
      "main",
      { id: "main" },
      section(
        "board",
        "Leaderboard",
        "Each method is judged on the certified cases that it answered. Methods that answered " +
          "different cases are not strictly comparable: see “Answered”. Click on a column head " +
          "to sort.",
        el("div", { id: "board-table" }),
      ),
      section(
        "speed",
        "Accuracy and speed",
        "",
        el("div", { id: "plot-controls", class: "controls" }),
        el("div", { id: "plot" }),
        el("p", { id: "plot-words", class: "note" }),
      ),
      section(
        "by",
        "By difficulty",
        "Pooled rates hide differences between cases. This table splits the counts by one " +
          "property of the cases.",
        el("div", { id: "pivot-controls", class: "controls" }),
        el("div", { id: "pivot-table" }),
      ),
      section("cases", "Gallery", "", el("div", { id: "gallery" })),
      section(
        "tables",
        "Tables of the run",
        "The tables in the run's folder tables/ (CSV, Markdown, LaTeX). They cover all cases; " +
          "the filter above does not apply. Rates have 95 % Wilson intervals.",
        el("div", { id: "saved" }),
      ),
      section("run", "About this run", "", el("div", { id: "run-facts" })),
      section("terms", "Glossary", "", glossary()),
    ),
    dialog(),
  );
  F.question = D.cases.question[0];
  F.lane = Object.keys(D.lanes)[0] || "";
  listeners.push(drawBoard, drawPlot, drawPivot, () => drawGallery());
  refilter();
  drawTables();
  drawRun();
  addEventListener("hashchange", follow);
  follow();
}

function follow() {
  const match = location.hash.match(/^#case=([^&]+)(?:&method=(.*))?$/);
  if (match)
    showCase(
      D.place.get(decodeURIComponent(match[1])),
      match[2] ? decodeURIComponent(match[2]) : undefined,
    );
}

async function casePage() {
  const app = document.getElementById("app"),
    main = el("main", { id: "main", class: "single" });
  app.replaceChildren(
    el(
      "header",
      { class: "top" },
      el("div", { class: "bar-top" }, el("strong", {}, "ofg-bench explain"), themeButton()),
    ),
    main,
  );
  openView = await caseView(main, 0);
}

readData()
  .then(async () => {
    await (D.mode === "run" ? runPage() : casePage());
    document.getElementById("app").removeAttribute("aria-busy");
    document.documentElement.dataset.ready = "yes";
  })
  .catch((error) => {
    document
      .getElementById("app")
      .replaceChildren(
        el(
          "p",
          { class: "notice" },
          `This page could not be displayed: ${error.message}. It needs a browser from 2023 or ` +
            "later (DecompressionStream, WebGL).",
        ),
      );
    throw error;
  });
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => D && recolour());
