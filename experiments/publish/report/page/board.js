// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// The leaderboard: every method that answers any of the filtered cases.
function drawBoard() {
  const rows = [],
    silent = [];
  D.labels.forEach((label, m) => {
    const r = rates(m, subset);
    if (!r.answered) {
      silent.push(label);
      return;
    }
    rows.push({
      m,
      label,
      about: D.methods[m],
      r,
      cost: cost(m, F.lane, subset),
      all: r.answered === r.asked,
    });
  });
  const place = {
    question: F.question,
    sizes: F.sizes,
    situation: F.situation,
    bodies: F.bodies,
    band: F.band,
    scenario: F.scenario,
  };
  const count = (row, n, total, kind, title) =>
    total
      ? [
          link({ ...place, method: row.label, kind }, share(n, total), title),
          el("small", {}, interval(wilson(n, total))),
        ]
      : "–";
  const rate = (n, total) => (total ? n / total : NaN);
  const sweep = F.question !== "overlap",
    timing = Object.keys(D.lanes).length;
  const columns = [
    {
      title: "Method",
      left: true,
      key: (x) => x.label,
      cell: (x) => [
        el("span", {
          class: "dot",
          style: `--dot:${engineColour(x.about.engine)}`,
          "aria-hidden": "true",
        }),
        x.label,
        el(
          "small",
          {},
          `${x.about.configuration}${x.about.solid === false ? " · surfaces only" : ""}`,
        ),
      ],
    },
    {
      title: "Wrong",
      note: "misses and false alarms, of the certified cases answered; 95 % Wilson interval",
      key: (x) => rate(x.r.wrong, x.r.judged),
      cell: (x) => [
        bar(rate(x.r.wrong, x.r.judged), wilson(x.r.wrong, x.r.judged)),
        count(x, x.r.wrong, x.r.judged, "wrong"),
      ],
    },
    {
      title: "Misses",
      note: "certified hits answered clear (false negatives), of the certified hits answered",
      key: (x) => rate(x.r.misses, x.r.hits),
      cell: (x) => count(x, x.r.misses, x.r.hits, "miss"),
    },
    {
      title: "False alarms",
      note: "certified clear cases answered hit (false positives), of those answered",
      key: (x) => rate(x.r.alarms, x.r.clears),
      cell: (x) => count(x, x.r.alarms, x.r.clears, "false alarm"),
    },
    {
      title: "Beyond",
      note: "wrong answers outside the method's documented tolerance",
      key: (x) => rate(x.r.beyond, x.r.judged),
      cell: (x) => count(x, x.r.beyond, x.r.judged, "beyond"),
    },
    {
      title: "Contained",
      note:
        "hits of a body inside another whose surfaces do not meet; a test of surfaces cannot " +
        "detect them, and they enter no rate",
      key: (x) => x.r.contained,
      cell: (x) =>
        x.r.contained
          ? link({ ...place, method: x.label, kind: "contained" }, String(x.r.contained))
          : "0",
    },
    sweep && {
      title: "Tunnelled",
      note: "misses of hit sweeps that start and end clear",
      key: (x) => rate(x.r.tunnelled, x.r.canTunnel),
      cell: (x) => count(x, x.r.tunnelled, x.r.canTunnel, "tunnelled"),
    },
    sweep && {
      title: "Time error",
      note:
        "median and largest late error of the time of impact outside its certified bracket, as " +
        "a share of the step",
      key: (x) => x.r.medianError,
      cell: (x) =>
        x.r.timed
          ? [
              link({ ...place, method: x.label, kind: "timed" }, number(x.r.medianError, 2)),
              el(
                "small",
                {},
                x.r.worstLate
                  ? [
                      `latest `,
                      link({ ...place, method: x.label, kind: "late" }, number(x.r.worstLate, 2)),
                    ]
                  : "never late",
              ),
            ]
          : "–",
    },
    {
      title: "Answered",
      key: (x) => rate(x.r.answered, x.r.asked),
      cell: (x) => [
        link(
          { ...place, method: x.label, kind: "answered" },
          x.all ? "all" : share(x.r.answered, x.r.asked),
        ),
        x.r.failed
          ? el(
              "small",
              {},
              link({ ...place, method: x.label, kind: "failed" }, `${x.r.failed} crashed or hung`),
            )
          : "",
      ],
    },
    timing && {
      title: "Time, µs",
      note:
        "net (gross): median over the timed cases, with a distribution-free 95 % interval of " +
        "gross; net is gross less the method's floor",
      key: (x) => x.cost?.net,
      cell: (x) =>
        x.cost?.bins
          ? [microseconds(x.cost.net), el("small", {}, `native, ${plural(x.cost.n, "bin")}`)]
          : x.cost
            ? [
                link(
                  { ...place, method: x.label, kind: "clocked" },
                  `${microseconds(x.cost.net)} (${microseconds(x.cost.gross)})`,
                ),
                el(
                  "small",
                  {},
                  `${microseconds(x.cost.low)}–${microseconds(x.cost.high)} · ` +
                    `${plural(x.cost.n, "case")}`,
                ),
              ]
            : "–",
    },
  ].filter(Boolean);
  document.getElementById("board-table").replaceChildren(
    sortable(columns, rows, {
      start: 1,
      id: "leaderboard",
      caption: `Leaderboard, ${F.question}`,
    }),
    silent.length
      ? el(
          "p",
          { class: "note" },
          `${plural(silent.length, "method")} of the run answered none of these cases: ` +
            `${silent.join(", ")}.`,
        )
      : "",
  );
}

// A rate as a bar, with its interval as a whisker.
function bar(rate, [low, high]) {
  return el(
    "span",
    {
      class: "bar",
      "aria-hidden": "true",
      style: `--rate:${100 * rate}%;--low:${100 * low}%;--high:${100 * high}%`,
    },
    el("i"),
    el("b"),
  );
}

const link = (to, text, title) =>
  el(
    "button",
    {
      type: "button",
      class: "link",
      title: title || "show these cases",
      onclick: () => openCases(to),
    },
    text,
  );

// A colour for each engine.
const PALETTE = Array.from({ length: 10 }, (_, i) => `var(--c${i})`);
function engineColour(engine) {
  const engines = [...new Set(D.methods.map((m) => m.engine))];
  return PALETTE[engines.indexOf(engine) % PALETTE.length];
}
