"""Functions of the state, as small tables over the few variables they touch.

A `Table` holds a function's values over its variables. A function of too many variables for a table is
`Combined`: an operation on smaller functions, computed when asked, for all states or a batch of them. Nothing
here runs Python once per state.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from functools import reduce
from math import prod
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from models.world.expression import ExpressionError
from models.world.limits import MAX_TABLE, MAX_WORK

Array = NDArray[Any]
Operation = Callable[..., Any]
_OVERHEAD = 256  # what one array operation costs, in entries
_LOOKUP = 32  # what finding a known value costs
_REMEMBERED = 16_384
_SPEED = 4  # long arrays are computed so many entries for the price of one


@dataclass(frozen=True, slots=True, eq=False)
class Table:
    """A function's values over the variables of its scope (ascending positions, one axis each)."""

    scope: tuple[int, ...]
    array: Array


@dataclass(frozen=True, slots=True, eq=False)
class Combined:
    """An operation on parts; `folds` says that it takes two at a time and their order does not matter."""

    scope: tuple[int, ...]
    operation: Operation
    parts: tuple[Value, ...]
    folds: bool = False


Value = Table | Combined


class Frame(Protocol):
    """Some states, and how tables spread over them."""

    def spread(self, table: Table) -> Array:
        """The table's value in each state, in a shape that broadcasts against the others of the frame."""


@dataclass(frozen=True, slots=True)
class Box:
    """All combinations of the values of some variables (ascending), in order; one axis for each."""

    radix: tuple[int, ...]
    scope: tuple[int, ...]

    @property
    def shape(self) -> tuple[int, ...]:
        """The number of values of each variable of the box."""
        return tuple(self.radix[v] for v in self.scope)

    def spread(self, table: Table) -> Array:
        """See Frame; axes of variables that the table does not touch have length 1."""
        if table.scope == self.scope:
            return table.array
        return table.array.reshape([self.radix[v] if v in table.scope else 1 for v in self.scope])


@dataclass(slots=True)
class Batch:
    """Given states: one digit array per variable, computed once."""

    radix: tuple[int, ...]
    strides: tuple[int, ...]
    states: NDArray[np.int64]
    digits: dict[int, NDArray[np.int64]] = field(default_factory=dict)  # by variable, as far as they are known
    _flat: dict[tuple[int, ...], NDArray[np.int64]] = field(default_factory=dict)

    def spread(self, table: Table) -> Array:
        """See Frame; constants stay scalars."""
        if not table.scope:
            return table.array
        return table.array.ravel()[self._index(table.scope)]

    def _index(self, scope: tuple[int, ...]) -> NDArray[np.int64]:
        if scope not in self._flat:
            index = self._digit(scope[0])
            for variable in scope[1:]:
                index = index * self.radix[variable] + self._digit(variable)
            self._flat[scope] = index
        return self._flat[scope]

    def _digit(self, variable: int) -> NDArray[np.int64]:
        if variable not in self.digits:
            self.digits[variable] = (self.states // self.strides[variable]) % self.radix[variable]
        return self.digits[variable]


def evaluate(value: Value, frame: Frame, memo: dict[Value, Array] | None = None) -> Array:
    """The value in each state of the frame; shared parts are computed once."""
    if isinstance(value, Table):
        return frame.spread(value)
    memo = {} if memo is None else memo
    if value not in memo:
        parts = [evaluate(part, frame, memo) for part in value.parts]
        memo[value] = np.asarray(reduce(value.operation, parts) if value.folds else value.operation(*parts))
    return memo[value]


class Algebra:
    """Combines functions over the variables of one world, and counts the work."""

    def __init__(self, radix: Sequence[int]) -> None:
        self.radix = tuple(radix)
        self.spent = 0
        self._known: dict[tuple[Operation | Value, ...], Value] = {}

    def entries(self, scope: Iterable[int]) -> int:
        """Combinations of the values of some variables."""
        return prod(self.radix[v] for v in scope)

    def variable(self, position: int, values: Array) -> Table:
        """A function of one variable, from its value at each digit; a constant if it has only one."""
        return Table((position,), values) if self.radix[position] > 1 else Table((), values.reshape(()))

    def combine(self, operation: Operation, *parts: Value) -> Value:
        """`operation`, which must broadcast, applied to the parts: a table when it fits.

        The same operation on the same parts gives the same value, computed once.
        """
        key = (operation, *parts)
        if key in self._known:
            self.spend(_LOOKUP)
            return self._known[key]
        value = self._known[key] = self._combine(operation, parts)
        return value

    def renew(self) -> None:
        """Starts a new count of work, and forgets what is known when that has become much."""
        self.spent = 0
        if len(self._known) > _REMEMBERED:
            self._known.clear()

    def _combine(self, operation: Operation, parts: tuple[Value, ...]) -> Value:
        scopes = {part.scope for part in parts if part.scope}
        scope = tuple(sorted({v for each in scopes for v in each}))
        size = self.entries(scope)
        tables = [part for part in parts if isinstance(part, Table)]
        if size > MAX_TABLE or len(tables) < len(parts):
            self.spend(_OVERHEAD + len(parts) + sum(map(len, scopes)))
            return Combined(scope, operation, parts)
        self.spend(size * len(parts) + _OVERHEAD)
        if len(scopes) <= 1:  # constants broadcast as they are
            return Table(scope, np.asarray(operation(*[table.array for table in tables])))
        box = Box(self.radix, scope)
        return Table(scope, np.asarray(operation(*[box.spread(table) for table in tables])))

    def fold(self, operation: Operation, parts: Iterable[Value]) -> Value:
        """An associative, commutative operation over one or more parts, merged into tables as far as they
        fit.
        """
        flat: list[Value] = []
        for part in parts:
            inlined = isinstance(part, Combined) and part.folds and part.operation is operation
            flat.extend(part.parts if isinstance(part, Combined) and inlined else [part])
        groups: list[Value] = []
        for part in sorted(flat, key=lambda value: value.scope):
            if groups and self._fits(groups[-1], part):
                groups[-1] = self.combine(operation, groups[-1], part)
            else:
                groups.append(part)
        if len(groups) == 1:
            return groups[0]
        self.spend(_OVERHEAD * len(groups))
        scope = tuple(sorted({v for group in groups for v in group.scope}))
        return Combined(scope, operation, tuple(groups), folds=True)

    def tabulate(self, value: Value, scope: tuple[int, ...]) -> Array:
        """The value at every combination of the variables of `scope`, which holds the value's own."""
        self.spend(self.entries(scope) + self._work(value))
        box = Box(self.radix, scope)
        return np.broadcast_to(evaluate(value, box), box.shape)

    def _work(self, value: Value) -> int:
        """What evaluating a value over all values of its variables costs; shared parts are computed once."""
        seen: set[Value] = set()
        waiting, work = [value], 0
        while waiting:
            node = waiting.pop()
            if isinstance(node, Combined) and node not in seen:
                seen.add(node)
                work += len(node.parts) * (1 + self.entries(node.scope) // _SPEED)
                waiting.extend(node.parts)
        return work

    def _fits(self, left: Value, right: Value) -> bool:
        if not (isinstance(left, Table) and isinstance(right, Table)):
            return False
        return self.entries({*left.scope, *right.scope}) <= MAX_TABLE

    def spend(self, work: int) -> None:
        """Counts work, in table entries. Raises ExpressionError beyond the limit."""
        self.spent += work
        if self.spent > MAX_WORK:
            raise ExpressionError("the world takes too much work to compile: use fewer objects or simpler expressions")
