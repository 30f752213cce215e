# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""One runner in a folder, and no lock that outlives its holder."""

import errno
import fcntl
import os
import signal
import subprocess
import sys

import pytest

from experiments.run.config import RunConfig
from experiments.run.folder.lock import Lock, Locked
from experiments.run.folder.store import Store, StoreError

CONFIG = RunConfig(seed=1, methods=["ofg"], scenarios=[{"name": "deep", "cases": 1}])
HOLDER = """
import sys, time
from pathlib import Path
from experiments.run.folder.lock import Lock
with Lock(Path(sys.argv[1])):
    print("held", flush=True)
    time.sleep(600)
"""


@pytest.fixture
def holder(tmp_path):
    process = subprocess.Popen(
        [sys.executable, "-c", HOLDER, str(tmp_path)], stdout=subprocess.PIPE
    )
    process.stdout.readline()
    yield process
    process.kill()
    process.wait()
    process.stdout.close()


def test_a_second_runner_is_told_who_holds_the_folder(tmp_path, holder):
    """Two wrote into one folder, and each removed what the other had made."""
    with pytest.raises(StoreError, match=rf"in use by process {holder.pid} on .*--out"):
        with Store(tmp_path).held(CONFIG):
            pass
    assert not (tmp_path / "config.json").exists()


def test_a_lock_dies_with_its_holder(tmp_path, holder):
    os.kill(holder.pid, signal.SIGKILL)
    holder.wait()
    with Store(tmp_path).held(CONFIG):
        with pytest.raises(Locked, match=f"process {os.getpid()} "):
            Lock(tmp_path).__enter__()
    assert not (tmp_path / ".lock").exists()


def test_a_file_system_without_locks_is_said_to_be_one(tmp_path, monkeypatch, capfd):
    def none(*_):
        raise OSError(errno.ENOLCK, "No locks available")

    monkeypatch.setattr(fcntl, "flock", none)
    with Lock(tmp_path):
        pass
    assert "has no locks (No locks available)" in " ".join(capfd.readouterr().err.split())
