"""Progress: what is written is read, not too often, and the rest is estimated from how bounds close."""

from __future__ import annotations

import math
import threading

import pytest

from service.worker.progress import INTERVAL_S, SIZE, Meter, Progress, clear, read


class Clock:
    """A clock that stands still until it is set."""

    def __init__(self) -> None:
        self.now = 100.0

    def __call__(self) -> float:
        return self.now


def fresh(epsilon: float = 1e-6) -> tuple[list[float], Clock, Meter]:
    board, clock = [0.0] * SIZE, Clock()
    return board, clock, Meter(board, epsilon=epsilon, clock=clock)


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


@pytest.mark.parametrize(("stage", "epsilon", "aim"), [("probability", 1e-6, 1e-6), ("steps", 1e-3, 1e-8)])
def test_the_rest_of_a_gap_that_shrinks_evenly_is_known(stage: str, epsilon: float, aim: float) -> None:
    """The gap halves every second, so from g it takes log2(g / aim) seconds."""
    board, clock, meter = fresh(epsilon)
    for second in range(10):
        clock.now = 100.0 + second
        meter(stage, second + 1, 0.5, 0.5 + 2.0**-second, 9)
    found = read(board, 9.0)
    assert found is not None
    assert found.remaining_s is not None
    assert found.remaining_s == pytest.approx(math.log2(2.0**-9 / aim), rel=1e-6)


def test_no_estimate_where_the_bounds_do_not_close() -> None:
    board, clock, meter = fresh()
    for lower, upper in ((0.1, 1.0), (0.1, 1.0), (0.5, math.inf)):
        clock.now += 1
        meter("probability", 1, lower, upper, 9)
        found = read(board, 0.0)
        assert found is not None
        assert found.remaining_s is None


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
