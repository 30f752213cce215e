// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// The configuration of the run and the machine on which it ran.
function drawRun() {
  const r = D.run,
    before = r.before || {},
    after = r.after || {};
  const noise =
    r.noise === null || r.noise === undefined
      ? "no query times"
      : `90th percentile of the noise probe ${percent(r.noise)} above its median in the worst ` +
        `bin${r.noise > 0.25 ? "; this run was disturbed, and its times are not reliable" : ""}`;
  const facts = [
    ["About", r.about || "–"],
    ["Started, finished (UTC)", `${stamp(r.started)}, ${stamp(r.finished)}`],
    ["Seed", r.config?.seed],
    ["Commit", r.commit],
    [
      "Processor",
      `${before.processor ?? "–"}, ${before.cores ?? "?"} cores, ${before.mhz ?? "?"} MHz`,
    ],
    ["Memory", `${before.memory_gib ?? "?"} GiB`],
    ["System", before.system],
    ["Python", before.python],
    ["Load before, after", `${(before.load || []).join(" ")}; ${(after.load || []).join(" ")}`],
    ["Worker processes", r.workers],
    ["Noise", noise],
  ];
  const list = el(
    "dl",
    { class: "facts" },
    facts.map(([k, v]) => [el("dt", {}, k), el("dd", {}, String(v ?? "–"))]),
  );
  const versions = el(
    "table",
    {},
    el("caption", {}, "Versions"),
    el(
      "tbody",
      {},
      Object.entries(r.versions || {}).map(([k, v]) =>
        el("tr", {}, el("th", { scope: "row", class: "left" }, k), el("td", {}, v || "absent")),
      ),
    ),
  );
  const methods = sortable(
    [
      { title: "Method", left: true, key: (x) => x.label, cell: (x) => x.label },
      {
        title: "Configuration",
        left: true,
        key: (x) => x.configuration,
        cell: (x) => x.configuration,
      },
      {
        title: "Engine",
        left: true,
        key: (x) => x.engine,
        cell: (x) => `${x.engine} ${x.version || ""}`,
      },
      { title: "Answers", left: true, cell: (x) => x.answers.join(", ") },
      { title: "Bodies", left: true, cell: (x) => x.bodies.join(", ") },
      {
        title: "Tests",
        left: true,
        key: (x) => x.solid,
        cell: (x) => (x.solid === null ? "–" : x.solid ? "solids" : "surfaces"),
      },
      { title: "Tolerance", left: true, cell: (x) => x.tolerance },
      {
        title: "Guarantee by its documentation",
        left: true,
        cell: (x) => el("span", { class: "wide" }, x.guarantee),
      },
    ],
    D.methods,
    { caption: "Methods, with the properties that they declare" },
  );
  document
    .getElementById("run-facts")
    .replaceChildren(
      el(
        "div",
        { class: "columns" },
        list,
        el("div", { class: "scroll", tabindex: "0" }, versions),
      ),
      methods,
      el(
        "details",
        {},
        el("summary", {}, "Configuration"),
        el("pre", { tabindex: "0" }, JSON.stringify(r.config, null, 1)),
      ),
    );
}

const stamp = (text) => (text ? text.replace("T", " ").replace(/\+00:00$/, "") : "–");
