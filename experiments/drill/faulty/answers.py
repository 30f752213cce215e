# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Values that a method may return in place of a verdict."""

from __future__ import annotations

import math

import numpy as np

from baselines.contract import Verdict

from .kind import ERROR, OK, kind


class _NoTruth:
    def __bool__(self):
        raise ValueError("I am neither true nor false")


class _NoWords:
    def __bool__(self):
        raise TypeError("no")

    def __str__(self):
        raise RuntimeError("I have no words")

    __repr__ = __str__


class _NoHit(Verdict):
    def __getattribute__(self, name):
        if name in ("hit", "time"):
            raise LookupError(f"my {name} is a secret")
        return super().__getattribute__(name)


class _NoEnd:
    def __del__(self):
        raise RuntimeError("not deleted")


@kind(ERROR)
def returns_none(query, call):
    return None


@kind(ERROR)
def returns_a_bool(query, call):
    return True


@kind(ERROR)
def returns_the_class(query, call):
    return Verdict


@kind(ERROR)
def returns_a_generator(query, call):
    return (Verdict(True) for _ in range(1))


@kind(ERROR)
def hit_is_none(query, call):
    return Verdict(None)


@kind(ERROR)
def hit_is_a_word(query, call):
    return Verdict("no")


@kind(ERROR)
def hit_is_an_array(query, call):
    return Verdict(np.array([True, False]))


@kind(ERROR)
def hit_is_an_empty_array(query, call):
    return Verdict(np.array([], dtype=bool))


@kind(ERROR)
def hit_is_nan(query, call):
    return Verdict(math.nan)


@kind(ERROR)
def hit_has_no_truth(query, call):
    return Verdict(_NoTruth())


@kind(ERROR)
def hit_has_no_words(query, call):
    return Verdict(_NoWords())


@kind(ERROR)
def hit_cannot_be_pickled(query, call):
    return Verdict(lambda: True)


@kind(ERROR)
def time_is_none(query, call):
    return Verdict(True, None)


@kind(ERROR)
def time_is_a_word(query, call):
    return Verdict(True, "soon")


@kind(ERROR)
def time_is_an_array(query, call):
    return Verdict(True, np.array([0.1, 0.2]))


@kind(ERROR)
def time_is_complex(query, call):
    return Verdict(True, 1j)


@kind(OK)
def time_is_nan(query, call):
    return Verdict(True, math.nan)


@kind(ERROR)
def time_is_infinite(query, call):
    return Verdict(True, 1e400)


@kind(ERROR)
def time_is_huge(query, call):
    return Verdict(True, 10**400)


@kind(ERROR)
def time_is_before(query, call):
    return Verdict(True, -1)


@kind(ERROR)
def time_is_after(query, call):
    return Verdict(True, 2)


@kind(OK)
def answers_in_numpy(query, call):  # which is allowed
    return Verdict(np.bool_(True), np.float32(0.5))


@kind(ERROR)
def verdict_raises(query, call):
    return _NoHit(True)


@kind(OK, ERROR)
def verdict_dies_loudly(query, call):
    return Verdict(True, type("_Time", (float, _NoEnd), {})(0.5))


@kind(OK)
def second_answer_is_none(query, call):
    return Verdict(True) if call == 1 else None
