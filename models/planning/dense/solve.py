"""The least expected cost until a co-safe formula holds, on the dense array of all states.

Only what is sure is solved here: if some state that may reach acceptance cannot do so with probability one, the sparse
stages of `models.planning.planner` take over, which bound probabilities. The search for the sure states is Prob1E
(Forejt, Kwiatkowska, Norman and Parker, "Automated verification techniques for probabilistic systems", SFM 2011), the
costs and their bounds are those of `models.planning.steps`.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import prod
from typing import Any, Final, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from models.logic import Automaton
from models.planning.dense import compression, rows
from models.planning.dense.tables import Effects, flatten, outer_variables
from models.planning.dense.team import Team
from models.planning.direct import DIRECT_LIMIT
from models.planning.errors import ModelTooLargeError
from models.planning.options import Options, Progress, no_progress
from models.planning.policy import INVALID, NOTHING
from models.planning.solution import Solution, smallest
from models.world import Factored, OomdpWorld, ProjectedWorld, World

RESIDUAL = 1e-8
"""Rise in a sweep, in units of the cheapest action, at which iteration stops: the relative error of the costs."""

TIE = 1e-9
"""Relative difference of expected costs within which the first action is taken."""


STATE_BYTES = 16
"""Per state: label (while it is read, 4 bytes and the truth of each atom) and validity."""

ENTRY_BYTES = 24
"""Per entry of a row: effect, begin and end, twice while their arrays grow."""

SAMPLE = 32
"""Rows looked at to estimate how many entries there are."""

MEMORY_BYTES = 20
"""Per state and memory: value and cost (16), distance while they are not there yet, action, probability."""


ROUNDOFF = 16 * 2.0**-53
"""Relative error that the worth of a choice with a few outcomes may have in floating point."""

SLOW = 200
"""Sweeps after which a small world is left to the solver that solves linear systems."""

BLOCKS_FROM = 5_000_000
"""Product states from which the rows of a sweep are taken in blocks: threads then save more than it takes to start
them, and than the sweeps that are needed more because the rows of a block are raised together."""

BLOCK = 128
"""Rows of a block."""


class Rows(NamedTuple):
    """The entries and the parts of every row; the index of a state is row · length + its place in the row."""

    length: int
    first_entry: NDArray[np.int64]  # [rows + 1]
    effect: NDArray[np.int32]
    begin: NDArray[np.int32]
    end: NDArray[np.int32]
    first_part: NDArray[np.int64]  # [rows + 1]
    part_begin: NDArray[np.int32]
    part_end: NDArray[np.int32]
    letter: NDArray[np.int32]


@dataclass(frozen=True, slots=True, eq=False)
class Compressed:
    """A world as rows of entries, and which of its states are valid."""

    rows: Rows
    effects: Effects
    valid: NDArray[np.bool_]  # [S]


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
    if automaton.acceptance or options.device == "cuda" or not isinstance(world, OomdpWorld | ProjectedWorld):
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


def compress(world: Factored, letter: NDArray[np.signedinteger], team: Team | None = None) -> Compressed:
    """The rows of a world whose states read `letter` ([S])."""
    tables, effects = flatten(world)
    length = prod(world.radix[outer_variables(world) :])
    count = len(letter) // length

    def some(begin: int, end: int) -> tuple[NDArray[Any], ...]:
        found: tuple[NDArray[Any], ...] = compression.compress(tables, effects, length, end - begin, begin)
        return found

    parts = [some(0, count)] if team is None else team.share(some, 0, count)
    offset = np.cumsum([0, *(len(part[1]) for part in parts)])
    first = np.concatenate([[0], *(part[0][1:] + before for part, before in zip(parts, offset, strict=False))])
    effect, begin, end, valid = (_joined([part[k] for part in parts]) for k in range(1, 5))
    pieces = compression.split(letter, valid, length, count)
    return Compressed(Rows(length, first, effect, begin, end, *pieces), effects, valid)


def _joined(parts: list[NDArray[Any]]) -> NDArray[Any]:
    return parts[0] if len(parts) == 1 else np.concatenate(parts)


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


def _check_bytes(states: int, live: int, world: Factored, options: Options) -> None:
    """The entries of the rows are estimated from evenly spaced ones."""
    tables, effects = flatten(world)
    length = prod(world.radix[outer_variables(world) :])
    count = states // length
    sample = np.unique(np.linspace(0, count - 1, SAMPLE).astype(np.int64)).tolist()
    entries = sum(len(compression.compress(tables, effects, length, 1, row)[1]) for row in sample) / len(sample)
    estimate = states * (STATE_BYTES + live * MEMORY_BYTES) + int(count * entries) * ENTRY_BYTES
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
        self._count = len(world.rows.first_entry) - 1

    def sure_distance(self, *, losing: bool) -> NDArray[np.int32] | None:
        """[R, S] by memory before reading, the fewest steps that may lead to acceptance while it stays sure; None if it
        is possible somewhere and not sure.
        """
        distance = self._search(np.zeros((0, 0), dtype=np.bool_))
        if not losing and rows.all_reached(self._world.rows, self._after, distance):
            return distance
        possible = distance < rows.INFINITE
        distance = self._search(possible)
        return distance if ((distance < rows.INFINITE) == possible).all() else None

    def _search(self, inside: NDArray[np.bool_]) -> NDArray[np.int32]:
        """[R, S] by memory before reading, the fewest steps that may lead to acceptance."""
        world, effects, after = self._world.rows, self._world.effects, self._after
        distance = np.full((len(after), len(self._world.valid)), rows.INFINITE, dtype=np.int32)
        rows.accept(world, after, distance)
        sweep, changed = 0, 1
        while changed:
            sweep += 1

            def some(begin: int, end: int, backwards: bool = sweep % 2 == 0) -> int:
                return int(rows.approach(world, effects, after, distance, inside, backwards, begin, end))

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
        order = np.argsort(rows.nearness(self._world.rows, distance), kind="stable")
        value = np.empty(distance.shape)
        rows.begin_at(distance, least, value)
        del distance
        for sweep in range(1, self._options.max_sweeps + 1):
            rise = self._sweep(value, order)
            self._progress("steps", sweep, 0.0, np.inf, value.size)
            if rise <= RESIDUAL * least:
                break
            if sweep == SLOW and value.size <= DIRECT_LIMIT:
                return UNSURE  # small enough to be solved directly
        for tie in (TIE, 0.0):
            action, steps, excess = self._choose(value, tie)
            excess += self._rounding(float(steps.max(initial=0)))
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
            steps=(max(0.0, reached - excess), reached / (1.0 - excess / least)),
            component=None,
            rounds=np.zeros((0, 2)),
        )

    def _rounding(self, greatest: float) -> float:
        """How much the worth of a choice may be off in floating point; whole numbers are exact."""
        effects = self._world.effects
        exact = bool((effects.probability == 1).all() and (effects.cost == np.floor(effects.cost)).all())
        return 0.0 if exact else ROUNDOFF * greatest

    def _sweep(self, value: NDArray[np.float64], order: NDArray[np.intp]) -> float:
        """Raise all values once, nearest rows first, so that most of a value is there after one sweep; returns the
        greatest rise. In a large world threads share a block of rows, which do not see what becomes of each other.
        """
        world, effects, after = self._world.rows, self._world.effects, self._after
        flat, rise = value.reshape(-1), 0.0
        if value.size < BLOCKS_FROM:
            return float(rows.lift_all(world, effects, after, flat, effects.cost, order))
        found = np.empty((BLOCK, len(after), world.length))
        for first in range(0, self._count, BLOCK):
            last = min(first + BLOCK, self._count)

            def look(begin: int, end: int, first: int = first) -> None:
                rows.look_ahead(world, effects, after, flat, effects.cost, order, begin, end, found[begin - first :])

            def lift(begin: int, end: int, first: int = first) -> float:
                return float(rows.lift(world, after, flat, order, begin, end, found[begin - first :]))

            self._team.share(look, first, last)
            rise = max(rise, *self._team.share(lift, first, last))
        return rise

    def _choose(self, value: NDArray[np.float64], tie: float) -> tuple[NDArray[np.int16], NDArray[np.float64], float]:
        """[R, S] actions and costs after reading, and how far the costs exceed the values at most."""
        world, effects, after = self._world.rows, self._world.effects, self._after
        action = np.empty(value.shape, dtype=np.int16)  # MAX_GROUNDINGS fit
        steps = np.empty(value.shape)
        flat = (value.reshape(-1), effects.cost, tie, action.reshape(-1), steps.reshape(-1))

        def some(begin: int, end: int) -> float:
            return float(rows.choose(world, effects, after, *flat, begin, end))

        return action, steps, max(self._team.share(some, 0, self._count))
