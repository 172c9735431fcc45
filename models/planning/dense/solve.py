"""The least expected cost until a co-safe formula holds, on the dense array of all states.

Only what is sure is solved here: if some state that may reach acceptance cannot do so with probability one, the sparse
stages of `models.planning.planner` take over, which bound probabilities. The search for the sure states is Prob1E
(Forejt, Kwiatkowska, Norman and Parker, "Automated verification techniques for probabilistic systems", SFM 2011), the
costs and their bounds are those of `models.planning.steps`.
"""

from __future__ import annotations

from itertools import pairwise
from math import prod
from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray

from models.logic import Automaton
from models.planning.dense import compression, rows, search
from models.planning.dense.compressed import Compressed, compress
from models.planning.dense.schedule import Schedule, schedule
from models.planning.dense.tables import flatten, outer_variables, without_loops
from models.planning.dense.team import Team
from models.planning.direct import DIRECT_LIMIT
from models.planning.errors import ModelTooLargeError
from models.planning.options import Options, Progress, no_progress
from models.planning.policy import INVALID, NOTHING
from models.planning.solution import Solution, smallest
from models.planning.trend import Trend
from models.world import Factored, IdlingWorld, OomdpWorld, ProjectedWorld, World

RESIDUAL = 1e-8
"""Rise of values, in units of the cheapest action, up to which what leads to them is not looked at again: the relative
error of the costs."""

TIE = 1e-9
"""Relative difference of expected costs within which the first action is taken."""


STATE_BYTES = 16
"""Per state: label (while it is read, 4 bytes and the truth of each atom) and validity."""

ENTRY_BYTES = 40
"""Per entry of a row: its five numbers, twice while their arrays grow."""

ROW_BYTES = 80
"""Per row: first entry and part, what it leads to, how near it is, its place in the order, and when it rose."""

SAMPLE = 32
"""Rows looked at to estimate how many entries there are."""

MEMORY_BYTES = 20
"""Per state and memory: value and cost (16), distance while they are not there yet, action, probability."""


ROUNDOFF = 16 * 2.0**-53
"""Relative error that the worth of a choice with a few outcomes may have in floating point."""

SLOW = 200
"""Sweeps after which a small world is left to the solver that solves linear systems."""

REPEATS = 5
"""Times that a group of rows is swept in succession, at most: while its values are in the cache."""


UNSURE: Final = "unsure"
"""The answer where this solver does not apply."""


def solve(
    world: World,
    automaton: Automaton,
    start: int,
    *,
    options: Options,
    progress: Progress = no_progress,
) -> Solution | Literal["unsure"] | None:
    """A policy that satisfies a co-safe formula for sure wherever that is possible, at the least cost; None where it is
    not possible from `start`, UNSURE where this world or this formula is not one for this solver.

    Raises ModelTooLargeError before allocating.
    """
    if (
        automaton.acceptance
        or options.device == "cuda"
        or not isinstance(world, OomdpWorld | ProjectedWorld | IdlingWorld)
    ):
        return UNSURE
    factored = world.factored
    if factored is None:
        return UNSURE
    after = _memories(automaton)
    _check_bytes(world.size, len(after), factored, options)
    letter = automaton.letters(world.labels(automaton.atoms))
    with Team(world.size * len(after)) as team:
        dense = compress(factored, letter, team)
        letter[~dense.valid] = INVALID
        solver = _Solver(dense, after, team, options, progress)
        row = int(_rows(automaton)[automaton.successors[automaton.initial, letter[start]]])
        return solver.cheapest(letter, row, start, losing=bool(automaton.rejecting.any()))


def _memories(automaton: Automaton) -> NDArray[np.int32]:
    """[R, L] the row after a letter is read in the memory of a row; -1: the formula then holds, -2: it fails."""
    after: NDArray[np.int32] = _rows(automaton)[automaton.successors[_rows(automaton) >= 0]]
    return after


def _rows(automaton: Automaton) -> NDArray[np.int32]:
    """[Q] the row of each memory; -1 where the formula holds, -2 where it fails."""
    live = ~(automaton.accepting | automaton.rejecting)
    number = np.where(automaton.accepting, -1, -2).astype(np.int32)
    number[live] = np.arange(int(live.sum()), dtype=np.int32)
    return number


def _settled(after: NDArray[np.int32]) -> bool:
    """Whether to read a letter twice is always the same as to read it once: a state that does not change then leaves
    the memory as it is too.
    """
    once = np.maximum(after, 0)
    twice = np.take_along_axis(after, once, axis=0)
    return bool(((after < 0) | (twice == after)).all())


def _check_bytes(states: int, live: int, world: Factored, options: Options) -> None:
    """The entries of the rows are estimated from evenly spaced ones."""
    tables, effects = flatten(world)
    length = prod(world.radix[outer_variables(world) :])
    count = states // length
    sample = np.unique(np.linspace(0, count - 1, SAMPLE).astype(np.int64)).tolist()
    entries = sum(len(compression.compress(tables, effects, length, 1, row)[1][0]) for row in sample) / len(sample)
    estimate = states * (STATE_BYTES + live * MEMORY_BYTES) + int(count * (ROW_BYTES + entries * ENTRY_BYTES))
    if estimate > options.max_bytes:
        raise ModelTooLargeError(
            f"planning needs about {estimate} bytes ({states * live} product states); the limit is {options.max_bytes}",
            estimate=estimate,
            limit=options.max_bytes,
            unit="bytes",
        )


class _Solver:
    """One problem: a world in rows, the rows of the memories after reading a letter, and who works on it."""

    def __init__(
        self, world: Compressed, after: NDArray[np.int32], team: Team, options: Options, progress: Progress
    ) -> None:
        self._world, self._after, self._team = world, after, team
        self._options, self._progress = options, progress
        self._moving = without_loops(world.effects) if _settled(after) else world.effects
        self._count = len(world.rows.first_entry) - 1

    def sure_distance(self, *, losing: bool) -> NDArray[np.int32] | None:
        """[R, S] by memory before reading, the fewest steps that may lead to acceptance while it stays sure; None if it
        is possible somewhere and not sure.
        """
        distance = self._search(np.zeros((0, 0), dtype=np.bool_))
        if not losing and search.all_reached(self._world.rows, self._world.valid, self._after, distance):
            return distance
        possible = distance < search.INFINITE
        distance = self._search(possible)
        return distance if ((distance < search.INFINITE) == possible).all() else None

    def _search(self, inside: NDArray[np.bool_]) -> NDArray[np.int32]:
        """[R, S] by memory before reading, the fewest steps that may lead to acceptance."""
        world, effects, valid, after = self._world.rows, self._world.effects, self._world.valid, self._after
        distance = np.full((len(after), len(self._world.valid)), search.INFINITE, dtype=np.int32)
        looked, altered = np.zeros(self._count, dtype=np.int64), np.full(self._count, -1, dtype=np.int64)
        search.accept(world, valid, after, distance, altered)
        sweep, changed = 0, 1
        while changed:
            sweep += 1

            def some(begin: int, end: int, sweep: int = sweep) -> int:
                arguments = (distance, inside, sweep, looked, altered, begin, end)
                return int(search.approach(world, effects, valid, after, *arguments))

            changed = sum(self._team.share(some, 0, self._count))
            self._progress("graph", sweep, 0.0, np.inf, changed)
        return distance

    def cheapest(
        self, letter: NDArray[np.int32], row: int, start: int, *, losing: bool
    ) -> Solution | Literal["unsure"] | None:
        """The cheapest policy where acceptance is sure; None where it is impossible in state `start`, which is entered
        with the memory of `row` (-1: accepted, -2: failed).
        """
        distance = self.sure_distance(losing=losing)
        if distance is None:
            return UNSURE
        least = float(self._world.effects.cost.min())
        plan = schedule(self._world.rows, self._world.radix, search.nearness(self._world.rows, distance))
        value = np.empty(distance.shape)
        search.begin_at(distance, least, value)
        del distance
        ticks = np.zeros((2, self._count), dtype=np.int64)
        trend = Trend(0.5, most=self._options.max_sweeps)  # fewer than one value rises
        for sweep in self._options.sweeps("steps"):
            rising = self._sweep(value, plan, RESIDUAL * least, ticks, sweep)
            self._progress("steps", sweep, 0.0, np.inf, value.size, trend.left(rising))
            if not rising:
                break
            if sweep == SLOW and value.size <= DIRECT_LIMIT:
                return UNSURE  # small enough to be solved directly
        for tie in (TIE, 0.0):
            action, steps, excess = self._choose(value, tie)
            rounding = self._rounding(float(steps.max(initial=0)))
            excess += rounding
            if excess < least:
                break
        else:
            return UNSURE  # a policy that loses a step at every step need not arrive
        if row == -2 or (row >= 0 and action[row, start] == NOTHING):
            return None
        reached = float(steps[row, start]) if row >= 0 else 0.0
        return Solution(
            letter=smallest(letter),
            action=action,
            probability=(action != NOTHING).astype(np.int8),
            expected_steps=steps,
            lower=1.0,
            upper=1.0,
            steps=(max(0.0, reached - excess) / (1.0 + rounding / least), reached / (1.0 - excess / least)),
            component=None,
            rounds=np.zeros((0, 2)),
        )

    def _rounding(self, greatest: float) -> float:
        """How much the worth of a choice may be off in floating point; whole numbers are exact."""
        effects = self._world.effects
        exact = bool((effects.probability == 1).all() and (effects.cost == np.floor(effects.cost)).all())
        return 0.0 if exact else ROUNDOFF * greatest

    def _sweep(
        self, value: NDArray[np.float64], plan: Schedule, residual: float, ticks: NDArray[np.int64], sweep: int
    ) -> int:
        """Raise all values, nearest rows first, so that most of a value is there after one sweep; returns how many rose
        by more than `residual`. `ticks` [2, rows] tells when a row was looked at and when it rose. Threads share the
        groups of a level, which comes to the same as one group after the other.
        """
        tick = (sweep - 1) * REPEATS * self._count + 1
        looked, rose = ticks
        world = (self._world.rows, self._moving, self._after)
        where = (value.reshape(-1), residual, plan.order, plan.group, REPEATS)

        def some(begin: int, end: int) -> int:
            return int(rows.sweep(*world, *where, looked, rose, tick, begin, end))

        if not plan.parallel:
            return some(0, len(plan.group) - 1)
        return sum(sum(self._team.share(some, begin, end)) for begin, end in pairwise(plan.level.tolist()))

    def _choose(self, value: NDArray[np.float64], tie: float) -> tuple[NDArray[np.int16], NDArray[np.float64], float]:
        """[R, S] actions and costs after reading, and how far the costs exceed the values at most."""
        world, effects, valid, after = self._world.rows, self._world.effects, self._world.valid, self._after
        action = np.empty(value.shape, dtype=np.int16)  # MAX_GROUNDINGS fit
        steps = np.empty(value.shape)
        flat = (value.reshape(-1), tie, action.reshape(-1), steps.reshape(-1))

        def some(begin: int, end: int) -> float:
            return float(rows.choose(world, effects, valid, after, *flat, begin, end))

        return action, steps, max(self._team.share(some, 0, self._count))
