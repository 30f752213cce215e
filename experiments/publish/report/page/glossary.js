// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// The glossary: D.terms holds its sections. Backticks mark code.
function glossary() {
  const words = (text) => text.split("`").map((part, k) => (k % 2 ? el("code", {}, part) : part));
  return D.terms.map(({ section: title, terms }) => [
    el("h3", {}, title),
    el(
      "dl",
      { class: "facts" },
      terms.map(([term, text]) => [el("dt", {}, term), el("dd", {}, words(text))]),
    ),
  ]);
}
