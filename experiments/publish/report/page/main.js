// Puts the page together.
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
    [(D.n * D.labels.length).toLocaleString("en"), "questions asked"],
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
          ["run", "What was run"],
        ].map(([id, t]) => el("a", { href: `#${id}` }, t)),
      ),
      themeButton(),
    ),
    el("h1", {}, r.title),
    el("p", { class: "intro" }, r.about),
    el(
      "p",
      { class: "intro" },
      "Every label is certified: a proof of each answer is stored with its case and was " +
        "checked by a program that knows no engine. A ",
      el("b", {}, "miss"),
      " is a certified hit answered clear, a ",
      el("b", {}, "false alarm"),
      " a certified clear answered hit. Every figure below opens the cases behind it.",
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
      "aria-label": "Which cases the figures are of",
    }),
    el(
      "main",
      { id: "main" },
      section(
        "board",
        "Leaderboard",
        "Over the certified cases that a method answered. Sort by any column; methods that " +
          "answer different cases are not strictly comparable: see “Answered”.",
        el("div", { id: "board-table" }),
      ),
      section(
        "speed",
        "Accuracy against speed",
        "",
        el("div", { id: "plot-controls", class: "controls" }),
        el("div", { id: "plot" }),
        el("p", { id: "plot-words", class: "note" }),
      ),
      section(
        "by",
        "By difficulty",
        "A pooled rate hides all that matters: the same counts split by one property of the cases.",
        el("div", { id: "pivot-controls", class: "controls" }),
        el("div", { id: "pivot-table" }),
      ),
      section("cases", "Gallery", "", el("div", { id: "gallery" })),
      section(
        "tables",
        "Tables of the run",
        "As saved in its folder tables/ (CSV, Markdown, LaTeX), over all cases whatever the " +
          "filter above; rates with 95 % Wilson intervals.",
        el("div", { id: "saved" }),
      ),
      section("run", "What was run", "", el("div", { id: "run-facts" })),
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
          `This page could not be drawn: ${error.message}. It needs a browser of 2023 or ` +
            "later (DecompressionStream, WebGL).",
        ),
      );
    throw error;
  });
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => D && recolour());
