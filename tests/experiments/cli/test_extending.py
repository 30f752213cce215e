# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""EXTENDING.md is true: a newcomer who types what it says gets there, by files and by a package."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

PAGE = (Path(__file__).parents[3] / "experiments" / "EXTENDING.md").read_text()
FILES = dict(re.findall(r"```(?:python|toml) (\S+)\n(.*?)```", PAGE, re.DOTALL))
SHELL = [
    line.split(None, 1)[1]
    for block in re.findall(r"```sh\n(.*?)```", PAGE, re.DOTALL)
    for line in block.splitlines()
]


def bench(folder, *words, **more):
    import shlex

    words = shlex.split(words[0]) if len(words) == 1 else words
    return subprocess.run(
        [sys.executable, "-m", "experiments.cli", *words],
        cwd=folder,
        capture_output=True,
        text=True,
        env={**os.environ, "COLUMNS": "160", **more},
    )


def test_the_page_from_its_top_to_its_end(tmp_path):
    for name in ("falling_die.py", "spheres.py", "dice.toml"):
        (tmp_path / name).write_text(FILES[name])
    done = {line.split()[0] + str(i): bench(tmp_path, line) for i, line in enumerate(SHELL)}
    assert [*done] == ["check0", "run1", "run2", "compare3"]
    assert "far apart" in done["check0"].stdout
    assert done["run1"].returncode == 0, done["run1"].stderr
    for words in (
        "Misses by length of the fall.",
        "Wrong answers by where the die falls.",
        "spheres n=16",
        "middle",
    ):
        assert words in done["run1"].stdout
    assert (tmp_path / "dice/tables/dice-misses.tex").is_file() and (
        tmp_path / "dice/report.html"
    ).is_file()
    assert (
        done["compare3"].returncode == 0 and "Accuracy is identical" in done["compare3"].stdout
    ), done["compare3"].stderr


def install(folder):
    """The page's package, built and installed by pip into folder/site. Without a network: so the
    builder is the one that is here already.
    """
    source = folder / "source"
    (source / "my_collisions").mkdir(parents=True)
    text = FILES["pyproject.toml"].replace(
        'requires = ["setuptools"]', 'requires = ["scikit-build-core"]'
    )
    text = text.replace("setuptools.build_meta", "scikit_build_core.build").split(
        "[tool.setuptools]"
    )
    entries = text[1][text[1].index("[project.entry-points") :]
    (source / "pyproject.toml").write_text(
        text[0]
        + '[tool.scikit-build]\nwheel.cmake = false\nwheel.packages = ["my_collisions"]\n\n'
        + entries
    )
    for name in ("falling_die.py", "spheres.py", "__init__.py"):
        (source / "my_collisions" / name).write_text(FILES[name])
    (source / "my_collisions" / "dice.toml").write_text(
        "".join(line for line in FILES["dice.toml"].splitlines(True) if "_files" not in line)
    )
    pip = [
        sys.executable,
        "-m",
        "pip",
        "install",
        "--quiet",
        "--disable-pip-version-check",
        "--no-index",
        "--no-build-isolation",
        "--no-deps",
    ]
    done = subprocess.run(
        [*pip, "--target", str(folder / "site"), str(source)], capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr


def test_an_installed_package_is_known_to_the_command_and_to_its_workers(tmp_path):
    install(tmp_path)
    listed = bench(tmp_path, "list", PYTHONPATH=str(tmp_path / "site"))
    assert all(word in listed.stdout for word in ("falling_die", "spheres", "Falling dice")), (
        listed.stderr
    )
    done = bench(tmp_path, "run", "dice", "--out", "run", PYTHONPATH=str(tmp_path / "site"))
    assert done.returncode == 0 and "Misses by length of the fall." in done.stdout, done.stderr


@pytest.mark.parametrize(
    "group, line",
    [
        ("ofg.scenarios", "broken = nowhere:SCENARIO"),
        ("ofg.methods", "broken = json:dumps"),
        ("ofg.experiments", "broken = json:nothing"),
    ],
)
def test_a_broken_entry_point_is_named(tmp_path, group, line):
    info = tmp_path / "broken-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: broken\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text(f"[{group}]\n{line}\n")
    done = bench(tmp_path, "list", PYTHONPATH=str(tmp_path))
    said = " ".join(done.stderr.split())
    assert (
        done.returncode == 2
        and f"entry point 'broken' of the group {group}" in said
        and "Traceback" not in said
    )


def test_a_method_that_returns_no_verdict_costs_its_own_rows_and_is_told_what_to_return(tmp_path):
    (tmp_path / "falling_die.py").write_text(FILES["falling_die.py"])
    wrong = FILES["spheres.py"].replace("return Verdict(", "return True or Verdict(")
    assert wrong != FILES["spheres.py"]
    (tmp_path / "spheres.py").write_text(wrong)
    (tmp_path / "dice.toml").write_text(FILES["dice.toml"])
    done = bench(tmp_path, "run dice.toml --out dice")
    assert done.returncode == 0 and "Traceback" not in done.stderr, done.stderr
    assert (
        "returned bool, not a Verdict (of baselines.contract)"
        in (tmp_path / "dice/tables/unanswered.csv").read_text()
    )


def test_brackets_in_an_error_are_printed(tmp_path):
    """They were taken for markup: 'vertex 0 is , which is not finite'."""
    (tmp_path / "falling_die.py").write_text(
        FILES["falling_die.py"]
        .replace("box(1, 1, 1), box", "ofg.Body.convex(np.full((5, 3), np.nan)), box")
        .replace("import numpy as np", "import numpy as np\nimport ofg")
    )
    (tmp_path / "spheres.py").write_text(FILES["spheres.py"])
    (tmp_path / "dice.toml").write_text(FILES["dice.toml"])
    done = bench(tmp_path, "run dice.toml --out dice")
    assert done.returncode == 2 and "vertex 0 is [nan nan nan], which is not finite" in " ".join(
        done.stderr.split()
    )
