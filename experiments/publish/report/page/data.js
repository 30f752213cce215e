// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

"use strict";
// The decoded run: D.cases contains columns, D.outcome one letter per method and case. Every count
// on the page is a count of these letters.
let D, BYTES;

async function inflate(id) {
  const text = atob(document.getElementById(id).textContent.trim());
  const bytes = Uint8Array.from(text, (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}

async function readData() {
  D = JSON.parse(new TextDecoder().decode(await inflate("data")));
  D.n = D.cases.case.length;
  D.place = new Map(D.cases.case.map((c, i) => [c, i]));
  D.method = new Map(D.labels.map((label, m) => [label, m]));
  for (const name of ["time", "error", "detail"])
    D[name] = D[name].map(([at, values]) => new Map(at.map((i, j) => [i, values[j]])));
  D.truth = D.truth.map(
    ([at, labels, tunnels]) =>
      new Map(at.map((i, j) => [i, { label: labels[j], canTunnel: tunnels[j] }])),
  );
  D.canTunnel = Array.from({ length: D.n }, (_, i) => {
    const c = D.cases;
    return (
      c.question[i] !== "overlap" &&
      c.label[i] === "hit" &&
      c.start[i] === "clear" &&
      c.end[i] === "clear"
    );
  });
}

// The truth by which the answer of method m is judged: that of the case, or that of the pieces by
// which the method replaces a mesh.
function truthOf(i, m) {
  return D.truth[m]?.get(i) || { label: D.cases.label[i], canTunnel: D.canTunnel[i] };
}

const libraries = {};
function library(name) {
  libraries[name] ||= inflate(name).then(
    (content) =>
      new Promise((done, fail) => {
        const script = document.createElement("script");
        script.src = URL.createObjectURL(new Blob([content], { type: "text/javascript" }));
        script.onload = done;
        script.onerror = () => fail(new Error(`the browser did not run the embedded ${name}`));
        document.head.append(script);
      }),
  );
  return libraries[name];
}

async function bodyBytes() {
  BYTES ||= inflate("bytes");
  return BYTES;
}

const bodies = new Map();
async function body(index) {
  if (!bodies.has(index)) {
    const bytes = await bodyBytes(),
      b = D.bodies[index];
    const [v, kind, nv] = b.v,
      [f, wide, nf] = b.f;
    const vertices = Float64Array.from(
      new (kind === "f4" ? Float32Array : Float64Array)(bytes, v, 3 * nv),
    );
    const faces = new (wide === "u2" ? Uint16Array : Uint32Array)(bytes, f, 3 * nf);
    bodies.set(index, { ...b, vertices, faces });
  }
  return bodies.get(index);
}

// What a letter counts as.
// Capitals: wrong, but within the tolerance that the method's documentation states.
const MISS = new Set(["m", "M"]),
  ALARM = new Set(["f", "F"]),
  WITHIN = new Set(["M", "F"]),
  JUDGED = new Set(["r", ...MISS, ...ALARM]),
  ANSWERED = new Set([...JUDGED, "i", "b", "n"]),
  LOST = new Set(["u", "e", "t"]);
const KINDS = {
  all: () => true,
  wrong: (x) => MISS.has(x) || ALARM.has(x),
  beyond: (x) => x === "m" || x === "f",
  judged: (x) => JUDGED.has(x),
  "judged hit": (x, i, m) => JUDGED.has(x) && truthOf(i, m).label === "hit",
  asked: (x, i, m) => !(D.details[D.detail[m].get(i)] || "").startsWith("does not answer"),
  "judged clear": (x, i, m) => JUDGED.has(x) && truthOf(i, m).label === "clear",
  "can tunnel": (x, i, m) => ANSWERED.has(x) && truthOf(i, m).canTunnel,
  answered: (x) => ANSWERED.has(x),
  failed: (x) => x === "e" || x === "t",
  tunnelled: (x, i, m) => MISS.has(x) && truthOf(i, m).canTunnel,
  timed: (x, i, m) => D.error[m].has(i),
  late: (x, i, m) => D.error[m].get(i) > 0,
  early: (x, i, m) => D.error[m].get(i) < 0,
  clocked: (x, i, m) => clocked(m).has(i),
  miss: (x) => MISS.has(x),
  "false alarm": (x) => ALARM.has(x),
  within: (x) => WITHIN.has(x),
  contained: (x) => x === "i",
  touching: (x) => x === "b",
  right: (x) => x === "r",
  "no label": (x) => x === "n",
  unsupported: (x) => x === "u",
  error: (x) => x === "e",
  timeout: (x) => x === "t",
};
const KIND_WORDS = {
  all: "all cases",
  asked: "all cases of its questions",
  wrong: "wrong answers",
  judged: "judged",
  "judged hit": "judged hits",
  "judged clear": "judged clear cases",
  answered: "answered",
  failed: "crashed or hung",
  tunnelled: "tunnelled",
  timed: "times of impact",
  late: "late times",
  early: "early times",
  clocked: "with query time",
  miss: "misses",
  "can tunnel": "can tunnel",
  "false alarm": "false alarms",
  beyond: "wrong outside the method's tolerance",
  within: "wrong within the method's tolerance",
  contained: "contained (in no rate)",
  touching: "touching (neither answer is wrong)",
  right: "right",
  "no label": "no certified label",
  unsupported: "unsupported",
  error: "errors",
  timeout: "timeouts",
};

const clockedBy = new Map();
function clocked(m) {
  if (!clockedBy.has(m)) {
    const all = new Set();
    for (const lane of Object.values(D.lanes))
      for (const i of lane[D.labels[m]]?.cases || []) all.add(i);
    clockedBy.set(m, all);
  }
  return clockedBy.get(m);
}

// Cases (indices) behind a link: the same conditions as `select` in cells.py.
function casesOf(link, among) {
  const c = D.cases,
    m = link.method === undefined ? -1 : D.method.get(link.method),
    test = KINDS[link.kind || "all"];
  const wanted = [
    ["question", "question"],
    ["scenario", "scenario"],
    ["level", "level"],
    ["band", "band"],
    ["sizes", "sizes"],
    ["situation", "situation"],
    ["bodies", "kind"],
    ["label", "label"],
  ].filter(([key]) => link[key] !== undefined && link[key] !== "");
  const found = [];
  for (let j = 0, n = among ? among.length : D.n; j < n; j++) {
    const i = among ? among[j] : j;
    if (!wanted.every(([key, column]) => c[column][i] === link[key])) continue;
    if (link.scenarios && !link.scenarios.includes(c.scenario[i])) continue;
    if (link.levels && !link.levels.includes(c.level[i])) continue;
    if (link.tag && !link.tag[1].includes(c.tags[i][link.tag[0]])) continue;
    if (m >= 0) {
      const letter = D.outcome[m][i];
      if (letter === "." || !test(letter, i, m)) continue;
      if (link.detail && !(D.details[D.detail[m].get(i)] || "").startsWith(link.detail)) continue;
    }
    found.push(i);
  }
  return found;
}

// 95 % Wilson score interval of a rate.
function wilson(count, total) {
  if (!total) return [NaN, NaN];
  const z = 1.959963984540054,
    p = count / total,
    d = 1 + (z * z) / total;
  const middle = (p + (z * z) / (2 * total)) / d,
    half = (z / d) * Math.sqrt((p * (1 - p)) / total + (z * z) / (4 * total * total));
  return [count ? Math.max(0, middle - half) : 0, count < total ? Math.min(1, middle + half) : 1];
}

// Counts of one method over cases.
function rates(m, among) {
  const r = {
    asked: 0,
    answered: 0,
    unsupported: 0,
    failed: 0,
    hits: 0,
    misses: 0,
    clears: 0,
    alarms: 0,
    within: 0,
    contained: 0,
    canTunnel: 0,
    tunnelled: 0,
    late: 0,
    timed: 0,
    worstLate: 0,
    worstEarly: 0,
  };
  const letters = D.outcome[m],
    errors = D.error[m],
    list = [];
  for (const i of among) {
    const x = letters[i];
    if (x === ".") continue;
    r.asked++;
    if (x === "u") r.unsupported++;
    else if (LOST.has(x)) r.failed++;
    else {
      r.answered++;
      if (JUDGED.has(x)) truthOf(i, m).label === "hit" ? r.hits++ : r.clears++;
      if (MISS.has(x)) r.misses++;
      else if (ALARM.has(x)) r.alarms++;
      else if (x === "i") r.contained++;
      if (WITHIN.has(x)) r.within++;
      if (truthOf(i, m).canTunnel) {
        r.canTunnel++;
        if (MISS.has(x)) r.tunnelled++;
      }
    }
    const e = errors.get(i);
    if (e !== undefined) {
      r.timed++;
      list.push(Math.abs(e));
      if (e > 0) r.late++;
      r.worstLate = Math.max(r.worstLate, e);
      r.worstEarly = Math.min(r.worstEarly, e);
    }
  }
  r.wrong = r.misses + r.alarms;
  r.beyond = r.wrong - r.within;
  r.judged = r.hits + r.clears;
  r.medianError = median(list);
  return r;
}

// What a scenario exposes, behind a mark; nothing of one that the run does not describe.
function exposed(mark, scenario) {
  const known = D.scenarios[scenario];
  return known ? mark + known.exposes : "";
}

function median(values) {
  if (!values.length) return NaN;
  const s = Float64Array.from(values).sort(),
    h = s.length >> 1;
  return s.length % 2 ? s[h] : (s[h - 1] + s[h]) / 2;
}

// Nanoseconds of one method over the timed cases among these: gross median, its distribution-free
// 95 % interval, floor, net.
function cost(m, lane, among) {
  const timed = D.lanes[lane]?.[D.labels[m]];
  if (!timed) return null;
  if (timed.bins) {
    // the native lane: medians over some of the cases, already net
    const kept = timed.bins
      .filter(
        ([q, s, f]) =>
          q === F.question && (!F.sizes || f === F.sizes) && (!F.situation || s === F.situation),
      )
      .map((b) => b[3]);
    return kept.length
      ? {
          n: kept.length,
          bins: true,
          gross: median(kept),
          net: median(kept),
          low: Math.min(...kept),
          high: Math.max(...kept),
          floor: 0,
        }
      : null;
  }
  const c = D.cases,
    keep = new Set(among),
    ns = [],
    bins = new Set();
  timed.cases.forEach((i, j) => {
    if (!keep.has(i)) return;
    ns.push(timed.ns[j]);
    bins.add(`${c.question[i]}|${c.sizes[i]}|${c.situation[i]}`);
  });
  if (!ns.length) return null;
  const floors = timed.floors.filter(([q, f, s]) => bins.has(`${q}|${f}|${s}`)).map((x) => x[3]);
  const s = ns.slice().sort((a, b) => a - b),
    n = s.length,
    half = 0.98 * Math.sqrt(n);
  const low = s[Math.max(0, Math.floor(n / 2 - half))],
    high = s[Math.min(n - 1, Math.ceil(n / 2 + half) - 1)];
  const gross = median(ns),
    floor = median(floors);
  return { n, gross, low, high, floor, net: Math.max(gross - (floor || 0), 0) };
}
