"""A world's dynamics as small tables: what a planner needs to know all transitions without listing them.

A guard is brought into a conjunction of *ranges*: a sum of small tables that lies between two numbers. "All of these
hold", "none of these holds" and "at most one of these holds" are ranges, however many variables they read.
"""

from __future__ import annotations

import operator
from collections.abc import Callable
from dataclasses import dataclass
from itertools import chain

import numpy as np
from numpy.typing import NDArray

from models.world.actions import GroundedAction
from models.world.algebra import Algebra, Combined, Table, Value
from models.world.transitions import scaled

WIDE = 2**16
"""Entries of a table of an action or a range: what has no better form is tabulated up to this size."""

UNBOUNDED = 2**30
"""Upper end of a range without one."""


@dataclass(frozen=True, slots=True, eq=False)
class Range:
    """`low` <= the sum of the tables (whole numbers) <= `high`."""

    tables: tuple[Table, ...]
    low: int
    high: int

    @property
    def reads(self) -> frozenset[int]:
        """The positions of the variables that it reads."""
        return frozenset(v for table in self.tables for v in table.scope)


@dataclass(frozen=True, slots=True, eq=False)
class FactoredAction:
    """One grounded action: possible where all `ranges` hold; outcome k happens with `probability[k]` and adds
    `shift[k]` to the state's index, both by the values of the variables of `scope` (ascending positions).
    """

    index: int
    ranges: tuple[Range, ...]
    scope: tuple[int, ...]
    probability: NDArray[np.float64]  # [k, entries]
    shift: NDArray[np.int64]  # [k, entries]; 0 where the probability is 0
    changes: frozenset[int]  # positions of the variables that it may set
    cost: float


@dataclass(frozen=True, slots=True, eq=False)
class Factored:
    """A world as small tables. A state is valid where all of `valid` hold."""

    radix: tuple[int, ...]
    strides: tuple[int, ...]
    valid: tuple[Range, ...]
    actions: tuple[FactoredAction, ...]


def factor(
    algebra: Algebra, strides: tuple[int, ...], valid: Value, actions: tuple[GroundedAction, ...]
) -> Factored | None:
    """The tables of a world, or None where a guard or an effect has no such form."""
    allowed = ranges_of(algebra, valid)
    if allowed is None:
        return None
    made = []
    for index, action in enumerate(actions):
        found = _action(algebra, index, action)
        if found is None:
            return None
        made.append(found)
    return Factored(algebra.radix, strides, allowed, tuple(made))


def _action(algebra: Algebra, index: int, action: GroundedAction) -> FactoredAction | None:
    guard = ranges_of(algebra, action.enabled)
    parts = (*action.probabilities, *action.shifts)
    scope = tuple(sorted({v for part in parts for v in part.scope}))
    if guard is None or algebra.entries(scope) > WIDE:
        return None
    probability, shift = (
        np.stack([algebra.tabulate(part, scope).reshape(-1) for part in group])
        for group in (action.probabilities, action.shifts)
    )
    return FactoredAction(
        index=index,
        ranges=guard,
        scope=scope,
        probability=scaled(probability.astype(np.float64), probability.sum(axis=0)),
        shift=np.where(probability > 0, shift, 0),
        changes=action.changes,
        cost=action.cost,
    )


def ranges_of(algebra: Algebra, value: Value, *, holds: bool = True) -> tuple[Range, ...] | None:
    """A Boolean function, or its negation, as a conjunction of ranges; None where none is known."""
    if isinstance(value, Table):
        if not value.scope and bool(value.array) == holds:
            return ()
        return (Range((_count(value),), 1, UNBOUNDED) if holds else Range((_count(value),), 0, 0),)
    operation = value.operation
    if operation is np.logical_not:
        return ranges_of(algebra, value.parts[0], holds=not holds)
    if operation in (np.logical_and, np.logical_or):
        conjunctive = (operation is np.logical_and) == holds
        ranges = _each(algebra, value, holds) if conjunctive else _any(value, holds)
        if ranges is not None:
            return ranges
    if operation in _BOUNDS:
        found = _compared(value, holds)
        if found is not None:
            return (found,)
    if algebra.entries(value.scope) > WIDE:
        return None
    return ranges_of(algebra, Table(value.scope, np.array(algebra.tabulate(value, value.scope))), holds=holds)


def _each(algebra: Algebra, value: Combined, holds: bool) -> tuple[Range, ...] | None:
    found = [ranges_of(algebra, part, holds=holds) for part in value.parts]
    return None if any(ranges is None for ranges in found) else tuple(chain.from_iterable(r for r in found if r))


def _any(value: Combined, holds: bool) -> tuple[Range, ...] | None:
    """At least one part holds (or does not)."""
    tables = [part for part in value.parts if isinstance(part, Table)]
    if len(tables) < len(value.parts):
        return None
    counted = tuple(_count(part if holds else Table(part.scope, ~part.array.astype(np.bool_))) for part in tables)
    return (Range(counted, 1, UNBOUNDED),)


_Bounds = Callable[[int], tuple[int, int]]
_BOUNDS: dict[object, tuple[_Bounds, _Bounds | None]] = {  # of a whole number compared with another; of the contrary
    operator.le: (lambda n: (-UNBOUNDED, n), lambda n: (n + 1, UNBOUNDED)),
    operator.lt: (lambda n: (-UNBOUNDED, n - 1), lambda n: (n, UNBOUNDED)),
    operator.ge: (lambda n: (n, UNBOUNDED), lambda n: (-UNBOUNDED, n - 1)),
    operator.gt: (lambda n: (n + 1, UNBOUNDED), lambda n: (-UNBOUNDED, n)),
    operator.eq: (lambda n: (n, n), None),
}
_MIRRORED = {operator.le: operator.ge, operator.lt: operator.gt, operator.ge: operator.le, operator.gt: operator.lt}


def _compared(value: Combined, holds: bool) -> Range | None:
    """A sum of whole numbers compared with a constant one."""
    left, right = value.parts
    operation: object = value.operation
    if not left.scope:
        left, right = right, left
        operation = _MIRRORED.get(operation, operation)  # type: ignore[call-overload]
    if right.scope or not isinstance(right, Table) or not float(right.array).is_integer():
        return None
    terms = _terms(left)
    bounds = _BOUNDS[operation][0 if holds else 1]
    if terms is None or bounds is None:
        return None
    number = min(max(int(right.array), -UNBOUNDED), UNBOUNDED)  # a sum of what there is in a world is far from either
    return Range(terms, *bounds(number))


def _terms(value: Value) -> tuple[Table, ...] | None:
    """The terms of a sum of whole numbers."""
    parts = value.parts if isinstance(value, Combined) and value.operation is np.add else (value,)
    tables = tuple(part for part in parts if isinstance(part, Table) and np.issubdtype(part.array.dtype, np.integer))
    return tables if len(tables) == len(parts) else None


def _count(table: Table) -> Table:
    return Table(table.scope, table.array.astype(np.int16))
