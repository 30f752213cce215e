# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The request of `ofg-bench explain`: a case of a run or a file, and the methods to run on it."""

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
    "Error of the time of impact outside its certified bracket, as a share of the step; late errors"
    " are positive."
)


@dataclass(frozen=True)
class Request:
    """name, store: a case and its opened run; or file: a file with one case.

    methods: labels to run, by default those of the run or file. method_files: files with the user's
    methods. anew: run the methods even if there are answers. trust: execute the Python files that
    the run names.
    """

    name: str | None
    store: Store | None
    file: Path | None
    methods: tuple[str, ...] = ()
    method_files: tuple[str, ...] = ()
    anew: bool = False
    trust: bool = False

    def explained(self) -> tuple[Explained, dict]:
        """The case with the requested answers, and the versions of the engines that gave them.

        Raises ConfigError for a method whose file the run names but which is not trusted.
        """
        found, config, versions = self._of_run() if self.store else self._of_file()
        if strange := [s for s in self.methods if declared.recorded(name_of(s))]:
            raise ConfigError(
                f"The method '{strange[0]}' is defined in a file that the run names, which is not"
                " executed. Pass --trust to execute it, or pass the file with --methods."
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
        """The configuration with the methods to run."""
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
    """Write the case's page to `out` and its file to `save_to`, and print all answers."""
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
    columns = ("method", "outcome", *times, "detail")
    print_grid(_title(found), columns, rows, LATE if sweep else "")
    if sweep:
        say(f"A {motion_words(query.motion)}; B {motion_words(query.motion_b)}.")
    if save_to:
        save(found, save_to)
        said = f"Wrote the case to {save_to}. Show it with: ofg-bench explain --file {save_to}"
        say(given.markup(said))
    say(given.markup(f"Wrote {path}."))


def _title(found: Explained) -> str:
    """The case and its label: certified, only stated, or uncertain."""
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
    """Whether no loaded method has this name."""
    name = name_of(spec)
    return name not in registry.methods() or declared.recorded(name)
