# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The page: a table of the claims, a paragraph on each claim, the engines, and the runs."""

from __future__ import annotations

import numpy as np

from experiments.analysis import costs
from experiments.run.folder import record
from experiments.run.folder.store import Store, StoreError

from .claims import CLAIMS, finding
from .engines import sections
from .runs import FAILS, HOLDS, OPEN, PART, UNMEASURED, Runs, grid

GLOSSARY = "../experiments/GLOSSARY.md"  # from results/


def about(runs: Runs) -> list[dict]:
    """A row per folder: its purpose, size, date, commit, machine and timing noise."""
    made = []
    for run in sorted(p.name for p in runs.folder.iterdir() if p.is_dir() and p.name != "runs"):
        folder = runs.folder / run
        noted = next(
            (
                record.facts(folder / n)
                for n in ("manifest.json", "made.json")
                if (folder / n).exists()
            ),
            {},
        )
        try:
            question = Store(folder).config.about or Store(folder).config.title
        except StoreError:
            question = {
                "sizes": (
                    "Misses and operations by size, depth and k (`python -m"
                    " experiments.studies.sizes`)."
                ),
                "native": "OFG and the engines as C++ libraries, by size (`ofg-bench native`).",
            }.get(run, "")
        size, noise = "-", "-"
        if (folder / "observations.parquet").exists():
            found = runs.answers(run)
            size = f"{found.case.nunique()} cases x {found.method.nunique()}"
        if (folder / "timings.parquet").exists() and np.isfinite(
            value := costs.noise(Store(folder))
        ):
            noise = f"{100 * value:.0f} %"
        before = noted.get("before", {})
        made.append(
            {
                "folder": f"[{run}]({run})",
                "purpose": question,
                "size": size,
                "made (UTC)": noted.get("started", "-")[:16].replace("T", " "),
                "commit": (
                    noted.get("commit", "-")[:9]
                    + ("+" if noted.get("commit", "").endswith("+") else "")
                ),
                "machine": f"{before['cores']} cores, {before['processor']}" if before else "-",
                "noise": noise,
            }
        )
    return made


def page(folder) -> str:
    """The whole page for a folder of runs."""
    runs = Runs(folder)
    found = [finding(asked, runs) for asked in CLAIMS]
    verdicts = [f.verdict for f in found]
    counts = {v: verdicts.count(v) for v in (HOLDS, PART, FAILS, OPEN, UNMEASURED) if v in verdicts}
    summary = [
        {
            "": f"[{i}](#claim-{i})",
            "claim": f.claim.title,
            "verdict": f"**{f.verdict}**",
            "number": f.number,
            "where": runs.links(f.claim.where[:1]),
        }
        for i, f in enumerate(found, 1)
    ]
    parts = [
        "# Findings",
        (
            "`ofg-bench findings` wrote this page from the runs in this folder; `make reproduce`"
            " repeats all runs and writes it again. No figure is typed. The"
            f" [glossary]({GLOSSARY}) defines the terms."
        ),
        (
            "Counts are wrong/answered over the certified cases that a method answered, with 95 %"
            " Wilson intervals. The intervals treat cases as independent, although cases of one"
            " family resemble each other, so they may be too narrow. Times have 95 % bootstrap"
            " intervals. A ratio of net times from Python is omitted if its denominator lies within"
            " the noise of the floor (the interquartile range of the floor's rounds)."
        ),
        (
            f"*{HOLDS.capitalize()}*: the rule given with the claim is met. *{FAILS.capitalize()}*:"
            f" its opposite is shown. *{PART.capitalize()}*: it is met for some parts only."
            f" *{OPEN.capitalize()}*: there are too few cases. *{UNMEASURED.capitalize()}*: a run"
            f" is missing. Verdicts on the {len(found)} claims:"
            f" {', '.join(f'{v} {n}' for v, n in counts.items())}. Below the claims follow [the"
            " engines](#the-engines) and [the runs](#the-runs)."
        ),
        grid(summary),
        "## The claims",
    ]
    for i, f in enumerate(found, 1):
        said = f"**{f.verdict.capitalize()}**: {f.number}." + (f" {f.text}" if f.text else "")
        parts.append(
            f'### <a id="claim-{i}"></a>{i}. {f.claim.title}\n{said} *Rule:* {f.claim.rule}.'
            f" *Article:* {f.claim.section}. *Limits:* {f.claim.limits} *Tables:*"
            f" {runs.links(f.claim.where)}."
        )
    made = about(runs)
    machines = sorted({row.pop("machine") for row in made} - {"-"})
    parts += [
        "## The engines",
        *sections(runs),
        "## The runs",
        grid(made),
        (
            f"Machine: {'; '.join(machines) or 'not recorded'}. Noise: the relative excess of the"
            " noise probe's 90th percentile over its median, in the worst bin; times of a run above"
            " 25 % should be measured again. Each run has a manifest.json (versions, machine,"
            " load), a report.html (wrong answers in 3D), tables, figures and rows. To repeat a"
            " run, remove its folder and run `make reproduce`. To write only this page, run"
            " `ofg-bench findings results --into results/README.md`."
        ),
    ]
    return "\n\n".join(parts) + "\n"
