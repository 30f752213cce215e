"""What a claim is, and what is found of it.

A claim is made of a function of the runs that returns a verdict, the number that carries it, and
what else was found. The words around it (the claim, where the article makes it, the rule of the
verdict, where the rows are, the limits) are given to the decorator.
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
    """Make a claim of a function Runs -> (verdict, number, text).

    where: tables, with {board} for the run that has every family.
    """
    return lambda find: Claim(title, section, rule, tuple(where.split()), limits, find)


def finding(asked: Claim, runs: Runs) -> Finding:
    try:
        return Finding(asked, *asked.find(runs))
    except Missing as reason:
        return Finding(asked, UNMEASURED, f"not measured ({reason})", "")
