# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""What a configuration names is looked at first: unknown, out of range, or named twice."""

import pytest

from experiments.cli import entries, runner
from experiments.run import config
from experiments.run.config import ConfigError, RunConfig

DEEP = {"name": "deep", "cases": 1}


def chosen(**more):
    few = {"seed": 1, "methods": ["fcl-convex"], "scenarios": [DEEP]}
    return RunConfig.model_validate({**few, **more})


@pytest.mark.parametrize(
    "more, words",
    [
        ({"methods": ["ofg k=0"]}, "methods.0 'ofg k=0': .*k = 0 must be a whole number from 1"),
        (
            {"methods": ["brute-force", "ofg toi=x"]},
            "methods.1 .*toi = 'x' is unknown; use one of none",
        ),
        (
            {"methods": ["ofg-article precision=half"]},
            "precision = 'half' is unknown; use one of double",
        ),
        ({"methods": ["ofg repairs=arc"]}, "unknown repair 'arc'; use none, all"),
        ({"methods": ["ofg q=3"]}, "no parameter 'q'; it has k"),
        ({"methods": ["ofg k=4,inf,-1"]}, "k = -1 must be a whole number"),
        (
            {"methods": ["fcl-advancement-mesh toc_err=nan"]},
            "toc_err = nan must be a finite number",
        ),
        (
            {"optional_methods": ["rapier-cast-legs legs=0"]},
            "optional_methods.0 .*legs = 0 must be 1",
        ),
        ({"optional_methods": ["ipctk-ccd n=0"]}, "n = 0 must be 1 or more"),
        ({"methods": ["ofg k=4,4"]}, "methods.0 'ofg k=4,4' names 'ofg k=4' more than once"),
        (
            {"methods": ["ofg k=4,8", "ofg"]},
            "methods.1 'ofg' names 'ofg k=8', as does methods.0 'ofg k=4,8'",
        ),
        (
            {"optional_methods": ["fcl-convex"]},
            "optional_methods.0 .*as does methods.0 'fcl-convex'",
        ),
        ({"scenarios": [DEEP, DEEP]}, "scenarios names 'deep at level .*' more than once"),
        ({"scenarios": [{**DEEP, "name": "dep"}]}, "scenarios.0: .*did you mean deep"),
        (
            {"scenarios": [{"name": "thin_wall", "cases": 1, "levels": [10, 10.0]}]},
            "scenarios names 'thin_wall at level 10' more than once",
        ),
        ({"scenarios": [{"name": "thin_wall", "cases": 1, "levels": [3]}]}, "has no level 3"),
        (
            {"timing": {"reference": "fcl"}},
            "timing.reference 'fcl' is not a method of the run; the methods are fcl-convex",
        ),
    ],
)
def test_a_wrong_entry_is_named_before_anything_is_made(more, words, tmp_path):
    """k=0 and toi=x were found once all cases had been certified; what was named twice had its
    rows twice."""
    with pytest.raises(ConfigError, match=f"mine.toml: .*{words}"):
        entries.check(chosen(**more), "mine.toml")
    with pytest.raises(ConfigError, match=words):
        runner.run(chosen(**more), tmp_path / "run")
    assert not (tmp_path / "run").exists()


@pytest.mark.parametrize("name", [*config.experiments(), *config.presets()])
def test_what_the_project_runs_is_right(name):
    entries.check(config.load(name), name)


def test_a_file_of_a_readers_own_that_fails_is_said_in_a_line(tmp_path):
    (tmp_path / "mine.py").write_text("import sys\nsys.exit('no licence')\n")
    with pytest.raises(ConfigError, match="mine.toml: SystemExit: no licence"):
        entries.check(chosen(method_files=[str(tmp_path / "mine.py")]), "mine.toml")


@pytest.mark.parametrize("limit", ["inf", "1e9", "nan"])
def test_a_limit_that_no_clock_takes_is_refused(limit):
    with pytest.raises(ValueError, match="query_seconds"):
        chosen(query_seconds=float(limit))


@pytest.mark.parametrize(
    "text, words",
    [
        (b"title = '\xff'", "not UTF-8"),
        (b"seed = " + b"[" * 5000, "nested too deeply"),
    ],
)
def test_a_file_that_is_no_text_is_named(tmp_path, text, words):
    (tmp_path / "mine.toml").write_bytes(text)
    with pytest.raises(ValueError, match=f"mine.toml is {words}"):
        config.load(str(tmp_path / "mine.toml"))
