"""The native lane: its case file, its protocol and its errors, with the one engine that is always
at hand.
"""

import fcntl
import os
import shutil
import struct
import subprocess
from dataclasses import replace

import numpy as np
import pytest

from baselines import native, registry
from baselines.conformance import body, overlap, sweep
from baselines.contract import Unsupported
from ofg import Motion, Pose, Query

COMPILER = shutil.which("c++")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """`lane` and OFG's plugin, compiled without cmake and without any other engine."""
    if not COMPILER:
        pytest.skip("no C++ compiler called c++")
    base = tmp_path_factory.getbasetemp()
    to = (
        base.parent if "PYTEST_XDIST_WORKER" in os.environ else base
    ) / "native"  # one for all workers
    (to / "plugins").mkdir(parents=True, exist_ok=True)
    with open(to / "lock", "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not (to / "done").exists():
            _compile(to)
            (to / "done").touch()
    return to


def _compile(to):
    flags = [
        COMPILER,
        "-std=c++20",
        "-O0",
        "-I",
        str(native.SOURCE),
        "-I",
        str(native.SOURCE.parents[1] / "ofg" / "include"),
    ]
    subprocess.run(
        [*flags, str(native.SOURCE / "main.cpp"), "-o", str(to / "lane"), "-ldl"], check=True
    )
    subprocess.run(
        [
            *flags,
            "-fPIC",
            "-shared",
            "-ffp-contract=off",
            str(native.SOURCE / "ofg.cpp"),
            "-o",
            str(to / "plugins" / "ofg.so"),
        ],
        check=True,
    )


def queries() -> list[Query]:
    turning = Query(
        "motion",
        body("convex"),
        body("mesh"),
        Pose((2, 0, 0, 0.5), (-5, 0.1, 0)),
        Pose((1, 1, 0, 0)),
        Motion((10, 0, 0), (0, 0, 3), 1.0),
    )
    return [
        overlap("convex", (7, 1, 2)),
        overlap("convex", (0.9, 0.7, 0.5)),
        sweep("translation", "convex", (-5, 0.3, 0.1), (10, 0, 0)),
        turning,
    ]


def test_both_lanes_say_the_same(folder):
    asked = queries()
    rows = native.run(asked, rounds=4, warmup=1, folder=folder)
    assert set(rows.engine) == {"(floor)", "ofg k=4", "ofg k=8", "ofg k=16"}
    for label, group in rows[rows.engine != native.FLOOR].groupby("engine"):
        (method,) = registry.make(label)
        expected = [method.prepare(query)() for query in asked]
        assert list(group.case) == [0, 1, 2, 3]
        assert (
            [bool(h) for h in group.hit] == [v.hit for v in expected] == [False, True, True, True]
        )
        np.testing.assert_array_equal(group.time, [v.time for v in expected])


def test_every_round_of_every_case_has_a_time(folder):
    rows = native.run(queries(), rounds=4, warmup=1, folder=folder)
    times = rows.filter(like="round")
    assert times.shape == (4 * 4, 4) and (times > 0).all().all()


def test_a_spoilt_case_file_is_refused(folder, tmp_path):
    def lane(content: bytes) -> str:
        (tmp_path / "cases").write_bytes(content)
        words = [
            str(folder / "lane"),
            str(tmp_path / "cases"),
            str(tmp_path / "results"),
            "0",
            "1",
            str(folder / "plugins" / "ofg.so"),
        ]
        outcome = subprocess.run(words, capture_output=True, text=True)
        assert outcome.returncode == 2
        return outcome.stderr

    native.write(tmp_path / "good", queries())
    good = (tmp_path / "good").read_bytes()
    assert "ends too early" in lane(good[:-1])
    assert "no case file" in lane(b"x" * 100)
    assert "names a body that is not in the file" in lane(
        good[:-180] + struct.pack("<I", 99) + good[-176:]
    )


def test_what_the_lane_does_not_take(folder, tmp_path):
    with pytest.raises(ValueError, match="union"):
        native.write(tmp_path / "cases", [overlap("union", (3, 0, 0))])
    with pytest.raises(native.NativeError, match="make native"):
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
    turning = replace(alone, question="motion", motion=Motion(angle=1), motion_b=Motion(angle=1))
    with pytest.raises(Unsupported, match="both bodies rotate"):
        native.write(tmp_path / "none", [turning])
