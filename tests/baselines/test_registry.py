# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

import subprocess
import sys

import pytest

from baselines import registry
from baselines.contract import Method


def test_listing_imports_no_engine():
    """FCL is not asked about: trimesh imports it where it is installed."""
    program = (
        "import sys; from baselines import registry; n = len(registry.methods()); print(n, [m for m"
        " in ('pybullet', 'mujoco', 'coal', 'rapier3d', 'ipctk', 'pydrake') if m in sys.modules])"
    )
    count, imported = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    ).stdout.split(maxsplit=1)
    assert int(count) > 10 and imported.strip() == "[]"


def test_commas_give_every_combination_typed_by_the_default():
    labels = [m.label for m in registry.make("bullet-substeps n=1,4")] + [
        m.label for m in registry.make("fcl-advancement-mesh toc_err=1e-3")
    ]
    assert labels == [
        "bullet-substeps n=1",
        "bullet-substeps n=4",
        "fcl-advancement-mesh toc_err=0.001",
    ]
    assert registry.make("bullet-substeps n=4")[0].parameters == {"n": 4}


def test_a_label_reads_back_as_the_same_configuration():
    for name in registry.methods():
        (method,) = registry.make(name)
        (again,) = registry.make(method.label)
        assert type(again) is type(method) and again.parameters == method.parameters


@pytest.mark.parametrize(
    "spec, words",
    [
        ("bulet", ["'bulet'", "bullet", "ofg-bench list"]),
        ("", ["No method is named ''"]),
        ("bullet-substeps k=3", ["no parameter 'k'", "n (default 16)"]),
        ("bullet n=3", ["it has no parameter"]),
        ("bullet-substeps n=few", ["n=few is not of type int"]),
        ("bullet-substeps n", ["parameter=value"]),
        ("bullet-substeps n=", ["parameter=value"]),
    ],
)
def test_a_wrong_specification_says_what_is_wrong_and_what_there_is(spec, words):
    with pytest.raises(registry.UnknownMethod) as error:
        registry.make(spec)
    assert all(word in str(error.value) for word in words) and "\n" not in str(error.value)


@pytest.mark.parametrize("spec", ["bullet-substeps n=0", "fcl-naive-mesh iterations=1"])
def test_senseless_parameters_are_refused(spec):
    with pytest.raises(ValueError, match="must be (1 or more|from 2 to)"):
        registry.make(spec)


def test_a_missing_engine_is_reported_with_the_command_that_installs_it():
    class Absent(Method):
        engine, imports = "no-such-engine", "no_such_engine.core"

        def prepare(self, query):
            raise NotImplementedError

    assert "pip install no-such-engine" in registry.available(Absent)
    assert registry.version(Absent) == "absent"


def test_methods_of_a_readers_own_file(tmp_path):
    file = tmp_path / "mine.py"
    file.write_text(
        "from baselines.fcl import FclConvex\nclass Mine(FclConvex):\n    name = 'mine'\nMETHODS ="
        " [Mine]\n"
    )
    assert list(registry.load_file(file)) == ["mine"]
    assert registry.make("mine")[0].name == "mine"
    file.write_text("from baselines.fcl import FclConvex\nMETHODS = [FclConvex]\n")
    with pytest.raises(ValueError, match="'fcl-convex' is taken"):
        registry.load_file(file)
    file.write_text("x = 1\n")
    with pytest.raises(ValueError, match="METHODS"):
        registry.load_file(file)
    with pytest.raises(ValueError, match="does not exist"):
        registry.load_file(tmp_path / "none.py")


def test_k_may_be_all_faces_where_the_method_says_so():
    (method,) = registry.make("ofg k=inf")
    assert method.label == "ofg k=inf" and registry.make(method.label)[0].parameters["k"] == float(
        "inf"
    )
    with pytest.raises(registry.UnknownMethod, match="not of type int"):
        registry.make("fcl-convex-substeps n=inf")


def test_a_method_file_that_is_no_python_file_is_said_to_be_none(tmp_path):
    path = tmp_path / "mine.txt"
    path.write_text("METHODS = []")
    with pytest.raises(ValueError, match="must end in .py"):
        registry.load_file(path)
