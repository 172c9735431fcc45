"""How far a plan is: written by the process that plans, read by the one that asked for it.

The two share eight floating-point numbers. The first and the last count writes, and are read in the other order than
they are written: where they differ, the reader came between, and reads again.
"""

from __future__ import annotations

import math
import time
from collections import deque
from collections.abc import Callable, Mapping, MutableSequence
from dataclasses import dataclass

STAGES = ("compile", "graph", "rounds", "probability", "steps", "evaluate")
"""The stages of planning, `models.planning.options.Stage`, as they are numbered on the board."""

ITERATING = ("rounds", "probability", "steps")
"""Those that sweep over values until they settle."""

SIZE = 8
"""Numbers on a board."""

INTERVAL_S = 0.05
"""Least time between two reports; planning tells of every sweep."""

WINDOW = 40
"""Reports that the time of a sweep is taken over."""

READS = 100
"""Times that a torn board is read again before it counts as empty."""

Board = MutableSequence[float]
"""`SIZE` numbers in memory that two processes share."""


@dataclass(frozen=True, slots=True)
class Progress:
    """What a plan is at: the stage, the sweep of the stage, the states that a sweep updates, bounds of the value that
    the stage computes (`upper` infinite while there is none), seconds since it started, and the seconds that the stage
    still needs: the sweeps left by `models.planning.trend`, each as long as the last ones were, but no longer than the
    stage may take. None before there is a rate, and in what only knows at its end how much it had to look at: searches.
    """

    stage: str
    sweep: int
    states: int
    lower: float
    upper: float
    elapsed_s: float
    remaining_s: float | None


def clear(board: Board) -> None:
    """Leave nothing of an earlier plan on the board."""
    board[:] = [0.0] * SIZE


def read(board: Board, elapsed_s: float) -> Progress | None:
    """What the board says; None before the first report."""
    for _ in range(READS):
        last = board[SIZE - 1]
        stage, sweep, states, lower, upper, remaining = board[1 : SIZE - 1]
        if board[0] == last:
            break
    else:
        return None
    if last == 0:
        return None
    rest = None if math.isnan(remaining) else remaining
    return Progress(STAGES[int(stage)], int(sweep), int(states), lower, upper, elapsed_s, rest)


class Meter:
    """Puts the progress of a plan on a board, not more often than is looked at; a `models.planning.Progress`."""

    def __init__(
        self, board: Board, *, ends: Mapping[str, float] | None = None, clock: Callable[[], float] = time.monotonic
    ) -> None:
        """`ends` are the times of the clock at which stages are ended, done or not."""
        self._board, self._clock, self._ends = board, clock, ends or {}
        self._stage, self._sweep, self._next, self._count = "", 0, -math.inf, 0
        self._told: deque[tuple[float, int]] = deque(maxlen=WINDOW)  # time, sweep
        self.sweeps = 0
        """Sweeps of value iteration so far, those of all stages that iterate."""

    def __call__(
        self, stage: str, sweep: int, lower: float, upper: float, states: int, left: float = math.nan, /
    ) -> None:
        """Report a sweep."""
        self.sweeps += stage in ITERATING
        now = self._clock()
        same = stage == self._stage
        if not same or sweep < self._sweep:  # an iteration begins
            self._told.clear()
            self._told.append((now, sweep))
        self._stage, self._sweep = stage, sweep
        if same and now < self._next:
            return
        self._next = now + INTERVAL_S
        self._write(stage, sweep, states, lower, upper, self._remaining(now, sweep, left))

    def _write(self, stage: str, *numbers: float) -> None:
        self._count += 1
        self._board[0] = self._count
        for place, number in enumerate((STAGES.index(stage), *numbers), start=1):
            self._board[place] = number
        self._board[SIZE - 1] = self._count

    def _remaining(self, now: float, sweep: int, left: float) -> float:
        """Seconds that so many sweeps take, at the pace of the last ones."""
        self._told.append((now, sweep))
        begun, first = self._told[0]
        if left == 0:
            return 0.0
        if math.isnan(left) or sweep <= first:
            return math.nan
        return min(left * (now - begun) / (sweep - first), max(0.0, self._ends.get(self._stage, math.inf) - now))
