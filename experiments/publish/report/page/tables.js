// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// The tables of the run as saved in tables/; each cell links to its cases.
const RATES = new Set([
  "judged",
  "judged hit",
  "judged clear",
  "can tunnel",
  "miss",
  "false alarm",
  "tunnelled",
]);

function drawTables() {
  document.getElementById("saved").replaceChildren(
    ...D.tables.map((t) => {
      const numeric = t.columns.map(
        (_, k) =>
          k > 0 && t.rows.every((r) => !/^[a-z]/i.test(r[k]) || r[k] === "all" || r[k] === "nan"),
      );
      const details = el("details", { id: `table-${t.name}` }, el("summary", {}, t.title));
      const fill = () => {
        if (!details.open || details.dataset.drawn) return;
        details.dataset.drawn = "yes";
        details.append(
          el("p", { class: "note" }, t.caption),
          el(
            "div",
            { class: "scroll", tabindex: "0", role: "region", "aria-label": t.title },
            el(
              "table",
              {},
              el(
                "thead",
                {},
                el(
                  "tr",
                  {},
                  t.columns.map((c, k) =>
                    el("th", { scope: "col", class: numeric[k] ? "" : "left" }, c),
                  ),
                ),
              ),
              el(
                "tbody",
                {},
                t.rows.map((row, i) =>
                  el(
                    "tr",
                    {},
                    row.map((value, k) => {
                      const to = t.links[i][k],
                        [count, total] = value.split("/").map(Number);
                      const content = [
                        to ? link(to, value) : value,
                        to &&
                        total > 0 &&
                        RATES.has(to.kind) &&
                        !t.columns[k + 1]?.startsWith("95 %")
                          ? el("small", {}, interval(wilson(count, total)))
                          : null,
                      ];
                      return k
                        ? el("td", { class: numeric[k] ? "" : "left" }, content)
                        : el("th", { scope: "row", class: "left" }, content);
                    }),
                  ),
                ),
              ),
            ),
          ),
        );
      };
      details.addEventListener("toggle", fill);
      if (t.own) {
        details.open = true;
        fill();
      }
      return details;
    }),
  );
}
