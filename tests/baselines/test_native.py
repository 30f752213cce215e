# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The native lane: its case file, its protocol and its errors, with the engine at hand, OFG."""

import fcntl
import os
import re
import shutil
import struct
import subprocess
import sysconfig
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from baselines import native, registry
from baselines.contract import Unsupported
from baselines.easy_queries import body, overlap, sweep
from ofg import Motion, Pose, Query

COMPILER = shutil.which("c++")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """`lane` and OFG's plugins, compiled without cmake and without any other engine."""
    if not COMPILER:
        pytest.skip("no C++ compiler called c++")
    base = tmp_path_factory.getbasetemp()
    # one for all workers
    to = (base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / "native"
    (to / "plugins").mkdir(parents=True, exist_ok=True)
    with open(to / "lock", "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not (to / "done").exists():
            _compile(to)
            (to / "done").touch()
    return to


def _compile(to):
    headers = native.SOURCE.parents[1] / "ofg" / "include"
    flags = [COMPILER, "-std=c++20", "-O0", "-I", str(native.SOURCE), "-I", str(headers)]
    main = str(native.SOURCE / "main.cpp")
    subprocess.run([*flags, main, "-o", str(to / "lane"), "-ldl"], check=True)
    for plugin in ("ofg", "ofg_solid"):
        source, made = native.SOURCE / f"{plugin}.cpp", to / "plugins" / f"{plugin}.so"
        shared = ["-fPIC", "-shared", "-ffp-contract=off", "-o", str(made)]
        subprocess.run([*flags, str(source), *shared], check=True)


def queries() -> list[Query]:
    turning = Query(
        "motion",
        body("convex"),
        body("convex"),
        Pose((2, 0, 0, 0.5), (-5, 0.1, 0)),
        Pose((1, 1, 0, 0)),
        Motion((10, 0, 0), (0, 0, 3), 1.0),
    )
    apart, deep = overlap("convex", (7, 1, 2)), overlap("convex", (0.9, 0.7, 0.5))
    return [apart, deep, sweep("translation", "convex", (-5, 0.3, 0.1), (10, 0, 0)), turning]


def poses(n: int) -> list[Query]:
    """Overlaps of one pair at n distances, so that some hit and some do not."""
    return [overlap("convex", (6.0 * i / n, 0.3, 0.2)) for i in range(n)]


def answers(taken: native.Taken) -> pd.DataFrame:
    """Those of every engine, without the floor and the probe."""
    found = taken.answers.join(taken.contestants, on="id")
    return found[~found.engine.str.startswith("(")]


def test_both_lanes_say_the_same(folder):
    asked = queries()
    found = answers(native.run(asked, rounds=4, warmup=1, folder=folder))
    assert {"ofg k=4", "ofg k=8", "ofg k=16", "ofg k=8 repairs=all"} <= set(found.engine)
    for (label, _), group in found.groupby(["engine", "isa"]):
        (method,) = registry.make(label)
        expected = [method.prepare(query)() for query in asked]
        assert list(group.case) == [0, 1, 2, 3]
        assert [bool(h) for h in group.hit] == [v.hit for v in expected], label
        assert [v.hit for v in expected] == [False, True, True, True]
        np.testing.assert_array_equal(group.time, [v.time for v in expected])


def test_every_round_of_every_block_has_a_time(folder):
    taken = native.run(poses(12), ("warm", "batch"), 4, rounds=5, warmup=1, folder=folder)
    assert (taken.times.groupby("id").size() == 3).all() and (taken.times.queries == 4).all()
    assert taken.times.filter(like="round").shape[1] == 5
    assert (taken.answers.groupby("id").size() == 12).all()


def test_a_batch_answers_as_single_calls_do(folder):
    found = answers(native.run(poses(24), ("warm", "batch"), 8, rounds=1, warmup=0, folder=folder))
    both = found.pivot_table(index=["engine", "isa", "case"], columns="mode", values="hit").dropna()
    assert both.groupby(level="engine").size().index.str.contains("screen").all()
    assert len(both) and (both.warm == both.batch).all() and 0 < both.warm.mean() < 1


def test_an_engine_stands_in_the_cells_that_it_knows(folder):
    def engines(mode):
        taken = native.run(poses(2), (mode,), rounds=1, warmup=0, folder=folder)
        return set(taken.contestants.engine)

    assert "ofg k=8 to step 3" in engines("warm") - engines("cold")
    assert "ofg k=8" in engines("coherent") - engines("batch")


def test_a_mesh_is_asked_of_those_that_take_it_as_it_is(folder):
    found = answers(native.run([overlap("mesh", (7, 1, 2))], rounds=1, warmup=0, folder=folder))
    assert len(found) and found.engine.str.contains("repairs=all|verified").all()


def test_a_union_is_asked_by_its_pieces(folder):
    asked = [overlap("union", at) for at in ((9, 1, 2), (0.9, 0.7, 0.5))]
    found = answers(native.run(asked, rounds=1, warmup=0, folder=folder))
    assert set(found.engine) == {"ofg-verified"}
    for query, said in zip(asked, found.sort_values("id").hit):
        assert bool(said) == registry.make("ofg-verified")[0].prepare(query)().hit


def test_the_unit_of_a_method_changes_no_answer_and_no_time(folder, monkeypatch):
    # Powers of two are exact, so OFG asked in another unit says the very same.
    asked = queries()
    plain = answers(native.run(asked, rounds=1, warmup=0, folder=folder))
    monkeypatch.setattr(native.casefile, "lengths", lambda: {"ofg": 1024.0})
    scaled = answers(native.run(asked, rounds=1, warmup=0, folder=folder))
    np.testing.assert_array_equal(plain.hit, scaled.hit)
    np.testing.assert_allclose(plain.time, scaled.time, rtol=1e-5)


def test_a_spoilt_case_file_is_refused(folder, tmp_path):
    plugin = str(folder / "plugins" / "ofg.so")

    def lane(content: bytes, modes: str = "cold") -> str:
        (tmp_path / "cases").write_bytes(content)
        words = [str(folder / "lane"), str(tmp_path / "cases"), str(tmp_path), modes]
        outcome = subprocess.run([*words, "0", "1", plugin], capture_output=True, text=True)
        assert outcome.returncode == 2
        return outcome.stderr

    native.write(tmp_path / "good", queries())
    good = (tmp_path / "good").read_bytes()
    assert "ends too early" in lane(good[:-1])
    assert "no case file" in lane(b"x" * 100)
    foreign = good[:-180] + struct.pack("<I", 99) + good[-176:]
    assert "names a body that is not in the file" in lane(foreign)
    assert "no whole number of blocks" in lane(good[:16] + struct.pack("<I", 3) + good[20:])
    assert "no mode hot" in lane(good, "hot")


def test_what_the_lane_does_not_take(folder, tmp_path):
    with pytest.raises(ValueError, match="blocks of 3"):
        native.write(tmp_path / "cases", queries(), block=3)
    with pytest.raises(native.NativeError, match="ofg-bench native --build"):
        native.run(queries(), folder=tmp_path)
    (tmp_path / "plugins").mkdir()
    (tmp_path / "plugins" / "bad.so").write_text("no library")
    shutil.copy(folder / "lane", tmp_path / "lane")
    with pytest.raises(native.NativeError, match="does not open"):
        native.run(queries(), folder=tmp_path)


def test_the_lane_is_asked_about_relative_motion(tmp_path):
    alone = sweep("translation", "convex", (-5, 0.3, 0.1), (10, 0, 0))
    both = replace(alone, motion=Motion((4, 1, 0)), motion_b=Motion((-6, 1, 0)))
    for name, query in (("alone", alone), ("both", both)):
        native.write(tmp_path / name, [query])
    assert (tmp_path / "alone").read_bytes() == (tmp_path / "both").read_bytes()
    turn = Motion(angle=1)
    turning = replace(alone, question="motion", motion=turn, motion_b=turn)
    with pytest.raises(Unsupported, match="both bodies rotate"):
        native.write(tmp_path / "none", [turning])


def test_an_old_cargo_is_named_with_the_remedy(tmp_path):
    """Debian's cargo is too old for parry's crates: the build failed without a word of that."""
    place = os.pathsep.join([sysconfig.get_path("scripts"), os.environ.get("PATH", "")])
    if not (COMPILER and (cmake := shutil.which("cmake", path=place))):
        pytest.skip("no cmake or no C++ compiler")
    cargo = tmp_path / "cargo"
    cargo.write_text("#!/bin/sh\necho 'cargo 1.65.0 (4bc8f24d3 2022-10-20)'\n")
    cargo.chmod(0o755)
    words = [cmake, "-S", native.SOURCE, "-B", tmp_path / "build", f"-DCARGO={cargo}"]
    subprocess.run(words, check=True, capture_output=True)
    missing = (tmp_path / "build" / "missing.txt").read_text()
    assert re.search(r"^parry: .*cargo is 1\.65\.0, install .* 1\.89 or later", missing, re.M)
