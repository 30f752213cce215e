# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""A drill that cannot fail is worthless: each way of going wrong has a mutant, and the drill must
tell.
"""

import sys
from pathlib import Path
from random import Random

import pytest

from experiments.drill import __main__ as drill
from experiments.drill import command, faults, kin, measure, volume
from experiments.drill.command import Attempt, Bench, Ending
from experiments.drill.outcome import EQUAL, FAILED, HONEST, Outcome, settle
from experiments.drill.tally import Tally

RUNNER = Path(__file__).with_name("runner.py")
KILL_WORKER = faults.killed(kin.WORKER)
pytestmark = pytest.mark.skipif(not Path("/proc/self/environ").exists(), reason="needs /proc")


def _bench(mutant, tmp_path):
    bench = Bench((sys.executable, str(RUNNER), mutant), tmp_path / "none.toml")
    return measure.undisturbed(bench, tmp_path / "undisturbed")[0]


def _struck(strike, mutant, tmp_path, draws=20):
    """The outcome of the first draw that strikes."""
    bench = _bench(mutant, tmp_path)
    for draw in range(draws):
        try:
            return strike(Attempt(bench, tmp_path / str(draw)), Random(draw))
        except faults.Missed:
            pass
    raise AssertionError("the fault never struck")


def test_work_done_again_is_equal(tmp_path):
    assert _struck(KILL_WORKER, "again", tmp_path).kind == EQUAL


def test_a_stop_with_a_reason_is_honest(tmp_path):
    outcome = _struck(KILL_WORKER, "stops and says why", tmp_path)
    assert outcome.kind == HONEST and "killed twice" in outcome.why


@pytest.mark.parametrize(
    "mutant, why",
    [
        ("turns it into data", "other bytes: cases.parquet"),
        ("leaves an orphan", "left behind"),
        ("raises", "traceback"),
        ("stops without a word", "without a reason"),
        ("ends with a code of its own", "exit code 3"),
    ],
)
def test_a_mutant_fails(mutant, why, tmp_path):
    outcome = _struck(KILL_WORKER, mutant, tmp_path)
    assert outcome.kind == FAILED and why in outcome.why


def test_a_hang_fails_and_leaves_nothing(tmp_path, monkeypatch):
    monkeypatch.setattr(command.Bench, "patience", 5.0)
    outcome = _struck(KILL_WORKER, "hangs", tmp_path)
    assert outcome == Outcome(FAILED, "it hung")


def test_a_refusal_of_the_same_command_fails(tmp_path):
    attempt = Attempt(_bench("refuses the folder", tmp_path), tmp_path / "one")
    attempt.folder.mkdir()
    outcome = settle(attempt, Ending(-9, ""), frozenset({-9}))
    assert outcome.kind == FAILED and "it refused with 1: Error. The folder" in outcome.why


def test_a_killed_runner_that_works_again_is_equal(tmp_path):
    assert _struck(faults.signalled(9, {-9}), "again", tmp_path).kind == EQUAL


def test_a_signal_that_was_not_sent_is_no_excuse(tmp_path):
    attempt = Attempt(_bench("again", tmp_path), tmp_path / "one")
    assert settle(attempt, Ending(-9, "")).kind == FAILED
    assert settle(attempt, Ending(-9, ""), frozenset({-9})).kind == EQUAL


def test_words_are_asked_of_a_stop(tmp_path):
    """The fork server's death ended a run with 'Aborted.', which click says of any EOFError."""
    attempt = Attempt(_bench("again", tmp_path), tmp_path / "one")
    assert settle(attempt, Ending(1, "Aborted.")).kind == FAILED


def test_a_run_that_fails_undisturbed_cannot_be_drilled(tmp_path):
    bench = Bench((sys.executable, "-c", "raise SystemExit('no engine is here')"), tmp_path)
    with pytest.raises(measure.Undrillable, match="no engine is here"):
        measure.undisturbed(bench, tmp_path / "undisturbed")


def test_a_process_is_found_in_a_session_of_its_own(tmp_path):
    leave = "import os, time; os.fork() and os._exit(0); os.setsid(); time.sleep(60)"
    (tmp_path / "tmp").mkdir()
    running = command.Running([sys.executable, "-c", leave], tmp_path, tmp_path / "tmp")
    assert len(running.finish(30.0).orphans) == 1
    assert not running.everything()


@pytest.mark.parametrize("strike", [faults.full_disk, faults.full_temporary, faults.read_only])
def test_nothing_stays_mounted(strike, tmp_path):
    bench = _bench("again", tmp_path)
    strike(Attempt(bench, tmp_path / "one"), Random(1))
    assert str(tmp_path) not in Path("/proc/mounts").read_text()


def test_a_small_disk_is_full(tmp_path):
    if not volume.mountable():
        pytest.skip("nothing can be mounted here")
    with volume.small(tmp_path, 4096), pytest.raises(OSError):
        (tmp_path / "file").write_bytes(bytes(1 << 16))


def test_the_table_counts_each_outcome_and_tells_alike_ones_once():
    tally = Tally()
    tally.name("kill", "")
    for outcome in (Outcome(EQUAL), Outcome(FAILED, "it hung"), Outcome(FAILED, "it hung"), None):
        tally.add("kill", "try 0", outcome)
    assert tally.failed == 2 and tally.text().split()[-6:] == ["kill", "3", "1", "0", "2", "1"]
    assert tally.reasons() == ["kill, 2 x failed: it hung"]


def test_a_fault_that_never_struck_has_shown_nothing():
    tally = Tally()
    tally.name("kill", "")
    tally.add("kill", "try 0", None)
    assert tally.failed == 1


def test_the_command_says_what_failed(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(drill, "DRAWS", 3)
    words = ["--only", "of a worker", "--tries", "1", "--out", str(tmp_path / "drill.md")]
    program = ["--program", sys.executable, str(RUNNER)]
    assert drill.main([*words, *program, "turns it into data"]) == 1
    assert "other bytes" in capsys.readouterr().out
    assert "| kill -9 of a worker" in (tmp_path / "drill.md").read_text()
    assert drill.main([*words, *program, "again"]) == 0
    assert drill.main(["--only", "no such fault"]) == 2


def test_a_runner_that_has_ended_is_no_process(tmp_path):
    """The drill ended with NoSuchProcess where a run was over at the drawn moment."""
    running = command.Running([sys.executable, "-c", ""], tmp_path, tmp_path)
    assert [p.pid for p in running.runner()] in ([running.process.pid], [])
    running.finish(30.0)
    assert running.runner() == []
