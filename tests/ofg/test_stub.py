# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The types of the core that mypy reads are those of the core."""

import ast
from pathlib import Path

from nanobind.stubgen import StubGen

import ofg._core as core


def test_stub_is_of_this_core():
    generated = StubGen(core)
    generated.put(core)
    stub = Path(__file__).parents[2] / "ofg" / "_core.pyi"
    kept = ast.dump(ast.parse(stub.read_text()))
    assert kept == ast.dump(ast.parse(generated.get())), "make it anew: make stub"
