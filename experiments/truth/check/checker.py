# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The independent checker. It believes a label by its certificate alone (see README.md beside this
folder).

A label is split into obligations: convex sets apart over an interval, a point inside a tetrahedron
or a mesh, an exact time. Each is settled in doubles with an error bound (float_filter.py), or else
by rationals and balls (proof.py).
"""

from typing import NamedTuple

import flint

from . import float_filter
from .balls import BITS
from .geometry import Pair
from .obligations import Apart, Refused, Within, Without, obligations
from .proof import apart, within, without


class Check(NamedTuple):
    """ok: the certificate proves the label, its bracket, its start and end, and its gap if
    positive. reason: else why not.
    """

    ok: bool
    reason: str = ""


def check(query, truth) -> Check:
    """Verify a Truth about a Query. Never raises; refuses what it cannot verify. An uncertain
    label makes no claim.
    """
    return check_many([(query, truth)])[0]


def check_many(labelled, doubles=True) -> list[Check]:
    """`check` for (query, truth) pairs, with the double arithmetic in one batch. doubles=False:
    everything by balls (slow).
    """
    verdicts, owed = [], []
    for i, (query, truth) in enumerate(labelled):
        found, verdict = _refusal(_owed, query, truth)
        owed += [(i, o) for o in found or ()]
        verdicts.append(verdict)
    open_ = _settled([o for _, o in owed]) if doubles else _all_open(owed)
    for j, *undecided in open_:
        i, o = owed[j]
        if verdicts[i].ok:
            _, verdicts[i] = _refusal(_shown, o, *undecided)
    return verdicts


def _settled(owed):
    """The obligations that doubles leave open. If the batch fails, all of them: balls then
    settle each one separately, so a forged certificate is refused without affecting the others.
    """
    try:
        return float_filter.settle(owed)
    except Exception:
        return _all_open(owed)


def _all_open(owed):
    return [(j, None, None) for j in range(len(owed))]


def _owed(query, truth):
    return list(obligations(Pair(query), truth, truth.certificate))


def _shown(o, *undecided):
    return {Apart: apart, Within: within, Without: without}[type(o)](o, *undecided)


def _refusal(work, *given):
    """work(*given) and its verdict: refused if it raises, whatever error a forged certificate
    causes.
    """
    try:
        with flint.ctx.workprec(BITS):
            return work(*given), Check(True)
    except Refused as refusal:
        return None, Check(False, str(refusal))
    except Exception as error:
        words = f"{type(error).__name__}: {error}"
        return None, Check(False, f"malformed certificate ({words[:200]})")
