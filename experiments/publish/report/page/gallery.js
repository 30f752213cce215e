// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// The gallery: the misses, false alarms and late times of one method, or the cases of any cell of
// the page.
const PAGE = 24;
const G = { method: "", kind: "", more: {}, shown: PAGE, list: [] };
const GALLERY_KINDS = [
  "miss",
  "tunnelled",
  "false alarm",
  "late",
  "early",
  "beyond",
  "within",
  "contained",
  "touching",
  "failed",
  "wrong",
  "right",
  "all",
];

function openCases(to) {
  const questions = new Set(casesOf(to).map((i) => D.cases.question[i]));
  if (!to.question && questions.size === 1) to = { ...to, question: [...questions][0] };
  if (to.question && to.question !== F.question)
    refilter({
      question: to.question,
      sizes: "",
      situation: "",
      bodies: "",
      shared: "",
      band: "",
      scenario: "",
    });
  const { method = "", kind = "all", ...more } = to;
  Object.assign(G, {
    method,
    kind,
    more: Object.fromEntries(Object.entries(more).filter(([, v]) => v !== "")),
    shown: PAGE,
    fixed: true,
  });
  drawGallery();
  document.getElementById("cases").scrollIntoView({
    behavior: matchMedia("(prefers-reduced-motion: reduce)").matches ? "auto" : "smooth",
  });
  document.querySelector("#gallery h3")?.focus({ preventScroll: true });
}

function drawGallery() {
  if (!G.fixed) G.more = Object.fromEntries(Object.entries(here()).filter(([, v]) => v));
  const answering = D.labels.filter((l, m) => subset.some((i) => ANSWERED.has(D.outcome[m][i])));
  const counts = (label) =>
    Object.fromEntries(
      GALLERY_KINDS.map((k) => [k, casesOf({ ...G.more, method: label, kind: k }).length]),
    );
  if (!G.fixed && (!G.method || !answering.includes(G.method)))
    G.method =
      answering.find((l) => casesOf({ ...G.more, method: l, kind: "wrong" }).length) ||
      answering[0] ||
      "";
  const found = G.method ? counts(G.method) : {};
  if (!G.fixed && !(found[G.kind] > 0)) G.kind = GALLERY_KINDS.find((k) => found[k]) || "all";
  const link = { ...G.more, kind: G.kind };
  if (G.method) link.method = G.method;
  G.list = casesOf(link);
  if (G.kind === "late" || G.kind === "early") {
    const e = D.error[D.method.get(G.method)];
    G.list.sort((a, b) => Math.abs(e.get(b)) - Math.abs(e.get(a)));
  } else G.list = spread(G.list);
  const change = (changes) => {
    Object.assign(G, { shown: PAGE }, changes);
    drawGallery();
  };
  const labels = G.method && !answering.includes(G.method) ? [G.method, ...answering] : answering;
  const chips = Object.entries(G.more)
    .filter(([k]) => k !== "question")
    .map(([k, v]) =>
      el(
        "button",
        {
          type: "button",
          class: "chip",
          title: "remove this condition",
          onclick: () => {
            const more = { ...G.more };
            delete more[k];
            change({ more, fixed: true });
          },
        },
        `${{ sizes: "faces", band: "gap / size", tag: "" }[k] ?? k} ` +
          `${k === "tag" ? `${v[0]}: ${v[1].join(", ")}` : Array.isArray(v) ? v.join(", ") : v} ` +
          "×",
      ),
    );
  const box = document.getElementById("gallery"),
    focus = document.activeElement?.dataset?.name;
  box.replaceChildren(
    ...[
      el(
        "div",
        { class: "controls" },
        select("Method", [["", "all"], ...labels.map((l) => [l, l])], G.method, (v) =>
          change({ method: v, kind: v ? G.kind : "all" }),
        ),
        G.method
          ? el(
              "fieldset",
              { class: "segments" },
              el("legend", { class: "hidden" }, "Kind"),
              GALLERY_KINDS.filter((k) => found[k] || k === G.kind).map((k) => {
                const input = el("input", {
                  type: "radio",
                  name: "kind",
                  id: `kind-${k.replace(" ", "-")}`,
                  checked: k === G.kind,
                  onchange: () => {
                    change({ kind: k });
                    document.getElementById(input.id)?.focus();
                  },
                });
                return [input, el("label", { for: input.id }, `${KIND_WORDS[k]} ${found[k]}`)];
              }),
            )
          : null,
        chips,
        G.fixed
          ? el(
              "button",
              { type: "button", onclick: () => change({ fixed: false }) },
              "Back to the filter above",
            )
          : null,
      ),
      el(
        "h3",
        { tabindex: "-1" },
        `${plural(G.list.length, "case")}: ` +
          `${[G.method, KIND_WORDS[G.kind], G.more.question].filter(Boolean).join(" · ")}`,
      ),
      el("ol", { class: "cards" }, G.list.slice(0, G.shown).map(card)),
      G.list.length > G.shown
        ? el(
            "p",
            {},
            el(
              "button",
              {
                type: "button",
                class: "more",
                onclick: () => {
                  const at = G.shown;
                  G.shown += PAGE;
                  drawGallery();
                  box.querySelectorAll(".card")[at]?.focus();
                },
              },
              `Show ${Math.min(PAGE, G.list.length - G.shown)} more of ` +
                `${(G.list.length - G.shown).toLocaleString("en")}`,
            ),
          )
        : null,
      undrawn()
        ? el(
            "p",
            { class: "note" },
            `The bodies of ${plural(undrawn(), "case")} are not included. This file contains ` +
              "those of up to 24 cases of each kind for each method, and of further cases while " +
              "there is room; ofg-bench explain shows every case.",
          )
        : null,
    ].filter(Boolean),
  );
  if (focus) box.querySelector(`[data-name="${focus}"]`)?.focus();
  thumbnails(box);
}

const undrawn = () => G.list.filter((i) => !D.drawn[i]).length;

// Takes one case of each scenario and level in turn, so that the first cards differ.
function spread(list) {
  const turn = new Map(),
    c = D.cases;
  const keyed = list.map((i) => {
    const k = `${c.scenario[i]}/${c.level[i]}`,
      n = turn.get(k) || 0;
    turn.set(k, n + 1);
    return [n, i];
  });
  return keyed.sort((a, b) => a[0] - b[0] || a[1] - b[1]).map(([, i]) => i);
}

function card(i) {
  const c = D.cases,
    m = D.method.get(G.method),
    letter = m === undefined ? "" : D.outcome[m][i];
  const error = m === undefined ? undefined : D.error[m].get(i);
  return el(
    "li",
    {},
    el(
      "button",
      {
        type: "button",
        class: "card",
        "data-case": i,
        onclick: () => {
          location.hash = caseLink(c.case[i]);
        },
      },
      D.drawn[i]
        ? el("canvas", { width: "300", height: "190", "aria-hidden": "true" })
        : el("span", { class: "no-picture" }, "bodies not included"),
      el("span", { class: "card-name" }, c.case[i]),
      el(
        "span",
        { class: "card-words" },
        letter ? badge(letter) : el("b", { class: `label ${c.label[i]}` }, c.label[i]),
        " ",
        error > 0
          ? `${number(error, 2)} late`
          : error < 0
            ? `${number(-error, 2)} early`
            : c.relative[i] === null
              ? ""
              : `${c.label[i] === "hit" ? "depth" : "gap"} ${number(Math.abs(c.relative[i]), 2)}`,
      ),
    ),
  );
}

// The part of the address that identifies an open case.
function caseLink(name) {
  const method = G.method ? `&method=${encodeURIComponent(G.method)}` : "";
  return `case=${encodeURIComponent(name)}${method}`;
}

// One hidden scene draws the pictures one after another, visible ones first.
let painter = null,
  queue = [],
  painting = false;
function thumbnails(box) {
  const watch = new IntersectionObserver(
    (entries) => {
      for (const e of entries)
        if (e.isIntersecting) {
          watch.unobserve(e.target);
          queue.push(e.target);
        }
      paint();
    },
    { rootMargin: "300px" },
  );
  queue = [];
  for (const canvas of box.querySelectorAll("canvas")) watch.observe(canvas);
}

async function paint() {
  if (painting || !queue.length) return;
  painting = true;
  try {
    await library("three");
    painter ||= new BodyScene(document.createElement("canvas"), true);
    painter.recolour();
    while (queue.length) {
      const canvas = queue.shift(),
        i = Number(canvas.parentElement.dataset.case);
      if (!canvas.isConnected) continue;
      const g = await geometryOf(i),
        x = D.ofg[i]?.[G.method];
      await painter.show(g, x ? (x.hit ? { ...x, should: null } : x) : null);
      painter.t = D.cases.t_hi[i] ?? 0;
      painter.resize(300, 190, 1);
      painter.time(D.cases.t_hi[i] ?? (g.moving ? 0.5 : 0));
      painter.aim();
      canvas.getContext("2d").drawImage(painter.renderer.domElement, 0, 0, 300, 190);
      await new Promise((next) => setTimeout(next));
    }
  } catch (error) {
    for (const canvas of queue)
      canvas.replaceWith(el("span", { class: "no-picture" }, "3D is not available"));
    queue = [];
  } finally {
    painting = false;
  }
  if (queue.length) paint();
}

function dialog() {
  const close = () => box.close();
  const box = el(
    "dialog",
    { id: "case", "aria-label": "One case", tabindex: "-1", autofocus: true },
    el(
      "div",
      { class: "dialog-bar" },
      el("button", { type: "button", onclick: () => step(-1) }, "← Previous"),
      el("button", { type: "button", onclick: () => step(1) }, "Next →"),
      el("span", { id: "case-place", class: "note" }),
      el("button", { type: "button", class: "close", onclick: close }, "Close"),
    ),
    el("div", { id: "case-content" }),
  );
  box.addEventListener("close", () => {
    openView?.close();
    openView = null;
    document.getElementById("case-content").replaceChildren();
    const at = document.querySelector(`.card[data-case="${box.dataset.case}"]`);
    history.replaceState(null, "", location.pathname + location.search + "#cases");
    at?.focus();
  });
  box.addEventListener("click", (e) => {
    if (e.target === box) close();
  });
  return box;
}

function step(by) {
  const at = G.list.indexOf(Number(document.getElementById("case").dataset.case)),
    next = G.list[at + by];
  if (at >= 0 && next !== undefined) {
    history.replaceState(null, "", `#${caseLink(D.cases.case[next])}`);
    showCase(next, G.method || undefined);
  }
}

async function showCase(i, method) {
  if (i === undefined) return;
  const box = document.getElementById("case"),
    at = G.list.indexOf(i);
  box.dataset.case = i;
  delete box.dataset.ready;
  document.getElementById("case-place").textContent =
    at >= 0 ? `${at + 1} of ${G.list.length}` : "";
  if (!box.open) box.showModal();
  openView?.close();
  openView = await caseView(document.getElementById("case-content"), i, method);
  box.dataset.ready = "yes";
}
