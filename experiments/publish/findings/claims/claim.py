# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Claims and findings.

A claim wraps a function of the runs that returns a verdict, the number on which it is based, and
further results. The decorator takes the accompanying text: the claim, its section in the article,
the rule of the verdict, the tables and the limits.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from experiments.publish.findings.runs import UNMEASURED, Missing, Runs

BASIC = "The OFG algorithm"
TIME = "Solving the discrete time problem"
TURN = "Solving for rotating objects"
CONCAVE = "Solving the concavity problem"
PROBLEMS = "Problems with the basic OFG algorithm"


@dataclass(frozen=True)
class Claim:
    title: str
    section: str
    rule: str
    where: tuple[str, ...]
    limits: str
    find: Callable[[Runs], tuple[str, str, str]]


@dataclass(frozen=True)
class Finding:
    claim: Claim
    verdict: str
    number: str
    text: str


def claim(title: str, section: str, rule: str, where: str, limits: str):
    """Turn a function Runs -> (verdict, number, text) into a claim.

    where: paths of tables, separated by blanks; {board} is the run with every family.
    """
    return lambda find: Claim(title, section, rule, tuple(where.split()), limits, find)


def finding(asked: Claim, runs: Runs) -> Finding:
    try:
        return Finding(asked, *asked.find(runs))
    except Missing as reason:
        return Finding(asked, UNMEASURED, str(reason), "")
