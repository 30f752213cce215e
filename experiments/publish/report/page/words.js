// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// The text about one case: its properties, its certificate, OFG's selections and all answers.

// How OFG found its hit: answer.found.
const FOUND_WORDS = {
  start: "faces that intersect at the start",
  end: "faces that intersect at the end",
  "edge-face": "a virtual edge of A intersects a face of B",
  "face-edge": "a virtual edge of B intersects a face of A",
  "edge-edge": "a moving edge meets an edge",
  inside: "one body lies inside the other",
};
const moves = (i, side) =>
  Boolean(norm(D.cases[`displacement${side}`][i]) || D.cases[`angle${side}`][i]);

// The motion of one body in words; side: "" for A, "_b" for B.
function motionWords(i, side) {
  const of = (name) => D.cases[`${name}${side}`][i],
    d = norm(of("displacement")),
    about = of("about");
  if (!moves(i, side)) return "at rest";
  const turn = of("angle")
    ? `rotates by ${number(of("angle"))} ` +
      `rad${norm(about) ? ` about its point (${about.map((x) => number(x)).join(", ")})` : ""}`
    : "";
  return [d ? `translates by ${number(d)}` : "", turn].filter(Boolean).join(", ");
}

function facts(i) {
  const c = D.cases,
    sweep = c.question[i] !== "overlap",
    hit = c.label[i] === "hit",
    drawn = D.drawn[i];
  const bodyWords = (k) => {
    const b = D.bodies[drawn[k]];
    return (
      `${b.name}, ${b.kind}${b.pieces ? ` of ${b.pieces.length} pieces` : ""}, ` +
      `${plural(b.f[2], "face")}${b.rounded ? " (drawn rounded to float32)" : ""}`
    );
  };
  const rows = [
    [
      D.run.refused ? `Stated, not certified (${D.run.refused})` : "Certified",
      el("b", { class: `label ${c.label[i]}` }, c.label[i]),
      c.touching[i] ? ", touching: the bodies share boundary points only" : "",
      c.reason[i] ? ` (${c.reason[i]})` : "",
      sweep && hit ? ` · start ${c.start[i]}, end ${c.end[i]}` : "",
    ],
    sweep && hit && c.t_lo[i] !== null
      ? [
          "Time of impact",
          c.t_lo[i] === c.t_hi[i]
            ? `${c.t_hi[i]} (exact to double precision)`
            : `[${c.t_lo[i]}, ${c.t_hi[i]}]`,
        ]
      : null,
    c.gap[i] === null
      ? null
      : [
          c.gap[i] > 0 ? "Clearance at least" : c.gap[i] < 0 ? "Penetration depth about" : "Gap",
          `${number(Math.abs(c.gap[i]))} (${number(Math.abs(c.relative[i]))} of the size)`,
        ],
    ["Difficulty", `${D.scenarios[c.scenario[i]]?.axis || "level"}: ${number(c.level[i], 6)}`],
    ["A", drawn ? bodyWords(0) : "–"],
    ["B", drawn ? bodyWords(1) : "–"],
    sweep ? ["A's motion", motionWords(i, "")] : null,
    sweep ? ["B's motion", motionWords(i, "_b")] : null,
    [
      "Tags",
      Object.entries(c.tags[i])
        .map(([k, v]) => `${k}: ${typeof v === "number" ? number(v) : v}`)
        .join(", ") || "–",
    ],
  ].filter(Boolean);
  return el(
    "div",
    {},
    el("h2", { class: "case-name" }, c.case[i]),
    el("p", { class: "note" }, `${c.question[i]}${exposed(" · ", c.scenario[i])}`),
    el(
      "dl",
      { class: "facts" },
      rows.map(([k, ...v]) => [el("dt", {}, k), el("dd", {}, v)]),
    ),
  );
}

function planeWords(g, plane) {
  const frame = { A: "rotating with A", B: "rotating with B" }[plane.frame] || "fixed in space";
  const parts = g.a.kind === "union" || g.b.kind === "union" ? "pieces" : "faces";
  const many = plane.count > 1;
  return (
    "Certified: " +
    (many ? `${plane.count} planes separate groups of ${parts} at this time. ` : "") +
    (many ? "The plane with the least clearance is shown" : "this plane separates them") +
    ` (${frame}). Its clearance in double precision is ${number(plane.gap)}.`
  );
}

function proofWords(i, g, { plane, point }, t) {
  const c = D.cases,
    many =
      D.proofs[i]?.clear && !D.proofs[i].clear.leaves
        ? ` Its ${D.proofs[i].clear.planes.toLocaleString("en")} planes are too many to show.`
        : "";
  if (c.label[i] === "uncertain") return `No certificate: ${c.reason[i]}`;
  if (D.run.refused) return `Stated, not certified: ${D.run.refused}.`;
  if (point) return "Certified: the marked point lies inside both bodies at this time.";
  if (plane) return planeWords(g, plane);
  if (c.label[i] === "hit" && t > (c.t_lo[i] ?? 0))
    return t < c.t_hi[i]
      ? "This time lies inside the certified bracket of the time of impact."
      : "This time is after the impact; the certificate applies to the time of impact only.";
  return `Certified clear.${many}`;
}

function timeMarks(i, label, method) {
  const c = D.cases,
    marks = [];
  if (c.label[i] === "hit" && c.t_hi[i] !== null)
    marks.push([c.t_hi[i], "truth", "certified time of impact"]);
  for (const [l, kind] of [
    [method, "told"],
    [label, "told"],
  ]) {
    const m = D.method.get(l),
      t = m === undefined ? undefined : D.time[m].get(i);
    if (t !== undefined && !marks.some(([x, , w]) => w === l)) marks.push([t, kind, l]);
  }
  return marks.map(([t, kind, words]) =>
    el("i", { class: kind, style: `left:${100 * t}%`, title: `${words}: ${t}` }),
  );
}

function ofgWords(i, label, x) {
  if (!x) return "";
  const c = D.cases,
    moving = c.question[i] !== "overlap",
    sa = D.bodies[x.bodies[0]],
    sb = D.bodies[x.bodies[1]],
    lines = [];
  const of = (n, b, piece) =>
    `${n} of the ${b.pieces && piece >= 0 ? b.pieces[piece][1] : b.f[2]} faces`;
  lines.push(
    `OFG selected ${of(x.na, sa, x.pieces[0])} of ` +
      `A${sa.pieces ? ` (piece ${x.pieces[0] + 1} of ${sa.pieces.length})` : ""} and ` +
      `${of(x.nb, sb, x.pieces[1])} of ` +
      `B${sb.pieces ? ` (piece ${x.pieces[1] + 1} of ${sb.pieces.length})` : ""}` +
      (x.parts > 1
        ? `, in the part of the step from ${number(x.window[0])} to ${number(x.window[1])} ` +
          `(one of ${x.parts})`
        : "") +
      (moving
        ? {
            1: ", at the start",
            2: ", at the start and at the end",
            3: ", at the start, at the end and where the centres are closest",
          }[x.selections]
        : "") +
      ".",
  );
  if (x.bodies.some((b, k) => b !== D.drawn[i][k]))
    lines.push(
      "Its query contained CoACD's pieces of the mesh, which differ from the mesh near its " +
        "surface.",
    );
  const m = D.method.get(label),
    letter = D.outcome[m]?.[i],
    truth = truthOf(i, m).label,
    hit = truth === "hit";
  if (
    (letter === "r" || MISS.has(letter) || ALARM.has(letter)) &&
    x.hit !== (letter === "r" ? hit : ALARM.has(letter))
  )
    lines.push("The version of OFG that made this page gives a different answer from the run's.");
  if (x.hit) {
    lines.push(
      `It answered hit${x.time !== null ? ` at t = ${number(x.time, 8)}` : ""}: ` +
        `${FOUND_WORDS[x.found] || x.found}` +
        `${x.met ? ` (face ${x.met[0]} of A, face ${x.met[1]} of B)` : ""}.`,
    );
    if (truth === "clear")
      lines.push(
        c.touching[i]
          ? "The certificate proves that the bodies share boundary points only."
          : "The certificate proves that the bodies do not overlap.",
      );
  } else if (truth === "hit") {
    lines.push(
      x.stopped
        ? `It answered clear before it tested any faces: ${x.stopped}.`
        : "It answered clear.",
    );
    if (x.should) {
      const [pa, pb] = x.should.places,
        taken = ["a", "b"].map((s, k) =>
          x[s].length
            ? x[s].includes(x.should.faces[k])
            : x.should.places[k] !== null && x.should.places[k] <= x[`n${s}`],
        );
      const place = (p, is, side) =>
        p === null
          ? `the face of ${side} belongs to a piece that was not tested`
          : `the face of ${side} is the ${ordinal(p)} nearest and was ` +
            `${is ? "selected" : "not selected"}`;
      const when = moving ? ` at t = ${number(x.should.time, 6)}` : "";
      lines.push(
        `Face ${x.should.faces[0]} of A and face ${x.should.faces[1]} of B intersect${when}; ` +
          `${place(pa, taken[0], "A")}, and ${place(pb, taken[1], "B")}.`,
      );
      if (taken[0] && taken[1] && moving && !x.stopped)
        lines.push(
          "Both were selected, but they do not intersect at the start, at the end or along the " +
            `virtual edges (straight paths of the vertices of A${x.vertices_b ? " and B" : ""}). ` +
            "As in the article, collisions of moving edges and curved paths are not tested.",
        );
    } else
      lines.push(
        "No faces intersect" +
          (moving ? " at the time of impact or soon after" : "") +
          ": one body lies inside the other, or the overlap is smaller than the rounding error.",
      );
  } else lines.push("It answered clear.");
  return el(
    "div",
    {},
    lines.map((l) => el("p", {}, l)),
  );
}

function ordinal(n) {
  const teen = n % 100 > 10 && n % 100 < 14;
  const ending = teen ? "th" : ["th", "st", "nd", "rd"][n % 10] || "th";
  return `${n.toLocaleString("en")}${ending}`;
}

function ofPieces(i, m) {
  const own = D.truth[m].get(i);
  return own ? el("small", {}, `judged by the CoACD pieces of the mesh: ${own.label}`) : "";
}

function verdicts(i, method) {
  const rows = D.labels
    .map((label, m) => ({
      m,
      label,
      letter: D.outcome[m][i],
      time: D.time[m].get(i),
      error: D.error[m].get(i),
      detail: D.details[D.detail[m].get(i)] || "",
    }))
    .filter((r) => r.letter !== "." && !r.detail.startsWith("does not answer"));
  const sweep = D.cases.question[i] !== "overlap",
    rank = { m: 0, f: 1, e: 2, t: 3, i: 4, b: 5, r: 6, n: 7, u: 8 };
  const silent = D.labels.length - rows.length;
  return el(
    "div",
    {},
    el("h3", {}, "Answers of all methods"),
    sortable(
      [
        {
          title: "Method",
          left: true,
          key: (r) => r.label,
          cell: (r) => (r.label === method ? el("b", {}, r.label) : r.label),
        },
        {
          title: "Outcome",
          left: true,
          key: (r) => rank[r.letter.toLowerCase()],
          cell: (r) => [
            badge(r.letter),
            r.detail ? el("small", {}, r.detail) : "",
            ofPieces(i, r.m),
          ],
        },
        sweep && {
          title: "Time",
          key: (r) => r.time,
          cell: (r) => (r.time === undefined ? "–" : number(r.time, 6)),
        },
        sweep && {
          title: "Error",
          note: "outside the certified bracket, as a share of the step; late is positive",
          key: (r) => r.error,
          cell: (r) =>
            r.error === undefined
              ? "–"
              : r.error === 0
                ? "0"
                : (r.error > 0 ? "+" : "") + number(r.error, 2),
        },
      ].filter(Boolean),
      rows,
      { start: 1, id: "verdicts", caption: "" },
    ),
    silent
      ? el(
          "p",
          { class: "note" },
          `${plural(silent, "further method")} of the run ${silent === 1 ? "does" : "do"} not ` +
            `answer ${D.cases.question[i]} queries.`,
        )
      : "",
  );
}
