// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Accuracy versus speed: a curve per method over its parameter, with a colour per engine and a
// symbol per method.
const MEASURES = {
  "wrong answers": { of: (r) => [r.wrong, r.judged], kind: "wrong" },
  misses: { of: (r) => [r.misses, r.hits], kind: "miss" },
  "false alarms": { of: (r) => [r.alarms, r.clears], kind: "false alarm" },
  tunnelled: { of: (r) => [r.tunnelled, r.canTunnel], kind: "tunnelled" },
};
const SYMBOLS = [
  "circle",
  "square",
  "diamond",
  "triangle-up",
  "triangle-down",
  "pentagon",
  "x",
  "star",
  "hexagon",
  "cross",
];
const GRAIN = 50; // ns: shorter times are below the clock's resolution and are drawn at this value
let measure = "wrong answers",
  clockSide = "net";

// Linear up to 1 %, then logarithmic, so that 0 can be drawn.
const squash = (rate) => Math.asinh(100 * rate);
const colour = (name) =>
  getComputedStyle(document.documentElement).getPropertyValue(name.slice(4, -1)).trim();

function drawPlotControls() {
  document.getElementById("plot-controls").replaceChildren(
    select(
      "Vertical axis",
      Object.keys(MEASURES).filter((k) => k !== "tunnelled" || F.question !== "overlap"),
      measure,
      (v) => {
        measure = v;
        drawPlot();
      },
    ),
    select(
      "Horizontal axis",
      [
        ["net", "net time (less the floor)"],
        ["gross", "gross time"],
      ],
      clockSide,
      (v) => {
        clockSide = v;
        drawPlot();
      },
    ),
  );
}

async function drawPlot() {
  if (F.question === "overlap" && measure === "tunnelled") measure = "wrong answers";
  drawPlotControls();
  const box = document.getElementById("plot"),
    families = new Map();
  D.labels.forEach((label, m) => {
    const r = rates(m, subset),
      [count, total] = MEASURES[measure].of(r),
      c = cost(m, F.lane, subset);
    if (!total || !c) return;
    const name = D.methods[m].name,
      curve = D.methods[m].curve;
    if (!families.has(curve)) families.set(curve, []);
    families.get(curve).push({
      name,
      m,
      label,
      short: label.split(" ").slice(1).join(" "),
      count,
      total,
      rate: count / total,
      ci: wilson(count, total),
      us: Math.max(c[clockSide], GRAIN) / 1e3,
      cost: c,
      whole: r.answered === r.asked,
      r,
    });
  });
  const words = document.getElementById("plot-words");
  if (!families.size) {
    box.hidden = true;
    words.textContent = Object.keys(D.lanes).length
      ? "No method has both a rate and a time for these cases, since only some cases are timed. " +
        "Widen the filter."
      : "This run has no query times.";
    return;
  }
  box.hidden = false;
  await library("plotly");
  const ink = colour("var(--ink)"),
    grid = colour("var(--line)"),
    seen = {},
    traces = [],
    all = [...families.values()].flat(),
    placed = placeLabels(all, box.clientWidth);
  for (const points of families.values()) {
    const name = points[0].name,
      engine = D.methods[points[0].m].engine,
      shade = colour(engineColour(engine)),
      known = (seen[engine] ||= []);
    const first = !known.includes(name);
    if (first) known.push(name);
    const symbol = SYMBOLS[known.indexOf(name) % SYMBOLS.length];
    traces.push({
      type: "scatter",
      mode: points.length > 1 ? "lines+markers+text" : "markers+text",
      name,
      legendgroup: name,
      showlegend: first,
      x: points.map((p) => p.us),
      y: points.map((p) => squash(p.rate)),
      customdata: points.map((p) => p.label),
      line: { color: shade, width: 1.2 },
      marker: {
        symbol: points.map((p) => symbol + (p.whole ? "" : "-open")),
        size: 9,
        color: shade,
        line: { color: shade, width: 1.5 },
      },
      text: points.map((p) => (placed.has(p) ? p.short : "")),
      cliponaxis: false,
      textposition: points.map((p) => placed.get(p) || "top right"),
      textfont: { size: 10, color: ink },
      error_y: {
        type: "data",
        symmetric: false,
        array: points.map((p) => squash(p.ci[1]) - squash(p.rate)),
        arrayminus: points.map((p) => squash(p.rate) - squash(p.ci[0])),
        color: shade,
        thickness: 0.8,
        width: 2,
      },
      hovertext: points.map(
        (p) =>
          `<b>${p.label}</b><br>${measure} ${p.count}/${p.total} (${interval(p.ci)})<br>net ` +
          `${microseconds(p.cost.net)} µs, gross ${microseconds(p.cost.gross)} µs over ` +
          `${p.cost.n} ` +
          `${p.cost.bins ? "bins of the native benchmark" : "cases"}<br>` +
          (p.whole ? "answered all of these cases" : `answered ${p.r.answered} of ${p.r.asked}`),
      ),
      hoverinfo: "text",
    });
  }
  const front = pareto(all.filter((p) => p.whole));
  if (front.length)
    traces.unshift({
      type: "scatter",
      mode: "lines",
      name: "Pareto front",
      x: front.map((p) => p.us),
      y: front.map((p) => squash(p.rate)),
      line: { color: grid, width: 7, shape: "hv" },
      hoverinfo: "skip",
    });
  const across10 = [-2, -1, 0, 1, 2, 3, 4, 5, 6]
    .flatMap((e) => [1, 2, 5].map((d) => +(d * 10 ** e).toPrecision(1)))
    .filter((x) => x >= GRAIN / 1e3);
  const ticks = [0, 0.003, 0.01, 0.03, 0.1, 0.3, 1];
  const layout = {
    height: 560,
    margin: { l: 62, r: 12, t: 10, b: 52 },
    paper_bgcolor: "rgba(0,0,0,0)",
    plot_bgcolor: "rgba(0,0,0,0)",
    font: { family: "system-ui, sans-serif", color: ink, size: 12 },
    xaxis: {
      type: "log",
      title: { text: `${clockSide} time per query, µs` },
      gridcolor: grid,
      zeroline: false,
      tickvals: across10,
      ticktext: across10.map((x) => (x <= GRAIN / 1e3 ? `≤ ${x}` : String(x))),
    },
    yaxis: {
      title: { text: `${measure}, % of certified cases` },
      range: [squash(-0.0012), squash(1.3)],
      tickvals: ticks.map(squash),
      ticktext: ticks.map((t) => String(+(100 * t).toPrecision(2))),
      gridcolor: grid,
      zeroline: false,
    },
    legend: { font: { size: 11 }, itemsizing: "constant" },
    hoverlabel: { align: "left" },
    hovermode: "closest",
    modebar: { bgcolor: "rgba(0,0,0,0)", color: grid, activecolor: ink },
  };
  await Plotly.react(box, traces, layout, {
    displaylogo: false,
    responsive: true,
    modeBarButtonsToRemove: ["lasso2d", "select2d", "autoScale2d"],
    toImageButtonOptions: { format: "svg", filename: `accuracy-speed-${F.question}` },
  });
  if (!box.dataset.listens) {
    box.dataset.listens = "yes";
    box.on("plotly_click", ({ points: [p] }) => {
      if (p?.customdata)
        openCases({ ...here(), method: p.customdata, kind: MEASURES[measure].kind });
    });
  }
  words.textContent =
    (F.lane === "native"
      ? "Native times are those of the libraries in one C++ loop (ofg-bench native), on some of " +
        "this run's cases; rates are over all of them. "
      : "") +
    `${plural(all.length, "configuration")} with a rate and a time on these cases. A hollow ` +
    "point marks a method that answered only some of them and is not on the Pareto front; " +
    "select common cases above to compare all methods. A time of ≤ 0.05 µs is not " +
    "distinguishable from the method's floor. Whiskers: 95 % Wilson intervals. Labels that " +
    "would overlap are omitted. Click on a point to see its cases.";
}

// Places each label at a corner of its point where it overlaps no other label or point, as far as
// is known before drawing. A label without such a corner is shown only when the pointer is on its
// point.
function placeLabels(points, width) {
  const xs = points.map((p) => Math.log10(p.us)),
    low = Math.min(...xs),
    scale = (0.7 * width) / Math.max(Math.max(...xs) - low, 0.5);
  const spot = (p) => [(Math.log10(p.us) - low) * scale, (-squash(p.rate) * 490) / squash(1.3)];
  const taken = points.map((p) => [p, spot(p).flatMap((v) => [v - 4, v + 4])]),
    placed = new Map();
  for (const p of points.filter((p) => p.short)) {
    const [x, y] = spot(p),
      long = 6 * p.short.length;
    for (const corner of ["top right", "top left", "bottom right", "bottom left"]) {
      const [x0, y0] = [
        corner.endsWith("right") ? x + 5 : x - 5 - long,
        corner.startsWith("top") ? y - 15 : y + 4,
      ];
      const [x1, y1] = [x0 + long, y0 + 11];
      if (
        taken.some(([q, [a0, a1, b0, b1]]) => q !== p && x0 < a1 && a0 < x1 && y0 < b1 && b0 < y1)
      )
        continue;
      placed.set(p, corner);
      taken.push([null, [x0, x1, y0, y1]]);
      break;
    }
  }
  return placed;
}

const here = () => ({
  question: F.question,
  sizes: F.sizes,
  situation: F.situation,
  bodies: F.bodies,
  band: F.band,
  scenario: F.scenario,
});

function pareto(points) {
  const front = [];
  for (const p of points.slice().sort((a, b) => a.us - b.us || a.rate - b.rate))
    if (!front.length || p.rate < front.at(-1).rate) front.push(p);
  return front;
}
