# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Exceptions that a method may raise."""

from __future__ import annotations

import re
import warnings

from baselines.contract import MissingEngine, Unsupported, Verdict

from .kind import ERROR, OK, kind


class _Panic(BaseException):
    """The exception that pyo3 raises when Rust panicked."""


class _Mute(Exception):
    def __str__(self):
        raise RuntimeError("I have no words")

    __repr__ = __str__


class _NotText(Exception):
    def __str__(self):
        return 7


class _Bound(Exception):
    """It can be pickled, but not unpickled."""

    def __init__(self, one, two):
        super().__init__(f"{one} {two}")
        self.keep = lambda: one


def _raising(name: str, error):
    def act(query, call):
        raise error()

    act.__name__ = name
    kind(ERROR)(act)


for _name, _error in {
    "raises_an_exception": lambda: RuntimeError("the engine said no"),
    "raises_without_words": RuntimeError,
    "raises_blank_lines": lambda: RuntimeError("\n\n"),
    "raises_base_exception": lambda: BaseException("not even an Exception"),
    "raises_a_panic": lambda: _Panic("called `Option::unwrap()` on a `None` value"),
    "raises_keyboard_interrupt": KeyboardInterrupt,
    "raises_generator_exit": GeneratorExit,
    "raises_stop_iteration": StopIteration,
    "raises_memory_error": MemoryError,
    "raises_system_exit": lambda: SystemExit("words in place of a code"),
    "raises_value_error": lambda: ValueError("no bad input of the user's"),
    "raises_eof_error": EOFError,
    "raises_a_surrogate": lambda: RuntimeError("caf\udce9"),
    "raises_control_characters": lambda: RuntimeError("\x1b[2J\x00[bold]x[/nothing]"),
    "raises_huge_words": lambda: RuntimeError("x" * 50_000_000),
    "raises_what_has_no_words": _Mute,
    "raises_what_is_no_text": _NotText,
    "raises_what_cannot_be_pickled": lambda: _Bound(1, 2),
    "raises_a_group": lambda: BaseExceptionGroup(
        "many", [KeyboardInterrupt(), RuntimeError("one")]
    ),
}.items():
    _raising(_name, _error)


def _refusing(name: str, error):
    def act(query, call):
        raise error

    act.__name__ = name
    kind("unsupported")(act)


_refusing("refuses_with_a_surrogate", Unsupported("caf\udce9"))
_refusing("misses_an_engine_with_markup", MissingEngine("[/bold] [link=x]"))


@kind(ERROR)
def raises_recursion_error(query, call):
    return raises_recursion_error(query, call)


@kind(ERROR, built=True)
def raises_in_prepare(query, call):
    raise RuntimeError("not even built")


@kind(ERROR, built=True)
def leaves_in_prepare(query, call):
    raise SystemExit(0)


@kind(OK)
def raises_at_the_second_call(query, call):
    if call > 1:
        raise RuntimeError("once was enough")
    return Verdict(True)


@kind(OK)
def panics_at_the_second_call(query, call):
    if call > 1:
        raise _Panic("once was enough")
    return Verdict(True)


@kind(OK, ERROR)
def warnings_are_errors(query, call):
    warnings.simplefilter("error")
    return Verdict(True)


@kind(ERROR)
def writes_to_its_query(query, call):
    for array in (query.a.vertices, query.a.faces, query.b.vertices, query.b.faces):
        array[:] = 0  # they are read-only, and numpy raises an error
    return Verdict(True)


@kind(ERROR)
def sets_what_is_frozen(query, call):
    query.pose_a = query.pose_b
    return Verdict(True)


@kind(ERROR)
def bad_pattern(query, call):
    re.compile("(" * 10)
