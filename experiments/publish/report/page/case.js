// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// One case: its bodies in motion, its certificate, all answers and OFG's selections.
let openView = null;

async function caseView(root, i, method) {
  const c = D.cases,
    moving = c.question[i] !== "overlap",
    drawable = Boolean(D.drawn[i]),
    labels = Object.keys(D.ofg[i] || {});
  const view = {
    overlay: labels.includes(method) ? method : labels[0] || "",
    t: moving ? (c.t_hi[i] ?? D.time[D.method.get(method)]?.get(i) ?? 0.5) : 0,
  };
  const canvas = el("canvas", {
    tabindex: "0",
    class: "stage",
    "aria-label":
      "The two bodies in 3D. The arrow keys rotate, plus and minus zoom, and 0 shows both bodies.",
  });
  const said = el("p", { class: "said", role: "status" }),
    legend = el("ul", { class: "legend" }),
    ofgBox = el("div", { class: "ofg" });
  const slider = el("input", {
    type: "range",
    min: "0",
    max: "1",
    step: "0.001",
    value: String(view.t),
    "aria-label": "time in the step",
    class: "time",
    oninput: () => go(Number(slider.value)),
  });
  const clock = el("output", { class: "clock" }),
    marks = el("div", { class: "marks", "aria-hidden": "true" });
  const play = el("button", { type: "button", class: "play", onclick: () => run() }, "▶ Play");
  const jump = (t, text) =>
    t === null || t === undefined
      ? null
      : el("button", { type: "button", onclick: () => go(t) }, text);
  const check = (name, text) =>
    el(
      "label",
      {},
      el("input", {
        type: "checkbox",
        checked: true,
        onchange: (e) => {
          scene.options[name] = e.target.checked;
          scene.build();
          go(view.t);
        },
      }),
      " " + text,
    );
  const stage = drawable
    ? el(
        "div",
        { class: "stage-box" },
        canvas,
        el(
          "div",
          { class: "stage-tools" },
          ["all", "a", "b", "contact"].map((w) =>
            el(
              "button",
              { type: "button", onclick: () => scene.aim(w) },
              { all: "All", a: "A", b: "B", contact: "Contact" }[w],
            ),
          ),
        ),
      )
    : el(
        "div",
        { class: "stage-box none" },
        el(
          "p",
          {},
          "The bodies of this case are not included, to keep this file small. To write a page " +
            "with them:",
        ),
        el("code", {}, `ofg-bench explain ${c.case[i]} --run ${D.run.name || "RUN"}`),
      );
  const time =
    moving && drawable
      ? el(
          "div",
          { class: "timeline" },
          play,
          el("div", { class: "track" }, marks, slider),
          clock,
          el(
            "div",
            { class: "jumps" },
            jump(0, "start"),
            c.label[i] === "hit" && c.start[i] === "clear" ? jump(c.t_lo[i], "last clear") : null,
            c.label[i] === "hit" ? jump(c.t_hi[i], "impact") : null,
            D.time[D.method.get(method)]?.has(i)
              ? jump(D.time[D.method.get(method)].get(i), `time of ${method}`)
              : null,
            jump(1, "end"),
          ),
        )
      : null;
  const toggles = drawable
    ? el(
        "div",
        { class: "toggles" },
        check("plane", "certificate"),
        check("seeThrough", "transparent"),
        moving ? check("ghosts", "start and end") : null,
        labels.length ? check("selections", "OFG's selections") : null,
      )
    : null;
  root.replaceChildren(
    el(
      "div",
      { class: "case" },
      el("div", { class: "left" }, stage, time, toggles, legend, said),
      el("div", { class: "right" }, facts(i), ofgBox, verdicts(i, method)),
    ),
  );
  let scene = null,
    g = null,
    timer = 0;

  function go(t) {
    view.t = t;
    slider.value = String(t);
    clock.textContent = `t = ${t.toFixed(t > 0 && t < 1e-3 ? 6 : 4)}`;
    if (scene) said.textContent = proofWords(i, g, scene.time(moving ? t : 0), t);
  }
  function run() {
    if (timer) {
      cancelAnimationFrame(timer);
      timer = 0;
      play.textContent = "▶ Play";
      return;
    }
    play.textContent = "❚❚ Pause";
    let last = 0,
      t = view.t >= 1 ? 0 : view.t;
    const frame = (now) => {
      t += last ? Math.min(now - last, 60) / 4000 : 0;
      last = now;
      go(Math.min(t, 1));
      if (t >= 1) {
        timer = 0;
        play.textContent = "▶ Play";
      } else timer = requestAnimationFrame(frame);
    };
    timer = requestAnimationFrame(frame);
  }
  async function look(label) {
    view.overlay = label;
    const x = D.ofg[i]?.[label] || null;
    ofgBox.replaceChildren(
      ...(labels.length
        ? [
            el("h3", {}, "OFG's selections"),
            labels.length > 1
              ? select("Configuration", labels, label, look)
              : el("p", { class: "note" }, label),
            ofgWords(i, label, x),
          ]
        : []),
    );
    legend.replaceChildren(
      ...[
        ["--body-a", moving ? `A, ${moves(i, "") ? "moving" : "at rest"}` : "A", 1],
        ["--body-b", moving ? `B, ${moves(i, "_b") ? "moving" : "at rest"}` : "B", 1],
        ["--plane", "separating plane", Boolean(D.proofs[i]?.clear)],
        [
          "--met",
          [D.proofs[i]?.hit ? "common point" : "", x?.met ? "faces that OFG found to meet" : ""]
            .filter(Boolean)
            .join(", "),
          D.proofs[i]?.hit || x?.met,
        ],
        ["--chosen", "virtual edges", x && moving],
        ["--should", "faces that should have met", x?.should && !x.hit],
      ]
        .filter(([, , on]) => on)
        .map(([name, text]) => el("li", {}, el("i", { style: `background:var(${name})` }), text)),
    );
    marks.replaceChildren(...timeMarks(i, label, method));
    if (scene) {
      await scene.show(g, x && (x.hit ? { ...x, should: null } : x));
      go(view.t);
    }
  }
  view.recolour = () => scene?.recolour();
  view.close = () => {
    cancelAnimationFrame(timer);
    timer = 0;
    scene?.close();
    observer?.disconnect();
  };
  view.scene = () => scene;
  view.go = go;
  let observer = null;
  if (drawable) {
    await library("three");
    g = await geometryOf(i);
    try {
      scene = new BodyScene(canvas);
    } catch (error) {
      const reason = `3D graphics are not available: ${error.message}`;
      canvas.replaceWith(el("p", { class: "notice" }, reason));
    }
    canvas.addEventListener("keydown", (e) => {
      const turn = {
        ArrowLeft: [-0.12, 0],
        ArrowRight: [0.12, 0],
        ArrowUp: [0, 0.1],
        ArrowDown: [0, -0.1],
        "+": [0, 0, 0.85],
        "=": [0, 0, 0.85],
        "-": [0, 0, 1.18],
      }[e.key];
      if (turn) scene.orbit(...turn);
      else if (e.key === "0") scene.aim();
      else return;
      e.preventDefault();
    });
  }
  await look(view.overlay);
  if (scene) {
    go(view.t);
    const fit = () => {
      const box = canvas.getBoundingClientRect();
      if (box.width) scene.resize(Math.round(box.width), Math.round(box.height));
    };
    fit();
    scene.aim();
    observer = new ResizeObserver(fit);
    observer.observe(canvas);
  }
  return view;
}
