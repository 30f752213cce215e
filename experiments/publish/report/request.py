"""What `ofg-bench explain` is asked to show: a case of a run or of a file, and whom to ask."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from baselines import registry
from baselines.label import name_of
from experiments.run import declared
from experiments.run.config import ConfigError, RunConfig, load
from experiments.run.folder import given, manifest
from experiments.run.folder.store import Store

from .explain import Explained, ask, digits, from_file, from_run, motion_words, page, save, verdicts

LATE = (
    "Error: of the time of impact beyond its certified bracket, as a share of the step; positive is"
    " late."
)


@dataclass(frozen=True)
class Request:
    """name, store: a case and its run, opened; or file: the case in a file of its own.

    methods: labels to ask, by default those of the run or file. method_files: files with methods of
    the user. anew: ask although answers are there. trust: run the files that the run names.
    """

    name: str | None
    store: Store | None
    file: Path | None
    methods: tuple[str, ...] = ()
    method_files: tuple[str, ...] = ()
    anew: bool = False
    trust: bool = False

    def explained(self) -> tuple[Explained, dict]:
        """The case with the answers that are wanted, and the versions of what gave them.

        Raises ConfigError for a method of a file that the run names and that is not trusted.
        """
        found, config, versions = self._of_run() if self.store else self._of_file()
        if strange := [s for s in self.methods if declared.recorded(name_of(s))]:
            raise ConfigError(
                f"The method '{strange[0]}' is of a file that the run names, which is not run; pass"
                " --trust to run it, or its file with --methods."
            )
        if self.anew or not len(found.said):
            with tempfile.TemporaryDirectory() as folder:
                found = ask(found, config, Path(folder, "workers.log"))
        return found, versions or manifest.versions(config)

    def _of_run(self) -> tuple[Explained, RunConfig, dict]:
        config = self.store.config
        if not self.trust:
            config = config.model_copy(update={"method_files": (), "scenario_files": ()})
        found = from_run(self.store, self.name)
        known = tuple(spec for spec in config.asked if self.trust or not _strange(spec))
        return found, self._asking(config, known), self.store.facts.get("versions", {})

    def _of_file(self) -> tuple[Explained, RunConfig, dict]:
        found = from_file(self.file)
        known = tuple(label for label in found.said.method if not _strange(label))
        scenario = {"name": found.case.scenario, "cases": 1}
        config = RunConfig(seed=0, methods=known or ("ofg",), scenarios=[scenario])
        return found, self._asking(config, known), {}

    def _asking(self, config: RunConfig, known: tuple[str, ...]) -> RunConfig:
        """The configuration with the methods that are to be asked."""
        return config.model_copy(
            update={
                "methods": self.methods or known or load("quick").methods,
                "optional_methods": (),
                "method_files": config.method_files + self.method_files,
            }
        )


def show(
    request: Request, out: Path | None, save_to: Path | None, print_grid: Callable, say: Callable
) -> None:
    """Write the case's page into `out`, its file into `save_to`, and print what methods said."""
    found, versions = request.explained()
    path = out or Path(f"{found.case.id.replace('/', '-')}.html")
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(page(found, versions))
    query = found.case.query
    sweep = query.question != "overlap"
    times = ("time", "error") if sweep else ()
    rows = []
    for r in verdicts(found).itertuples():
        numbers = (digits(r.time), digits(r.error)) if sweep else ()
        rows.append((r.method, r.outcome, *numbers, r.detail or ""))
    columns = ("method", "verdict", *times, "detail")
    print_grid(_title(found), columns, rows, LATE if sweep else "")
    if sweep:
        say(f"A {motion_words(query.motion)}; B {motion_words(query.motion_b)}.")
    if save_to:
        save(found, save_to)
        said = f"The case is in {save_to}; show it anywhere with: ofg-bench explain --file"
        say(given.markup(f"{said} {save_to}"))
    say(given.markup(f"The page is {path}."))


def _title(found: Explained) -> str:
    """The case with its truth: certified, stated only, or uncertain."""
    truth = found.truth
    label = f"certified {truth.label}" if truth.label != "uncertain" else "uncertain"
    if found.refused:
        label = f"stated, not certified ({found.refused}): {truth.label}"
    touching = ", touching" if truth.touching else ""
    bracket = ""
    if found.case.query.question != "overlap" and truth.label == "hit":
        bracket = f", time of impact in [{truth.t_lo!r}, {truth.t_hi!r}]"
    reason = f". {truth.reason}" if truth.reason else ""
    return f"{found.case.id}: {label}{touching}{bracket}, gap {truth.gap:.3g}{reason}"


def _strange(spec: str) -> bool:
    """Is it no method that is loaded here?"""
    name = name_of(spec)
    return name not in registry.methods() or declared.recorded(name)
