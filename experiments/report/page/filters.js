// One choice of cases for the whole page; who shows figures listens.
const F = { question: "", sizes: "", situation: "", band: "", scenario: "", lane: "" };
const listeners = [];
let subset = [];

function refilter(changes = {}) {
  Object.assign(F, changes);
  const there = (column, value) => D.cases[column].some((v, i) => v === value && D.cases.question[i] === F.question);
  for (const [key, column] of [
    ["situation", "situation"],
    ["scenario", "scenario"],
    ["sizes", "sizes"],
    ["band", "band"],
  ])
    if (F[key] && !there(column, F[key])) F[key] = "";
  subset = casesOf({ question: F.question, sizes: F.sizes, situation: F.situation, band: F.band, scenario: F.scenario });
  drawFilters();
  for (const listen of listeners) listen();
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
      select("Situation", ordered(["deep", "near", "apart", "hit", "clear", "uncertain"], "situation"), F.situation, (v) =>
        refilter({ situation: v }),
      ),
      select("Gap / size", ordered(D.bands, "band"), F.band, (v) => refilter({ band: v })),
      select(
        "Scenario",
        ordered(Object.keys(D.scenarios).concat([...new Set(D.cases.scenario)].filter((s) => !D.scenarios[s])), "scenario"),
        F.scenario,
        (v) => refilter({ scenario: v }),
      ),
      Object.keys(D.lanes).length > 1 ? select("Times from", Object.keys(D.lanes), F.lane, (v) => refilter({ lane: v })) : null,
      el("span", { class: "count", role: "status" }, `${plural(subset.length, "case")}` + uncertainWords()),
      F.sizes || F.situation || F.band || F.scenario
        ? el("button", { type: "button", onclick: () => refilter({ sizes: "", situation: "", band: "", scenario: "" }) }, "Clear")
        : null,
    ].filter(Boolean),
  );
  if (focus) bar.querySelector(`[data-name="${focus}"]`)?.focus();
}

function uncertainWords() {
  const n = subset.filter((i) => D.cases.label[i] === "uncertain").length;
  const touching = subset.filter((i) => D.cases.touching[i]).length;
  return (n ? `, ${n} without a certified label (in no rate)` : "") + (touching ? `, ${touching} touching (in no rate)` : "");
}
