# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""One rule chooses the unit of every best-effort method, on cases that no run counts."""

import pytest

from baselines import registry, units
from experiments.cases import families
from experiments.run import config
from experiments.run.folder import origin
from experiments.studies import tuning


def test_the_rule_is_fewest_wrong_then_fewest_unanswered_then_nearest_to_1():
    def rows(*counts):
        return [dict(zip(("unit", "wrong", "unanswered"), map(str, row))) for row in counts]

    assert units.best(rows((1, 5, 0), (32, 4, 9), (256, 4, 8))) == 256
    assert units.best(rows((1024, 4, 0), (32, 4, 0), (256, 4, 0))) == 32
    assert units.best(rows((0.25, 4, 0), (2, 4, 0), (1024, 3, 1))) == 1024


def test_the_counts_hold_every_tuned_method_in_every_unit():
    assert set(units.tuned()) == set(tuning.tuned()), "python -m experiments.studies.tuning"
    assert set(units.tuned().values()) <= set(tuning.UNITS)


@pytest.mark.parametrize("name", [*config.presets(), *config.experiments()])
def test_no_run_counts_what_the_units_were_chosen_on(name):
    assert config.load(name).seed != tuning.SEED


def test_every_family_is_asked_about():
    assert {case.scenario for case, _ in tuning.cases()} >= set(families.own_modules()) & set(
        families.scenarios()
    ) - {"large_mesh"}  # more faces than FACES


def test_substeps_and_pieces_take_the_unit_of_their_method():
    for name, base in (
        ("fcl-convex-exact-substeps", "fcl-convex-exact"),
        ("bullet-coacd", "bullet-no-margin"),
    ):
        assert registry.make(name)[0].length == units.tuned()[base]


def test_a_method_without_counts_is_asked_in_units_of_its_bodies(monkeypatch):
    monkeypatch.setattr(units, "tuned", dict)
    assert registry.make("fcl-convex-exact")[0].length == 1


def test_answers_given_in_other_units_are_not_used_again():
    """A shard is known by its code, and the counts decide what a method answers."""
    assert units.TABLE.suffix in origin.CODE
