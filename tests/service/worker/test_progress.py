"""Progress: what is written is read, not too often, and the rest is the sweeps left at their pace."""

from __future__ import annotations

import math
import threading
from typing import Any

import pytest

from service.worker.progress import INTERVAL_S, SIZE, WINDOW, Meter, Progress, clear, read


class Clock:
    """A clock that stands still until it is set."""

    def __init__(self) -> None:
        self.now = 100.0

    def __call__(self) -> float:
        return self.now


def fresh(**ends: float) -> tuple[list[float], Clock, Meter]:
    board, clock = [0.0] * SIZE, Clock()
    return board, clock, Meter(board, ends=ends, clock=clock)


def rest(board: list[float]) -> float | None:
    found = read(board, 0.0)
    assert found is not None
    return found.remaining_s


def test_an_empty_board_says_nothing() -> None:
    board, _, meter = fresh()
    assert read(board, 1.0) is None
    meter("graph", 1, 0.0, math.inf, 5)
    clear(board)
    assert read(board, 1.0) is None


def test_what_is_written_is_read() -> None:
    board, _, meter = fresh()
    meter("rounds", 7, 0.25, 0.75, 120)
    assert read(board, 3.0) == Progress("rounds", 7, 120, 0.25, 0.75, 3.0, None)


def test_sweeps_are_reported_no_more_often_than_is_looked_at_but_every_stage_is() -> None:
    board, clock, meter = fresh()
    meter("graph", 1, 0.0, math.inf, 5)
    clock.now += INTERVAL_S / 2
    meter("graph", 2, 0.0, math.inf, 5)
    found = read(board, 0.0)
    assert found is not None
    assert found.sweep == 1
    meter("probability", 1, 0.0, 1.0, 5)
    found = read(board, 0.0)
    assert found is not None
    assert (found.stage, found.sweep) == ("probability", 1)


def test_the_rest_is_the_sweeps_left_at_the_pace_of_the_last_ones() -> None:
    """Three sweeps a second: the seven that are left take 7/3 s."""
    board, clock, meter = fresh()
    meter("steps", 1, 0.0, 1.0, 9, 10)
    assert rest(board) is None  # nobody knows yet how long a sweep takes
    for sweep in range(2, 32):
        clock.now += 1 / 3
        meter("steps", sweep, 0.0, 1.0, 9, 7)
    assert rest(board) == pytest.approx(7 / 3)


def test_the_pace_is_that_of_late() -> None:
    board, clock, meter = fresh()
    for sweep in range(1, 2 * WINDOW + 1):
        clock.now += 1 if sweep <= WINDOW else 0.25
        meter("steps", sweep, 0.0, 1.0, 9, 8)
    assert rest(board) == pytest.approx(2)


@pytest.mark.parametrize("left", [math.nan, 0.0])
def test_what_is_not_known_has_no_rest_and_what_is_done_none_left(left: float) -> None:
    board, clock, meter = fresh()
    for sweep in (1, 2):
        clock.now += 1
        meter("graph", sweep, 0.0, math.inf, 9, left)
    assert rest(board) == (0.0 if left == 0 else None)


def test_each_iteration_has_a_pace_of_its_own() -> None:
    """Also one whose beginning was not reported, as it came too soon after the last report."""
    board, clock, meter = fresh()
    meter("probability", 1, 0.0, 1.0, 9, 5)
    clock.now += 10
    meter("probability", 2, 0.0, 1.0, 9, 5)
    assert rest(board) == pytest.approx(50)
    clock.now += INTERVAL_S / 2
    meter("probability", 1, 0.0, 1.0, 9, 5)
    clock.now += 1
    meter("probability", 3, 0.0, 1.0, 9, 4)
    assert rest(board) == pytest.approx(2)
    meter("steps", 1, 0.0, 1.0, 9, 4)
    assert rest(board) is None


def test_a_stage_takes_no_longer_than_it_may() -> None:
    board, clock, meter = fresh(steps=103.0)
    for stage, wanted in (("steps", 1.0), ("compile", 100.0)):
        for sweep in (1, 2):
            clock.now += 1
            meter(stage, sweep, 0.0, 1.0, 9, 100)
        assert rest(board) == pytest.approx(wanted)
    meter("steps", 3, 0.0, 1.0, 9, 100)
    clock.now += 1
    meter("steps", 4, 0.0, 1.0, 9, 100)  # it is over
    assert rest(board) == 0


def test_a_reader_never_sees_half_a_report() -> None:
    board, clock, meter = fresh()
    over = threading.Event()

    def write() -> None:
        number = 0
        while not over.is_set():
            number += 1
            clock.now += 1
            meter("graph", number, number, number, number)

    writer = threading.Thread(target=write)
    writer.start()
    try:
        for _ in range(5_000):
            found = read(board, 0.0)
            assert found is None or found.sweep == found.states == found.lower == found.upper
    finally:
        over.set()
        writer.join()


class Interrupted(list[float]):
    """A board that is written while it is read: when half of a stretch is copied, the next of the `steps` is made."""

    def __init__(self, board: list[float], steps: list[list[tuple[int, float]]]) -> None:
        super().__init__(board)
        self.steps = steps

    def __getitem__(self, place: Any) -> Any:
        if not isinstance(place, slice):
            return super().__getitem__(place)
        places = range(SIZE)[place]
        middle = len(places) // 2
        first = [super(Interrupted, self).__getitem__(one) for one in places[:middle]]
        for number, value in self.steps.pop(0) if self.steps else ():
            self[number] = value
        return first + [super(Interrupted, self).__getitem__(one) for one in places[middle:]]


def test_what_is_half_written_is_not_read() -> None:
    before, _, meter = fresh()
    meter("compile", 1, 0.0, math.inf, 5)
    after = list(before)
    Meter(after)("rounds", 7, 0.25, 0.75, 120)
    after[0] = after[-1] = 2.0
    written = list(enumerate(after))
    board = Interrupted(before, [written[:5], written[5:]])
    assert read(board, 3.0) == Progress("rounds", 7, 120, 0.25, 0.75, 3.0, None)
