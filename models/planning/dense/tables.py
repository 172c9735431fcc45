"""A factored world flattened into arrays that compiled code can read."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from math import prod
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from models.world import STAY, Factored, FactoredAction, Range

Ints = NDArray[np.int64]


LENGTH = 2_048
"""Most states of a row: its values then stay in the fastest cache."""


ROWS = 256
"""Fewest rows: the states of one do not see what becomes of each other in a sweep."""


class Tables(NamedTuple):
    """Ranges of the valid states and of each action, in CSR fashion; range group 0 is that of the valid states, group
    a + 1 that of action a.

    The variables before `outer` number the rows, the others the places in a row. A table's entry is at `offset` + Σ
    multiplier · digit over the outer variables that it reads; one that reads others too has a value for each place of
    the row there (`inner`).
    """

    radix: Ints  # [outer]
    group: Ints  # [A + 2]  first range of each group; ranges without an inner table come first
    low: Ints  # [R]
    high: Ints  # [R]
    table: Ints  # [R + 1]  first table of each range; those that are not inner come first
    inner: NDArray[np.bool_]  # [T]
    offset: Ints  # [T]
    reads: Ints  # [T + 1]  first variable of each table
    variable: Ints  # [..]
    multiplier: Ints  # [..]
    data: NDArray[np.int16]
    scope: Ints  # [A + 1]  first outer variable of each action's scope
    scope_variable: Ints
    scope_multiplier: Ints
    scope_inner: NDArray[np.bool_]  # [A]
    place_effect: NDArray[np.int32]  # [A, length]  what the place in the row adds to the number of the effect
    first_effect: Ints  # [A]


class Effects(NamedTuple):
    """What an action does, by effect: the action and its outcomes that can happen. The last effect is to stay."""

    action: NDArray[np.int32]  # [F]  index of the action, or STAY
    cost: NDArray[np.float64]  # [F]
    first: NDArray[np.int32]  # [F + 1]
    probability: NDArray[np.float64]
    shift: Ints


@dataclass
class _Building:
    low: list[int]
    high: list[int]
    table: list[int]
    inner: list[bool]
    offset: list[int]
    reads: list[int]
    variable: list[int]
    multiplier: list[int]
    data: list[NDArray[np.int16]]
    size: int = 0


def outer_variables(world: Factored) -> int:
    """How many variables number the rows: as few as leave rows of at most LENGTH states, and ROWS of them or as many as
    there are with one variable in each; one at least.
    """
    outer, rows, length = len(world.radix), prod(world.radix), 1
    while outer > 1 and length * world.radix[outer - 1] <= LENGTH:
        if length > 1 and rows // world.radix[outer - 1] < ROWS:
            break
        outer -= 1
        rows //= world.radix[outer]
        length *= world.radix[outer]
    return outer


def flatten(world: Factored) -> tuple[Tables, Effects]:
    """The arrays of a world; not to be written to, as they are kept for when it is planned in again."""
    return _flatten(world, outer_variables(world))


@lru_cache(maxsize=16)
def _flatten(world: Factored, outer: int) -> tuple[Tables, Effects]:
    made = _Building([], [], [0], [], [], [0], [], [], [])
    group = [0]
    for ranges in (world.valid, *(action.ranges for action in world.actions)):
        for one in sorted(ranges, key=lambda found: any(_reads(table.scope, outer) for table in found.tables)):
            _add_range(made, one, world.radix, outer)
        group.append(len(made.low))
    scope, variables, multipliers, inner, effect = [0], [], [], [], [0]
    places = []
    for action in world.actions:
        within = []
        for position, multiplier in zip(action.scope, _multipliers(action.scope, world.radix), strict=True):
            if position < outer:
                variables.append(position)
                multipliers.append(multiplier)
            else:
                within.append((position, multiplier))
        scope.append(len(variables))
        inner.append(bool(within))
        places.append(_places(within, world.radix, outer))
        effect.append(effect[-1] + action.probability.shape[1])
    tables = Tables(
        radix=_ints(world.radix[:outer]),
        group=_ints(group),
        low=_ints(made.low),
        high=_ints(made.high),
        table=_ints(made.table),
        inner=np.array(made.inner, dtype=np.bool_),
        offset=_ints(made.offset),
        reads=_ints(made.reads),
        variable=_ints(made.variable),
        multiplier=_ints(made.multiplier),
        data=np.concatenate(made.data or [np.zeros(0, dtype=np.int16)]),
        scope=_ints(scope),
        scope_variable=_ints(variables),
        scope_multiplier=_ints(multipliers),
        scope_inner=np.array(inner, dtype=np.bool_),
        place_effect=np.stack(places).astype(np.int32) if places else np.zeros((0, 0), dtype=np.int32),
        first_effect=_ints(effect[:-1]),
    )
    return tables, _effects(world.actions)


def _reads(scope: tuple[int, ...], outer: int) -> bool:
    return bool(scope) and scope[-1] >= outer


def _multipliers(scope: tuple[int, ...], radix: tuple[int, ...]) -> list[int]:
    return [prod(radix[v] for v in scope[place + 1 :]) for place in range(len(scope))]


def _places(within: list[tuple[int, int]], radix: tuple[int, ...], outer: int) -> Ints:
    """[length] Σ multiplier · digit over variables of a row, by place in the row."""
    total = np.zeros((1,) * (len(radix) - outer), dtype=np.int64)
    for position, multiplier in within:
        shape = [radix[v] if v == position else 1 for v in range(outer, len(radix))]
        total = total + (np.arange(radix[position]) * multiplier).reshape(shape)
    return np.broadcast_to(total, radix[outer:]).reshape(-1)


def _ints(values: object) -> Ints:
    return np.array(values, dtype=np.int64).reshape(-1)


def _add_range(made: _Building, one: Range, radix: tuple[int, ...], outer: int) -> None:
    for table in sorted(one.tables, key=lambda found: _reads(found.scope, outer)):
        numbering = [v for v in table.scope if v < outer]
        inner = _reads(table.scope, outer)
        array = np.asarray(table.array, dtype=np.int16)
        if inner:  # a value for each place of the row
            shape = [radix[v] for v in numbering] + [
                radix[v] if v in table.scope else 1 for v in range(outer, len(radix))
            ]
            array = np.broadcast_to(array.reshape(shape), [radix[v] for v in numbering] + list(radix[outer:]))
        length = prod(radix[outer:]) if inner else 1
        made.inner.append(inner)
        made.offset.append(made.size)
        made.data.append(np.ascontiguousarray(array).reshape(-1))
        made.size += len(made.data[-1])
        made.variable += numbering
        made.multiplier += [length * multiplier for multiplier in _multipliers(tuple(numbering), radix)]
        made.reads.append(len(made.variable))
    made.table.append(len(made.inner))
    made.low.append(one.low)
    made.high.append(one.high)


def _effects(actions: tuple[FactoredAction, ...]) -> Effects:
    counts, owner, cost, probability, shift = [], [], [], [], []
    for action in actions:
        happens = action.probability.T > 0  # [entries, k]
        counts.append(happens.sum(axis=1))
        owner.append(np.full(len(happens), action.index, dtype=np.int32))
        cost.append(np.full(len(happens), action.cost))
        probability.append(action.probability.T[happens])
        shift.append(action.shift.T[happens])
    first = np.concatenate([[0], np.cumsum(np.concatenate([*counts, np.ones(1, dtype=np.int64)]))]).astype(np.int32)
    return Effects(
        np.concatenate([*owner, np.array([STAY], dtype=np.int32)]),
        np.concatenate([*cost, np.ones(1)]),
        first,
        np.concatenate([*probability, np.ones(1)]),
        np.concatenate([*shift, np.zeros(1, dtype=np.int64)]).astype(np.int64),
    )


def without_loops(effects: Effects) -> Effects:
    """The same effects with another outcome for sure: to try until the state changes, at what that costs on average.

    Least costs are the same, and lower bounds of them stay so, as c + p v + q w >= v where c/q + w >= v, for the
    probability q = 1 - p that the state changes. What never changes the state is left as it is.
    """
    owner = np.repeat(np.arange(len(effects.cost)), np.diff(effects.first))
    moves = effects.shift != 0
    chance = np.bincount(owner[moves], effects.probability[moves], minlength=len(effects.cost))
    stuck = chance == 0
    chance[stuck] = 1.0
    keep = moves | stuck[owner]
    first = np.concatenate([[0], np.cumsum(np.bincount(owner[keep], minlength=len(effects.cost)))]).astype(np.int32)
    return Effects(
        effects.action,
        effects.cost / chance,
        first,
        effects.probability[keep] / chance[owner[keep]],
        effects.shift[keep],
    )
