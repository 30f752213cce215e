# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Progress of a run and its remaining time: a bar per stage on a terminal, occasional lines
elsewhere.
"""

from __future__ import annotations

import contextlib
import time
from collections.abc import Callable, Iterator

from rich.console import Console
from rich.markup import escape
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    ProgressColumn,
    Task,
    TextColumn,
    TimeElapsedColumn,
)
from rich.text import Text

console = Console(stderr=True)
LINE = 60.0  # seconds between lines without a terminal


def say(text: str) -> None:
    """Print a notice to the user on stderr."""
    console.print(text, markup=False, highlight=False)


class Forecast:
    """Remaining seconds of a run of several stages, from the plan for each and the speed of the
    work so far.

    plan: stage -> expected seconds of work. A stage may give a better estimate when it begins. As a
    stage progresses, measurements replace its plan; later stages are scaled by the error of the
    plan so far.
    """

    def __init__(self, plan: dict[str, float], clock: Callable[[], float] = time.monotonic):
        self.plan, self.clock = dict(plan), clock
        self.done = dict.fromkeys(plan, 0.0)  # share of each stage
        self.spent = dict.fromkeys(plan, 0.0)
        self.already = dict.fromkeys(plan, 0.0)  # share done by an earlier, interrupted run
        self.foreseen: dict[
            str, tuple[float, float]
        ] = {}  # stage -> remaining seconds, and when they were estimated
        self.current, self.since = "", 0.0  # "": between two stages
        self.history: list[tuple[float, float]] = []  # seconds elapsed, estimated seconds left

    def begin(self, name: str, seconds: float | None = None, skipped: float = 0.0) -> None:
        """seconds: a better estimate than the plan. skipped: the share done by an earlier,
        interrupted run.
        """
        self.plan[name] = self.plan.get(name, 0.0) if seconds is None else seconds
        self.done[name], self.already[name], self.spent[name] = skipped, skipped, 0.0
        self.foreseen.pop(name, None)
        self.current, self.since = name, self.clock()

    def foresee(self, name: str, seconds: float) -> None:
        """Set the remaining time of a stage from a better estimate than plan and pace give;
        valid until it is set again, or the stage begins.
        """
        self.foreseen[name] = seconds, self.clock()

    def advance(self, share: float) -> None:
        self.done[self.current] = min(1.0, self.done[self.current] + share)
        self.spent[self.current] = self.clock() - self.since
        self.history.append((sum(self.spent.values()), self.left()))

    def end(self) -> None:
        self.done[self.current], self.spent[self.current] = 1.0, self.clock() - self.since
        self.current = ""

    def left(self) -> float:
        total = 0.0
        for name, planned in self.plan.items():
            todo = 1.0 - self.done[name]
            if name in self.foreseen and todo:
                seconds, said = self.foreseen[name]
                total += max(0.0, seconds - (self.clock() - said if name == self.current else 0.0))
            elif name == self.current:
                since_told = self.clock() - self.since - self.spent[name]
                total += max(0.0, todo * self._pace(planned) - since_told)
            else:
                total += todo * planned * (1.0 if self.spent[name] else self._slowness())
        return total

    def _slowness(self) -> float:
        """Seconds taken over seconds planned so far, by which later stages are scaled; within a
        factor of 4, because plans are rough.
        """
        planned = sum(
            self.plan[name] * (self.done[name] - self.already[name])
            for name in self.plan
            if self.spent[name]
        )
        spent = sum(self.spent.values())
        trust = min(1.0, spent / 10.0)  # the first seconds are not informative
        return 1.0 + trust * (min(4.0, max(0.25, spent / planned)) - 1.0) if planned > 0 else 1.0

    def _pace(self, planned: float) -> float:
        """Seconds for the whole current stage: the plan at its beginning, the measurement once a
        tenth of it is done.
        """
        gone = self.done[self.current] - self.already[self.current]
        if gone <= 0:
            return planned
        trust = min(1.0, gone / 0.1)
        return trust * self.spent[self.current] / gone + (1 - trust) * planned

    def at_half(self) -> tuple[float, float] | None:
        """The displayed and the actual remaining time in the middle of the run; None for a very
        short run.
        """
        gone = sum(self.spent.values())
        told = [(at, left) for at, left in self.history if at <= gone / 2]
        return (
            (max(0.0, told[-1][1] - (gone / 2 - told[-1][0])), gone / 2)
            if told and gone > 1
            else None
        )


class _Left(ProgressColumn):
    def __init__(self, forecast: Forecast):
        super().__init__()
        self.forecast = forecast

    def render(self, task: Task) -> Text:
        return Text(
            "" if task.finished else f"run: {spoken(self.forecast.left())} left", style="cyan"
        )


_running: Forecast | None = None


@contextlib.contextmanager
def forecast(plan: dict[str, float]) -> Iterator[Forecast]:
    """Treat the stages inside as those of one run, whose remaining time is shown beside each."""
    global _running
    before, _running = _running, Forecast(plan)
    try:
        yield _running
    finally:
        _running = before


@contextlib.contextmanager
def stage(
    title: str, total: float, done: int = 0, seconds: float | None = None
) -> Iterator[Callable[[float], None]]:
    """Yields advance(n), n of `total`. done: finished earlier. seconds: the expected duration of
    the stage, if known.
    """
    whole = _running or Forecast({title: seconds or 0.0})
    whole.begin(title, seconds, done / total if total else 1.0)
    columns = (
        TextColumn("{task.description:<22}"),
        BarColumn(28),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        _Left(whole),
    )
    last = whole.clock()
    with Progress(*columns, console=console, disable=not console.is_terminal) as progress:
        bar = progress.add_task(title, total=total, completed=done)

        def advance(n: float) -> None:
            nonlocal last
            progress.advance(bar, n)
            whole.advance(n / total)
            if not console.is_terminal and whole.clock() - last >= LINE:
                last = whole.clock()
                console.print(
                    f"{escape(title)}: {100 * whole.done[title]:.0f} %; run: {spoken(whole.left())}"
                    " left",
                    highlight=False,
                )

        yield advance
    whole.end()


def spoken(seconds: float) -> str:
    """'35 s', '12 min', '1 h 20 min'."""
    if seconds < 90:
        return f"{seconds:.0f} s"
    minutes = round(seconds / 60)
    return f"{minutes} min" if minutes < 60 else f"{minutes // 60} h {minutes % 60} min"
