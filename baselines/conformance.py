# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The conformance suite: checks the properties of a method in processes that may crash.

`ofg-bench check METHOD` and the tests run it.
"""

from __future__ import annotations

import faulthandler
import multiprocessing
import os
import signal
from collections.abc import Callable, Iterator

from .contract import Method
from .properties import (
    about_a_point,
    b_turns,
    beyond_tolerance,
    both_translate,
    contained,
    declaration,
    far_and_near,
    head_on,
    moved_together,
    notch,
    refuses,
    same_again,
    translation_is_motion,
    turn_together,
    turns,
)


def check(method: Method, seconds: float = 60.0) -> list[tuple[str, bool, str]]:
    """(property, whether it holds, what is wrong) for every property. A crash fails the property
    in which it happened, and so does a hang of more than `seconds`.
    """
    results: list[tuple[str, bool, str]] = []
    while len(results) < len(PROPERTIES):
        results += _in_child(method, PROPERTIES[len(results) :], seconds)
    return results


def _in_child(method: Method, properties, seconds: float) -> list[tuple[str, bool, str]]:
    context = multiprocessing.get_context("fork")
    receive, send = context.Pipe(duplex=False)
    child = context.Process(target=_run, args=(method, properties, send), daemon=True)
    child.start()
    send.close()
    results = []
    for title, _ in properties:
        if not receive.poll(seconds):
            child.kill()
            child.join()
            return results + [(title, False, f"no answer within {seconds:g} s")]
        try:
            results.append(receive.recv())
        except EOFError:
            child.join()
            return results + [(title, False, f"the process died: {_death(child.exitcode)}")]
    child.join()
    return results


def _run(method: Method, properties, send) -> None:
    faulthandler.disable()  # the parent reports the crash
    null = os.open(os.devnull, os.O_WRONLY)
    os.dup2(null, 1), os.dup2(null, 2)
    for title, holds in properties:
        try:
            faults = list(holds(method))
        except Exception as error:
            faults = [f"{type(error).__name__}: {error}"]
        more = [f"and {len(faults) - 3} more"] if len(faults) > 3 else []
        send.send((title, not faults, "; ".join(faults[:3] + more)))


def _death(code: int | None) -> str:
    return signal.Signals(-code).name if code and code < 0 else f"exit code {code}"


PROPERTIES: list[tuple[str, Callable[[Method], Iterator[str]]]] = [
    ("declares itself", declaration),
    ("far apart is clear, deep overlap is a hit", far_and_near),
    ("contained bodies are detected by solid methods only", contained),
    ("the notch of a concave body is empty", notch),
    ("clear beyond its tolerance", beyond_tolerance),
    ("hits a head-on sweep at its time", head_on),
    ("gives the same answer again", same_again),
    ("does not depend on the frame", moved_together),
    ("refuses what it does not declare", refuses),
    ("a translation is a motion without rotation", translation_is_motion),
    ("detects what a rotating bar hits", turns),
    ("detects a body that moves towards it", both_translate),
    ("detects what B hits as it rotates", b_turns),
    ("detects no contact between bodies that rotate together", turn_together),
    ("rotates about the given point", about_a_point),
]
