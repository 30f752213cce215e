# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

import pytest

from experiments.run import config


def write(tmp_path, text):
    path = tmp_path / "mine.toml"
    path.write_text(text)
    return str(path)


def test_every_preset_loads():
    assert "quick" in config.presets()
    for name in config.presets():
        config.load(name)


@pytest.mark.parametrize(
    "text, words",
    [
        (
            "seed = -1\nmethods = ['ofg']\nscenarios = [{name='deep', cases=1}]",
            ["seed", "greater than or equal to 0"],
        ),
        ("seed = 1\nmethods = []\nscenarios = [{name='deep', cases=1}]", ["methods", "at least 1"]),
        (
            "seed = 1\nmethods = ['ofg']\nscenarios = [{name='deep', cases=1}]\nworker = 3",
            ["worker", "not permitted"],
        ),
        (
            "seed = 1\nmethods = ['ofg']\nscenarios = [{name='deep', cases='many'}]",
            ["scenarios.0.cases", "integer"],
        ),
        ("seed = ", ["not valid TOML"]),
    ],
)
def test_a_wrong_file_is_named_with_its_field(tmp_path, text, words):
    with pytest.raises(config.ConfigError) as error:
        config.load(write(tmp_path, text))
    assert all(word in str(error.value) for word in ["mine.toml", *words])


def test_an_unknown_preset_names_the_closest_and_all():
    with pytest.raises(config.ConfigError, match="did you mean quick"):
        config.load("qick")
