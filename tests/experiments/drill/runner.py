# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""A runner in miniature for the drill's tests: it works in one child process, and goes wrong in
the way it is told to.

Its first word is what it does when the child is killed: "again" works again, as it should; the
others are the mutants.
"""

import ctypes
import os
import signal
import sys
import time
from pathlib import Path

MUTANT, OUT = sys.argv[1], Path(sys.argv[sys.argv.index("--out") + 1])
FILES = ("cases.parquet", "bodies.parquet", "observations.parquet")


def finish(answer: str) -> None:
    OUT.mkdir(parents=True, exist_ok=True)
    for name in FILES:
        OUT.joinpath(name).write_text(answer)
    sys.exit(0)


def work() -> int:
    """How the child ended, as waitpid says it."""
    child = os.fork()
    if child == 0:
        ctypes.CDLL(None).prctl(1, signal.SIGKILL)  # PR_SET_PDEATHSIG: it dies with the runner
        time.sleep(0.6)
        os._exit(0)
    return os.waitpid(child, 0)[1]


if MUTANT == "refuses the folder" and OUT.exists():
    sys.exit("Error. The folder is not empty and holds no run.")
OUT.mkdir(parents=True, exist_ok=True)
if work():
    if MUTANT == "turns it into data":
        finish("uncertain")
    if MUTANT == "hangs":
        time.sleep(3600)
    if MUTANT == "leaves an orphan" and os.fork() == 0:
        time.sleep(3600)
    if MUTANT == "raises":
        raise RuntimeError("a worker died")
    if MUTANT == "stops without a word":
        sys.exit(1)
    if MUTANT == "stops and says why":
        sys.exit("Error. The worker was killed twice; say the same command again.")
    if MUTANT == "ends with a code of its own":
        os._exit(3)
    while work():
        pass
finish("hit")
