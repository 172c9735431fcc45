"""How far a plan is: written by the process that plans, read by the one that asked for it.

The two share eight floating-point numbers. The first and the last count writes: where they differ, the reader came
between, and reads again.
"""

from __future__ import annotations

import math
import time
from collections import deque
from collections.abc import Callable, MutableSequence
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
"""Reports that the estimate of the rest looks back on."""

STEPS_PRECISION = 1e-8
"""Relative gap at which expected steps are done (`models.planning.steps.RESIDUAL`)."""

READS = 100
"""Times that a torn board is read again before it counts as empty."""

Board = MutableSequence[float]
"""`SIZE` numbers in memory that two processes share."""


@dataclass(frozen=True, slots=True)
class Progress:
    """What a plan is at: the stage, the sweep of the stage, the states that a sweep updates, bounds of the value that
    the stage computes (`upper` infinite while there is none), seconds since it started, and the seconds that the stage
    still needs, judging by how its bounds have closed so far; None where they tell nothing.
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
        first, stage, sweep, states, lower, upper, remaining, last = board[:]
        if first == last:
            break
    else:
        return None
    if first == 0:
        return None
    rest = None if math.isnan(remaining) else remaining
    return Progress(STAGES[int(stage)], int(sweep), int(states), lower, upper, elapsed_s, rest)


class Meter:
    """Puts the progress of a plan on a board, not more often than is looked at; a `models.planning.Progress`."""

    def __init__(self, board: Board, *, epsilon: float, clock: Callable[[], float] = time.monotonic) -> None:
        self._board, self._clock = board, clock
        self._target = {"probability": epsilon, "steps": min(STEPS_PRECISION, epsilon)}
        self._stage, self._next, self._count = "", -math.inf, 0
        self.sweeps = 0
        """Sweeps of value iteration so far, those of all stages that iterate."""
        self._gaps: deque[tuple[float, float]] = deque(maxlen=WINDOW)  # time, logarithm of the gap

    def __call__(self, stage: str, sweep: int, lower: float, upper: float, states: int, /) -> None:
        """Report a sweep."""
        self.sweeps += stage in ITERATING
        now = self._clock()
        if now < self._next and stage == self._stage:
            return
        if stage != self._stage:
            self._stage = stage
            self._gaps.clear()
        self._next = now + INTERVAL_S
        self._write(stage, sweep, states, lower, upper, self._remaining(now, lower, upper))

    def _write(self, stage: str, *numbers: float) -> None:
        self._count += 1
        self._board[0] = self._count
        for place, number in enumerate((STAGES.index(stage), *numbers), start=1):
            self._board[place] = number
        self._board[SIZE - 1] = self._count

    def _remaining(self, now: float, lower: float, upper: float) -> float:
        """Seconds until the gap of the bounds is what the stage aims at, if it goes on closing at the same rate."""
        target = self._target.get(self._stage)
        gap = upper - lower if self._stage == "probability" else (upper - lower) / max(lower, 1.0)
        if target is None or not 0 < gap < math.inf:
            self._gaps.clear()
            return math.nan
        self._gaps.append((now, math.log(gap)))
        (begun, wide), (_, narrow) = self._gaps[0], self._gaps[-1]
        if narrow >= wide or now <= begun:
            return math.nan
        return max(0.0, (narrow - math.log(target)) * (now - begun) / (wide - narrow))
