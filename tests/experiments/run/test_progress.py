# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The time left of a run, on a clock of the test's own."""

import pytest

from experiments.run.progress import Forecast, spoken


class Clock:
    now = 0.0

    def __call__(self):
        return self.now


def walk(plan, real, steps=40, better=None):
    """A run whose stages take `real` seconds; the forecast after it. better: what stages know of
    themselves when they begin.
    """
    clock = Clock()
    forecast = Forecast(plan, clock)
    for name, seconds in real.items():
        forecast.begin(name, (better or {}).get(name))
        for _ in range(steps):
            clock.now += seconds / steps
            forecast.advance(1 / steps)
        forecast.end()
    return forecast


@pytest.mark.parametrize("slow", [0.5, 1.0, 3.0])
def test_half_way_it_is_right_whatever_the_machine(slow):
    plan = {"a": 20.0, "b": 50.0, "c": 30.0}
    said, was = walk(plan, {name: slow * seconds for name, seconds in plan.items()}).at_half()
    assert abs(said - was) < 0.2 * was


def test_what_a_stage_knows_takes_the_place_of_a_plan_that_was_wrong():
    real = {"a": 40.0, "b": 5.0, "c": 55.0}
    said, was = walk({"a": 40.0, "b": 10.0, "c": 5.0}, real, better={"c": 55.0}).at_half()
    assert abs(said - was) < 0.2 * was


def test_it_counts_down_between_two_steps_and_ends_at_nothing():
    clock = Clock()
    forecast = Forecast({"a": 100.0}, clock)
    forecast.begin("a")
    clock.now = 20.0
    forecast.advance(0.2)
    assert forecast.left() == pytest.approx(80)
    clock.now = 30.0
    assert forecast.left() == pytest.approx(70)
    forecast.advance(0.8)
    forecast.end()
    assert forecast.left() == 0


def test_what_an_interrupted_run_had_done_does_not_make_the_rest_look_fast():
    clock = Clock()
    forecast = Forecast({"a": 100.0}, clock)
    forecast.begin("a", skipped=0.5)
    clock.now = 25.0
    forecast.advance(0.25)
    assert forecast.left() == pytest.approx(25)


@pytest.mark.parametrize("seconds, words", [(35, "35 s"), (700, "12 min"), (4800, "1 h 20 min")])
def test_spoken(seconds, words):
    assert spoken(seconds) == words


def test_what_is_foreseen_takes_the_place_of_plan_and_pace():
    clock = Clock()
    forecast = Forecast({"a": 10.0, "b": 10.0}, clock)
    forecast.begin("a")
    forecast.foresee("a", 60.0)
    forecast.foresee("b", 100.0)
    clock.now = 20.0
    assert forecast.left() == pytest.approx(40 + 100)
    forecast.advance(1.0)
    forecast.end()
    assert forecast.left() == pytest.approx(100)
    forecast.begin("b", 80.0)  # which knows still better
    assert forecast.left() == pytest.approx(80)


def test_at_half_is_what_stood_on_the_screen_then():
    """A stage of one long last step: nothing was said after its first half, and "0 s left" at its
    end is no forecast.
    """
    clock = Clock()
    forecast = Forecast({"a": 100.0}, clock)
    forecast.begin("a")
    clock.now = 10.0
    forecast.advance(0.1)
    clock.now = 100.0
    forecast.advance(0.9)
    forecast.end()
    assert forecast.at_half() == (pytest.approx(50), pytest.approx(50))
