# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Engines are told apart: no two share a colour, no two curves a colour and a marker."""

from baselines import registry
from experiments.analysis.plots import figures


def test_every_engine_there_is_has_a_colour_of_its_own():
    own = [m for m in registry.methods().values() if m.__module__.startswith("baselines.")]
    one_each = {m.engine: m.name for m in own}  # without the methods that other tests load
    styles = figures._styles(one_each.values())
    assert len({colour for colour, _ in styles.values()}) == len(one_each)


def test_curves_of_a_run_look_different():
    from experiments.run import config

    for name in ("standard", *config.experiments()):
        labels = [m.label for spec in config.load(name).asked for m in registry.make(spec)]
        styles = figures._styles(labels)
        assert len(set(styles.values())) == len(styles), name
