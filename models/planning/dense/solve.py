"""The least expected cost until a co-safe formula holds, on the dense array of all states.

Only what is sure is solved here: if some state that may reach acceptance cannot do so with probability one, the sparse
stages of `models.planning.planner` take over, which bound probabilities. The search for the sure states is Prob1E
(Forejt, Kwiatkowska, Norman and Parker, "Automated verification techniques for probabilistic systems", SFM 2011), the
costs and their bounds are those of `models.planning.steps`.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import prod
from typing import Final, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from models.logic import Automaton
from models.planning.dense import rows
from models.planning.dense.tables import Effects, flatten, outer_variables
from models.planning.errors import ModelTooLargeError
from models.planning.options import Options, Progress, no_progress
from models.planning.policy import INVALID, NOTHING
from models.planning.solution import Solution, smallest
from models.world import Factored, OomdpWorld, ProjectedWorld, World

RESIDUAL = 1e-9
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
    dense = compress(factored, letter)
    letter[~dense.valid] = INVALID
    distance = _sure_distance(dense, after, bool(automaton.rejecting.any()), progress)
    if distance is None:
        return UNSURE
    row = int(_rows(automaton)[automaton.successors[automaton.initial, letter[start]]])
    return _cheapest(dense, after, letter, (row, start), distance, options, progress)


def compress(world: Factored, letter: NDArray[np.signedinteger]) -> Compressed:
    """The rows of a world whose states read `letter` ([S])."""
    tables, effects = flatten(world)
    length = prod(world.radix[outer_variables(world) :])
    count = len(letter) // length
    first, effect, begin, end, valid = rows.compress(tables, effects, length, count, 0)
    parts = rows.split(letter, valid, length, count)
    return Compressed(Rows(length, first, effect, begin, end, *parts), effects, valid)


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
    entries = sum(len(rows.compress(tables, effects, length, 1, row)[1]) for row in sample) / len(sample)
    estimate = states * (STATE_BYTES + live * MEMORY_BYTES) + int(count * entries) * ENTRY_BYTES
    if estimate > options.max_bytes:
        raise ModelTooLargeError(
            f"planning needs about {estimate} bytes ({states * live} product states); the limit is {options.max_bytes}",
            estimate=estimate,
            limit=options.max_bytes,
            unit="bytes",
        )


def _sure_distance(
    world: Compressed, after: NDArray[np.int32], losing: bool, progress: Progress
) -> NDArray[np.int32] | None:
    """[R, S] by memory before reading, the fewest steps that may lead to acceptance while it stays sure; None if it is
    possible somewhere and not sure.
    """
    distance = _search(world, after, np.zeros((0, 0), dtype=np.bool_), progress)
    if not losing and rows.all_reached(world.rows, after, distance):
        return distance
    possible = inside = distance < rows.INFINITE
    while True:
        distance = _search(world, after, inside, progress)
        fewer = distance < rows.INFINITE
        if (fewer == inside).all():
            return distance if (inside == possible).all() else None
        inside = fewer


def _search(
    world: Compressed, after: NDArray[np.int32], inside: NDArray[np.bool_], progress: Progress
) -> NDArray[np.int32]:
    """[R, S] by memory before reading, the fewest steps that may lead to acceptance."""
    distance = np.full((len(after), len(world.valid)), rows.INFINITE, dtype=np.int32)
    rows.accept(world.rows, after, distance)
    sweep, changed = 0, 1
    while changed:
        sweep += 1
        changed = rows.approach(world.rows, world.effects, after, distance, inside, sweep % 2 == 0)
        progress("graph", sweep, 0.0, np.inf, changed)
    return distance


def _cheapest(
    world: Compressed,
    after: NDArray[np.int32],
    letter: NDArray[np.signedinteger],
    begin: tuple[int, int],
    distance: NDArray[np.int32],
    options: Options,
    progress: Progress,
) -> Solution | None:
    """Iterate from the distances up, nearest rows first, so that most of a value is there after one sweep."""
    cost = world.effects.cost
    least = float(cost.min())
    order = np.argsort(rows.nearness(world.rows, distance), kind="stable")
    value = np.where(distance < rows.INFINITE, distance * least, np.inf)
    del distance
    for sweep in range(1, options.max_sweeps + 1):
        rise = rows.lift(world.rows, world.effects, after, value.reshape(-1), cost, order)
        progress("steps", sweep, 0.0, np.inf, value.size)
        if rise <= RESIDUAL * least:
            break
    action = np.empty(value.shape, dtype=np.int16)  # MAX_GROUNDINGS fit
    steps = np.empty(value.shape)
    excess = rows.choose(
        world.rows, world.effects, after, value.reshape(-1), cost, TIE, action.reshape(-1), steps.reshape(-1)
    )
    error = float(excess) / least
    row, start = begin
    sure = 1.0 if row == -1 else float(row >= 0 and action[row, start] != NOTHING)
    if not sure:
        return None
    reached = float(steps[row, start]) if row >= 0 else 0.0
    return Solution(
        letter=smallest(letter),
        action=action,
        probability=(action != NOTHING).astype(np.int8),
        expected_steps=steps,
        lower=1.0,
        upper=1.0,
        steps=(max(0.0, reached - float(excess)), reached / (1.0 - error) if error < 1.0 else np.inf),
        component=None,
        rounds=np.zeros((0, 2)),
    )
