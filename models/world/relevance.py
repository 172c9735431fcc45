"""The part of a world that a formula can depend on.

A variable matters when an atom reads it, and so does whatever decides how one that matters changes. A guard that reads
others only to forbid ("nothing is held") does not make them matter when they stand where they forbid the least: the
world with them left there, and without the actions that only move them, does everything the whole world does. It
simulates the whole world up to steps in which nothing that matters changes, so for a co-safe formula that such steps
cannot change (stutter-invariant: Peled and Wilke, "Stutter-invariant temporal properties are expressible without the
next-time operator", 1997) it has the same probability and the same fewest steps. This is the cone of influence of
model checking (Clarke, Grumberg and Peled, "Model Checking", 1999, 13.1), with guards read one-sidedly.

For other formulas such steps may count: to be kept where it is, the robot may need a toy to play with. `relevant_parts`
gives ever larger parts to try for them; `models.world.idling` bounds what a part may miss.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from math import prod

import numpy as np
from numpy.typing import NDArray

from models.logic.formula import Atom
from models.world.factors import Factored, FactoredAction, Range
from models.world.oomdp import OomdpWorld
from models.world.projection import ProjectedWorld, Projection, restricted


def relevant_part(world: OomdpWorld, atoms: Sequence[Atom], start: int) -> ProjectedWorld | None:
    """The part of a world, from a state on, that a stutter-invariant co-safe formula over `atoms` depends on; None
    where that is all of it, or not known.
    """
    factored = world.factored
    if factored is None:
        return None
    digits = _digits(factored, start)
    kept = _closure(factored, world.reads(atoms), digits)
    if len(kept) == len(factored.radix):
        return None
    return _projected(world, factored, kept, digits, start)


def relevant_parts(world: OomdpWorld, atoms: Sequence[Atom], start: int) -> Iterator[ProjectedWorld]:
    """Ever larger parts of a world, from a state on, for any formula over `atoms`: the first as `relevant_part`, each
    further one with what the smallest action moves that the one before leaves out. None of them is the whole world.

    What a part does, step by step, the whole world does from there too; actions without any effect are in every part.
    Where nothing is possible in the part, something that is left out may be possible in the world.
    """
    factored = world.factored
    if factored is None:
        return
    digits = _digits(factored, start)
    kept = _closure(factored, world.reads(atoms) or {0}, digits)
    while prod(factored.radix[v] for v in kept) < world.size:
        yield _projected(world, factored, kept, digits, start, idle=True)
        more = _moved_beside(factored, kept)
        if not more:
            return
        kept = _closure(factored, kept | more, digits)


def _digits(world: Factored, state: int) -> list[int]:
    return [state // stride % radix for stride, radix in zip(world.strides, world.radix, strict=True)]


def _moved_beside(world: Factored, kept: set[int]) -> frozenset[int]:
    """What the action moves that moves nothing kept and touches the fewest combinations of other values."""
    best, least = frozenset[int](), 0
    for action in world.actions:
        if action.changes & kept or not any(world.radix[v] > 1 for v in action.changes):
            continue
        touched = {*action.changes, *action.scope, *(v for one in action.ranges for v in one.reads)}
        combinations = prod(world.radix[v] for v in touched - kept)
        if not best or combinations < least:
            best, least = action.changes, combinations
    return best


def _projected(
    world: OomdpWorld, factored: Factored, kept: set[int], digits: list[int], start: int, *, idle: bool = False
) -> ProjectedWorld:
    """The world of the variables `kept`; with `idle`, it has the actions without any effect."""
    order = tuple(sorted(kept)) or (0,)
    acting = [
        action if action.changes else _without_effect(action)
        for action in factored.actions
        if (action.changes & kept or (idle and not action.changes))
        and all(one.reads & kept or _holds(one, digits) for one in action.ranges)
    ]
    ranges = [one for group in (factored.valid, *(action.ranges for action in acting)) for one in group]
    harmless = tuple(
        tuple(range(radix)) if v in order else _harmless(ranges, v, radix, digits[v])
        for v, radix in enumerate(factored.radix)
    )
    projection = Projection(order, start, factored.radix, factored.strides, harmless)
    return ProjectedWorld(world, restricted(factored, acting, projection), projection)


def _without_effect(action: FactoredAction) -> FactoredAction:
    """An action that changes nothing reads nothing but its guard."""
    return replace(action, scope=(), probability=np.ones((1, 1)), shift=np.zeros((1, 1), dtype=np.int64))


def _closure(world: Factored, atoms: Iterable[int], digits: list[int]) -> set[int]:
    """The variables that matter when those of the atoms do."""
    kept = set(atoms)
    while True:
        more = set(kept)
        for action in world.actions:
            if action.changes & kept:
                more.update(action.scope, action.changes, *(_forbidding(one, kept, digits) for one in action.ranges))
        more.update(*(_forbidding(one, kept, digits) for one in world.valid if one.reads & kept))
        if more == kept:
            return kept
        kept = more


def _holds(one: Range, digits: list[int]) -> bool:
    """Whether a range holds in the state with these digits."""
    total = sum(int(table.array[tuple(digits[v] for v in table.scope)]) for table in one.tables)
    return one.low <= total <= one.high


def _forbidding(one: Range, kept: set[int], digits: list[int]) -> set[int]:
    """The variables of a range, beside those kept, that could be better placed than they are."""
    least = sum(int(table.array.min()) for table in one.tables)
    most = sum(int(table.array.max()) for table in one.tables)
    found: set[int] = set()
    for table in one.tables:
        axes = [axis for axis, v in enumerate(table.scope) if v not in kept]

        def better(array: NDArray[np.int16], among: list[int]) -> bool:
            here = array
            for axis in among:
                here = here.take([digits[table.scope[axis]]], axis=axis)  # noqa: B023  # called within the iteration
            return bool((one.high < most and (here > array).any()) or (one.low > least and (here < array).any()))

        array = table.array
        if not better(array, axes):
            continue
        for axis in axes:
            if better(array, [axis]):
                found.add(table.scope[axis])
            else:  # it stands best, whatever the others do
                array = array.take([digits[table.scope[axis]]], axis=axis)
    return found


def _harmless(ranges: Iterable[Range], variable: int, radix: int, digit: int) -> tuple[int, ...]:
    """The digits of a variable that is not kept which no range can tell from the one where it stays."""
    same = np.ones(radix, dtype=np.bool_)
    for one in ranges:
        for table in one.tables:
            if variable in table.scope:
                values = np.moveaxis(table.array, table.scope.index(variable), 0).reshape(radix, -1)
                same &= (values == values[digit]).all(axis=1)
    return tuple(np.flatnonzero(same).tolist())
