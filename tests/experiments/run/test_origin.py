# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The origin of a result names all code that it depends on."""

import pytest

from experiments.run.folder import origin


def test_a_missing_compiled_module_is_named_with_the_remedy(monkeypatch):
    # find_spec returns None for it, which once became an AttributeError about None.
    monkeypatch.setattr(origin, "NATIVE", ("ofg._missing",))
    with pytest.raises(ImportError, match="ofg._missing is missing; .* make build"):
        origin.code.__wrapped__()
