# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Shards: named by what determines them, and whole or made again."""

import os
import random
import signal
import subprocess
import sys
import time

import pandas as pd
import pytest

from experiments.run.folder.shard import key
from experiments.run.folder.store import Store

FRAME = pd.DataFrame({"x": range(50)})


@pytest.fixture
def shard(tmp_path):
    store = Store(tmp_path)
    shard = store.shard("cases", seed=1)
    store.write(FRAME, shard)
    return shard


def file_of(shard):
    (path,) = shard.folder.iterdir()
    return path


def test_the_key_is_of_all_facts_and_of_nothing_else():
    assert key({"a": 1, "b": [2]}) == key({"b": (2,), "a": 1}) != key({"a": 1, "b": [3]})


def test_a_shard_reads_back_and_another_is_not_there(shard, tmp_path):
    assert shard.ready() and shard.read().equals(FRAME)
    assert not Store(tmp_path).shard("cases", seed=2).ready()


@pytest.mark.parametrize(
    "content",
    [
        lambda whole: b"",
        lambda whole: whole[: len(whole) // 2],
        lambda whole: bytes(len(whole)),
        lambda whole: whole[:40] + bytes([whole[40] ^ 1]) + whole[41:],
    ],
    ids=["empty", "cut", "zeros", "one bit"],
)
def test_a_damaged_shard_is_removed_with_a_notice(shard, content, capfd):
    """An empty or cut part ended every resume with a traceback of the Parquet reader."""
    path = file_of(shard)
    path.write_bytes(content(path.read_bytes()))
    assert not shard.ready() and not path.exists()
    assert "is made again" in " ".join(capfd.readouterr().err.split())
    shard.write(FRAME)
    assert shard.read().equals(FRAME)


WRITER = """
import sys, pandas as pd
from experiments.run.folder.store import Store
store, n = Store(sys.argv[1]), 0
print("begun", flush=True)
while True:
    store.write(pd.DataFrame({"x": range(n, n + 20000)}), store.shard("cases", n=n))
    n += 1
"""


def test_a_kill_at_any_moment_of_writing_leaves_whole_shards(tmp_path):
    draw = random.Random(5)
    for trial in range(12):
        folder = tmp_path / str(trial)
        command = [sys.executable, "-c", WRITER, str(folder)]
        writer = subprocess.Popen(command, stdout=subprocess.PIPE)
        writer.stdout.readline()
        time.sleep(draw.uniform(0.0, 0.15))
        os.kill(writer.pid, signal.SIGKILL)
        writer.wait()
        writer.stdout.close()
        store = Store(folder)
        named = [p for p in folder.glob("parts/cases/*") if not p.name.startswith(".")]
        for n in range(len(named)):
            assert store.shard("cases", n=n).ready()
            assert store.shard("cases", n=n).read().x[0] == n
