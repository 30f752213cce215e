// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Counts by method and one property of the cases, with intervals; each cell links to its cases.
let across = "scenario",
  what = "wrong";
const WHAT = {
  wrong: { words: "wrong answers", of: (r) => [r.wrong, r.judged] },
  miss: { words: "misses", of: (r) => [r.misses, r.hits] },
  "false alarm": { words: "false alarms", of: (r) => [r.alarms, r.clears] },
  tunnelled: { words: "tunnelled", of: (r) => [r.tunnelled, r.canTunnel] },
  beyond: { words: "wrong outside the method's tolerance", of: (r) => [r.beyond, r.judged] },
  late: { words: "late times", of: (r) => [r.late, r.timed] },
  answered: { words: "answered", of: (r) => [r.answered, r.asked], good: true },
};

function pivotColumns() {
  const c = D.cases,
    groups = new Map();
  const key = (i) => (across.startsWith("tag:") ? c.tags[i][across.slice(4)] : c[across][i]);
  for (const i of subset) {
    const k = key(i);
    if (k === null || k === undefined) continue;
    if (!groups.has(k)) groups.set(k, []);
    groups.get(k).push(i);
  }
  const order = { sizes: D.sizes, band: D.bands }[across];
  const names = [...groups.keys()];
  if (order) names.sort((a, b) => order.indexOf(a) - order.indexOf(b));
  return names.map((name) => ({
    name,
    cases: groups.get(name),
    link: across.startsWith("tag:") ? { tag: [across.slice(4), [name]] } : { [across]: name },
  }));
}

function drawPivot() {
  const tags = new Set(
    subset.flatMap((i) =>
      Object.entries(D.cases.tags[i])
        .filter(([, v]) => typeof v === "string")
        .map(([k]) => k),
    ),
  );
  const options = [
    ["scenario", "scenario"],
    ["band", "signed gap / size"],
    ["sizes", "faces"],
    ["situation", "situation"],
  ];
  if (F.scenario) options.splice(1, 0, ["level", D.scenarios[F.scenario]?.axis || "level"]);
  for (const t of [...tags].sort()) options.push([`tag:${t}`, t]);
  if (!options.some(([v]) => v === across)) across = "scenario";
  const kinds = Object.entries(WHAT)
    .filter(([k]) => F.question !== "overlap" || !["tunnelled", "late"].includes(k))
    .map(([k, v]) => [k, v.words]);
  if (!kinds.some(([k]) => k === what)) what = "wrong";
  document.getElementById("pivot-controls").replaceChildren(
    select("Count", kinds, what, (v) => {
      what = v;
      drawPivot();
    }),
    select("By", options, across, (v) => {
      across = v;
      drawPivot();
    }),
  );
  const groups = pivotColumns(),
    rows = [];
  D.labels.forEach((label, m) => {
    const r = rates(m, subset);
    if (r.answered) rows.push({ m, label, cells: groups.map((g) => rates(m, g.cases)) });
  });
  const columns = [
    { title: "Method", left: true, key: (x) => x.label, cell: (x) => x.label },
  ].concat(
    groups.map((g, k) => ({
      title: across === "level" ? number(g.name, 4) : String(g.name),
      note: `${plural(g.cases.length, "case")}${exposed(": ", g.name)}`,
      key: (x) => {
        const [n, total] = WHAT[what].of(x.cells[k]);
        return total ? n / total : NaN;
      },
      cell: (x) => {
        const [n, total] = WHAT[what].of(x.cells[k]);
        if (!total) return "–";
        const heat = el(
          "span",
          { class: WHAT[what].good ? "" : "heat", style: `--heat:${n / total}` },
          link({ ...here(), ...g.link, method: x.label, kind: what }, share(n, total)),
          el("small", {}, interval(wilson(n, total))),
        );
        return heat;
      },
    })),
  );
  const table = document.getElementById("pivot-table");
  table.replaceChildren(
    sortable(columns, rows, { id: "pivot", caption: `${WHAT[what].words}, ${F.question}` }),
  );
  if (what === "answered" || what === "late") return;
  table.append(
    el(
      "p",
      { class: "note" },
      "Each cell gives a count, its total and the 95 % Wilson interval of the rate. Darker cells " +
        "have higher rates.",
    ),
  );
}
