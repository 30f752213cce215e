# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

import errno

import pandas as pd
import pytest

from experiments.run.config import RunConfig
from experiments.run.folder.store import Store, StoreError
from experiments.run.processes.machine import MachineError

CONFIG = RunConfig(seed=1, methods=["ofg"], scenarios=[{"name": "deep", "cases": 1}])


def test_the_same_configuration_goes_on_and_another_is_refused(tmp_path):
    Store(tmp_path / "run").begin(CONFIG)
    Store(tmp_path / "run").begin(CONFIG)
    with pytest.raises(StoreError, match="differs in: seed"):
        Store(tmp_path / "run").begin(CONFIG.model_copy(update={"seed": 2}))
    assert Store(tmp_path / "run").config == CONFIG


def test_a_folder_with_other_files_is_left_alone(tmp_path):
    (tmp_path / "thesis.tex").write_text("years of work")
    with pytest.raises(StoreError, match="not empty"):
        Store(tmp_path).begin(CONFIG)


def test_a_full_disk_is_said_and_leaves_no_half_file(tmp_path, monkeypatch):
    def full(self, path, **_):
        path.write_bytes(b"half")
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(pd.DataFrame, "to_parquet", full)
    with pytest.raises(MachineError, match="No space left on device.*resume"):
        Store(tmp_path).write(pd.DataFrame({"x": [1]}), "parts", "a.parquet")
    assert list((tmp_path / "parts").iterdir()) == []


def test_an_unfinished_run_says_how_to_finish_it(tmp_path):
    with pytest.raises(StoreError, match="ofg-bench resume"):
        Store(tmp_path).read("cases.parquet")


def test_no_run_folder_is_said(tmp_path):
    with pytest.raises(StoreError, match="not a run folder"):
        _ = Store(tmp_path).config


def test_labels_of_an_earlier_run_are_read_as_they_are_written_now(tmp_path):
    """`nearest` was once `selection`, and `selection_times` was `selections`."""
    then = CONFIG.model_copy(update={"methods": ("ofg k=8,64 selection=point-triangle",)})
    store = Store(tmp_path / "run")
    store.begin(then)
    labels = ["ofg k=8 selection=point-triangle", "ofg k=8 repairs=selection-times", "fcl-mesh"]
    store.write(pd.DataFrame({"method": labels}), "rows.parquet")
    assert store.config.methods == ("ofg k=8,64 nearest=point-triangle",)
    assert list(store.read("rows.parquet").method) == [
        "ofg k=8 nearest=point-triangle",
        *labels[1:],
    ]
