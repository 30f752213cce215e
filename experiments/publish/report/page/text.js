// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Page elements and formatted numbers.
function el(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [key, value] of Object.entries(attributes)) {
    if (value === undefined || value === null || value === false) continue;
    if (key.startsWith("on")) node.addEventListener(key.slice(2), value);
    else if (key === "class") node.className = value;
    else node.setAttribute(key, value === true ? "" : value);
  }
  node.append(
    ...children.flat(Infinity).filter((c) => c !== null && c !== undefined && c !== false),
  );
  return node;
}

const percent = (x) =>
  (x === 0 ? "0" : 100 * x < 0.1 ? (100 * x).toPrecision(1) : (100 * x).toFixed(1)) + " %";
const interval = ([low, high]) =>
  Number.isNaN(low) ? "" : `${(100 * low).toFixed(1)}–${(100 * high).toFixed(1)} %`;
const share = (count, total) => (total ? `${count}/${total}` : "–");

function number(x, digits = 3) {
  if (x === null || x === undefined || Number.isNaN(x)) return "–";
  if (x === 0) return "0";
  const a = Math.abs(x),
    text =
      a >= 1e-3 && a < 1e6
        ? String(Number(x.toPrecision(digits)))
        : Number(x.toPrecision(digits)).toExponential().replace("e+", "e");
  return text.replace(/-/g, "\u2212");
}

const microseconds = (ns) =>
  ns < 1e4 ? (ns / 1e3).toFixed(2) : ns < 1e5 ? (ns / 1e3).toFixed(1) : (ns / 1e3).toFixed(0);
const plural = (n, one, many = one + "s") => `${n.toLocaleString("en")} ${n === 1 ? one : many}`;

const MARKS = { r: "✓", m: "✗", f: "!", i: "≈", b: "·", n: "?", u: "–", e: "⚠", t: "⏱", ".": "" };
const badge = (letter) => {
  const kind = letter.toLowerCase(); // a capital letter: wrong within the method's tolerance
  const within = kind === letter ? "" : " within tolerance";
  return el(
    "span",
    { class: `badge ${{ r: "good", m: "bad", f: "bad", i: "mild" }[kind] || "none"}` },
    `${MARKS[kind]} ${D.codes[kind] || ""}${within}`,
  );
};

function select(label, options, value, change) {
  const box = el("select", { onchange: () => change(box.value), "data-name": label });
  for (const o of options) {
    const [v, text] = Array.isArray(o) ? o : [o, o];
    box.append(el("option", { value: v, selected: String(v) === String(value) }, String(text)));
  }
  return el("label", { class: "choice" }, el("span", {}, label), box);
}

// A table whose columns sort by a click on their heads. columns: {title, key(row) for sorting,
// cell(row) -> node or text, left, note}.
function sortable(columns, rows, { start, descending = false, caption, id } = {}) {
  let by = start,
    down = descending;
  const table = el("table", { id });
  const draw = () => {
    const sorted =
      by === undefined
        ? rows
        : rows
            .map((r, i) => [r, i])
            .sort(([a, i], [b, j]) => {
              const x = columns[by].key(a),
                y = columns[by].key(b);
              const missing = (v) => v === null || v === undefined || Number.isNaN(v);
              if (missing(x) || missing(y)) return missing(x) - missing(y) || i - j;
              return (x < y ? -1 : x > y ? 1 : 0) * (down ? -1 : 1) || i - j;
            })
            .map(([r]) => r);
    table.replaceChildren(
      caption ? el("caption", {}, caption) : "",
      el(
        "thead",
        {},
        el(
          "tr",
          {},
          columns.map((c, k) =>
            el(
              "th",
              {
                scope: "col",
                class: c.left ? "left" : "",
                title: c.note,
                "aria-sort": k === by ? (down ? "descending" : "ascending") : null,
              },
              c.key
                ? el(
                    "button",
                    {
                      type: "button",
                      class: "sort",
                      onclick: () => {
                        down = by === k ? !down : Boolean(c.down);
                        by = k;
                        draw();
                        table
                          .querySelectorAll("thead button")
                          [[...columns.keys()].filter((q) => columns[q].key).indexOf(k)].focus();
                      },
                    },
                    c.title,
                    el(
                      "span",
                      { class: "arrow", "aria-hidden": "true" },
                      k === by ? (down ? " ↓" : " ↑") : "",
                    ),
                  )
                : c.title,
            ),
          ),
        ),
      ),
      el(
        "tbody",
        {},
        sorted.map((r) =>
          el(
            "tr",
            {},
            columns.map((c, k) => {
              const content = c.cell(r);
              return k === 0
                ? el("th", { scope: "row", class: "left" }, content)
                : el("td", { class: c.left ? "left" : "" }, content);
            }),
          ),
        ),
      ),
    );
  };
  draw();
  return el(
    "div",
    { class: "scroll", tabindex: "0", role: "region", "aria-label": caption || "table" },
    table,
  );
}
