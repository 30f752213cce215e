# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The scenario families: every file of this folder that does not start with an underscore
defines one as SCENARIO.
"""

from __future__ import annotations

import difflib
import importlib
import pkgutil
from functools import cache
from importlib.metadata import entry_points
from pathlib import Path

from baselines.registry import run_file
from experiments.cases.scenario import Scenario

GROUP = "ofg.scenarios"  # entry points of installed packages that provide scenarios


@cache
def scenarios() -> dict[str, Scenario]:
    """All families by name, in alphabetical order, then those of installed packages. To add a
    family, add a file here.
    """
    found = {}
    for module in sorted(m.name for m in pkgutil.iter_modules(__path__)):
        if not module.startswith("_"):
            scenario = importlib.import_module(f"{__name__}.{module}").SCENARIO
            if scenario.name != module:
                raise ValueError(
                    f"Scenario file {module}.py defines a scenario named '{scenario.name}'; the two"
                    " must be the same, so that a row of a table leads to its file. Rename one of"
                    " them."
                )
            found[module] = scenario
    for entry in entry_points(group=GROUP):
        for scenario in _entered(entry):
            if scenario.name in found:
                raise ValueError(
                    f"The entry point '{entry.name}' of the group {GROUP} provides a scenario "
                    f"'{scenario.name}', a name that is taken; rename one."
                )
            found[scenario.name] = scenario
    return found


def _entered(entry) -> list[Scenario]:
    """The scenarios of an entry point, which names a Scenario or a list of them."""
    try:
        loaded = entry.load()
    except Exception as error:
        raise ValueError(
            f"The entry point '{entry.name}' of the group {GROUP} cannot be loaded "
            f"({type(error).__name__}: {error}); repair or uninstall its package."
        ) from error
    found = (
        [loaded]
        if isinstance(loaded, Scenario)
        else list(loaded)
        if isinstance(loaded, (list, tuple))
        else []
    )
    if not found or not all(isinstance(s, Scenario) for s in found):
        raise ValueError(
            f"The entry point '{entry.name}' of the group {GROUP} names {loaded!r}; it must name a"
            " Scenario or a list of them."
        )
    return found


def own_modules() -> set[str]:
    """Names of the families that are part of this project."""
    return {m.name for m in pkgutil.iter_modules(__path__)}


def get(name: str) -> Scenario:
    """The family of that name. ValueError with the closest names if there is none."""
    known = scenarios()
    if name in known:
        return known[name]
    close = difflib.get_close_matches(name, known, n=3, cutoff=0.4)
    hint = f"did you mean {', '.join(close)}? " if close else ""
    raise ValueError(
        f"Scenario '{name}' is unknown; {hint}The families are: {', '.join(known)}. Give a "
        "scenario of your own as the path of a Python file that defines SCENARIO."
    )


def load_file(path) -> list[Scenario]:
    """Load the scenarios of a Python file outside this folder, which sets SCENARIO, or SCENARIOS
    (several); they join `scenarios()`.

    ValueError if the file is missing, defines neither, or uses the name of a family of this folder.
    """
    path = Path(path)
    module = run_file(path, f"Scenario file {path}", f"scenario_file_{path.stem}", "SCENARIO")
    found = list(getattr(module, "SCENARIOS", [])) or [
        s for s in [getattr(module, "SCENARIO", None)] if s is not None
    ]
    if not found or not all(isinstance(s, Scenario) for s in found):
        raise ValueError(
            f"Scenario file {path} defines no scenario; it must set SCENARIO = Scenario(...), or"
            " SCENARIOS to a list of them (from experiments.cases.scenario import Scenario,"
            " Draft)."
        )
    taken = [s.name for s in found if s.name in own_modules()]
    if taken:
        raise ValueError(
            f"Scenario file {path}: the name '{taken[0]}' is taken by a family of this project;"
            " choose another."
        )
    scenarios().update({s.name: s for s in found})
    return found
