"""The page: a table of the claims, a paragraph for each, the engines, and the runs that it was made
from.
"""

from __future__ import annotations

import numpy as np

from experiments.analysis import costs
from experiments.run.folder import record
from experiments.run.folder.store import Store, StoreError

from .claims import CLAIMS, finding
from .engines import sections
from .runs import FAILS, HOLDS, OPEN, PART, UNMEASURED, Runs, grid


def about(runs: Runs) -> list[dict]:
    """A row per folder: what it asks, its size, when and from which commit it was made, how quiet
    the machine was.
    """
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
                "what it asks": question,
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
            "Made by `ofg-bench findings` from the runs in this folder at the end of `make"
            " reproduce`, which does it all again; no figure is typed. Counts are wrong/asked with"
            " 95 % Wilson intervals, over the certified cases that a method answered; times have"
            " 95 % bootstrap intervals, and no ratio of net times from Python is over one within"
            " the noise of its floor (the interquartile range of the floor's rounds). Cases of a"
            f" family resemble each other more than the intervals know. *{HOLDS.capitalize()}*: the"
            f" rule under the claim is met; *{FAILS}*: its opposite is shown; *{PART}*: both, in"
            f" parts; *{OPEN}*: too few cases; *{UNMEASURED}*: a run is missing. Of {len(found)}"
            f" claims: {', '.join(f'{n} {v}' for v, n in counts.items())}. After the claims: [the"
            " engines](#the-engines), [the runs](#the-runs)."
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
            f"Machine: {'; '.join(machines) or 'not noted'}. Noise: how far the 90th percentile of"
            " the noise probe lies above its median, in the worst bin; times of a run above 25 %"
            " are to be taken again. Each run has its manifest.json (versions, machine, load),"
            " report.html (every wrong answer in 3D), tables, figures and rows. To redo a run:"
            " remove its folder, then `make reproduce`. This page alone: `ofg-bench findings"
            " results --into results/README.md`."
        ),
    ]
    return "\n\n".join(parts) + "\n"
