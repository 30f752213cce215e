// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// The filter of the cases for the whole page; every view that shows counts registers as a listener.
const F = {
  question: "",
  sizes: "",
  situation: "",
  bodies: "",
  band: "",
  scenario: "",
  shared: "",
  lane: "",
};
// Methods that answer a smaller share of the cases do not restrict the common cases: views.LEAST.
const LEAST = 0.5;
const listeners = [];
let subset = [];

function refilter(changes = {}) {
  Object.assign(F, changes);
  const there = (column, value) =>
    D.cases[column].some((v, i) => v === value && D.cases.question[i] === F.question);
  for (const [key, column] of [
    ["situation", "situation"],
    ["scenario", "scenario"],
    ["sizes", "sizes"],
    ["band", "band"],
    ["bodies", "kind"],
  ])
    if (F[key] && !there(column, F[key])) F[key] = "";
  subset = casesOf({
    question: F.question,
    sizes: F.sizes,
    situation: F.situation,
    bodies: F.bodies,
    band: F.band,
    scenario: F.scenario,
  });
  if (F.shared) subset = shared(subset);
  drawFilters();
  for (const listen of listeners) listen();
}

// The cases answered by every method that answers at least half of them.
function shared(among) {
  const answers = (m, i) => ANSWERED.has(D.outcome[m][i]);
  const asked = D.labels
    .map((_, m) => m)
    .filter((m) => among.filter((i) => answers(m, i)).length >= LEAST * among.length);
  return among.filter((i) => asked.every((m) => answers(m, i)));
}

function values(column) {
  const found = new Set();
  D.cases[column].forEach((v, i) => {
    if (v !== null && D.cases.question[i] === F.question) found.add(v);
  });
  return found;
}

function drawFilters() {
  const bar = document.getElementById("filters"),
    any = [["", "all"]];
  const focus = document.activeElement?.dataset?.name;
  const ordered = (names, column) => {
    const there = values(column);
    return any.concat(names.filter((n) => there.has(n)).map((n) => [n, n]));
  };
  const questions = [...new Set(D.cases.question)];
  bar.replaceChildren(
    ...[
      el(
        "fieldset",
        { class: "segments" },
        el("legend", { class: "hidden" }, "Question"),
        questions.map((q) => {
          const input = el("input", {
            type: "radio",
            name: "question",
            id: `q-${q}`,
            checked: q === F.question,
            onchange: () => {
              refilter({ question: q });
              document.getElementById(`q-${q}`).focus();
            },
          });
          return [input, el("label", { for: `q-${q}` }, q)];
        }),
      ),
      select("Faces", ordered(D.sizes, "sizes"), F.sizes, (v) => refilter({ sizes: v })),
      select(
        "Situation",
        ordered(["deep", "near", "apart", "hit", "clear", "uncertain"], "situation"),
        F.situation,
        (v) => refilter({ situation: v }),
      ),
      select("Bodies", ordered(["convex", "union", "mesh"], "kind"), F.bodies, (v) =>
        refilter({ bodies: v }),
      ),
      select("Gap / size", ordered(D.bands, "band"), F.band, (v) => refilter({ band: v })),
      select(
        "Scenario",
        ordered(
          Object.keys(D.scenarios).concat(
            [...new Set(D.cases.scenario)].filter((s) => !D.scenarios[s]),
          ),
          "scenario",
        ),
        F.scenario,
        (v) => refilter({ scenario: v }),
      ),
      D.labels.length > 1
        ? select(
            "Cases",
            [
              ["", "all"],
              ["common", "common"],
            ],
            F.shared,
            (v) => refilter({ shared: v }),
          )
        : null,
      Object.keys(D.lanes).length > 1
        ? select("Times from", Object.keys(D.lanes), F.lane, (v) => refilter({ lane: v }))
        : null,
      el(
        "span",
        { class: "count", role: "status" },
        `${plural(subset.length, "case")}` + uncertainWords(),
      ),
      F.sizes || F.situation || F.bodies || F.band || F.scenario || F.shared
        ? el(
            "button",
            {
              type: "button",
              onclick: () =>
                refilter({
                  sizes: "",
                  situation: "",
                  bodies: "",
                  band: "",
                  scenario: "",
                  shared: "",
                }),
            },
            "Reset",
          )
        : null,
    ].filter(Boolean),
  );
  if (focus) bar.querySelector(`[data-name="${focus}"]`)?.focus();
}

function uncertainWords() {
  const n = subset.filter((i) => D.cases.label[i] === "uncertain").length;
  const touching = subset.filter((i) => D.cases.touching[i]).length;
  return (
    (n ? `, ${n} uncertain (in no rate)` : "") +
    (touching ? `, ${touching} touching (in no rate)` : "")
  );
}
