"""A world on some of its variables, the others staying where they are."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from models.logic.formula import Atom
from models.world.algebra import Table
from models.world.errors import StateError
from models.world.factors import Factored, FactoredAction, Range
from models.world.oomdp import OomdpWorld
from models.world.states import decode_state, encode_state
from models.world.transitions import Transitions
from models.world.world import Outcomes, State, Variable


@dataclass(frozen=True, slots=True, eq=False)
class Projection:
    """Which variables are kept, and where the others stay.

    Args of the maps between states are indices of the whole world or of the projected one, in which the digits of the
    kept variables are numbered in their order.
    """

    kept: tuple[int, ...]
    base: int  # the state of the whole world in which the others stay
    radix: tuple[int, ...]  # of the whole world
    strides: tuple[int, ...]  # of the whole world
    harmless: tuple[tuple[int, ...], ...]  # by variable: the digits with which what was planned stays true

    @property
    def inner(self) -> tuple[int, ...]:
        """How much a digit of each variable counts in the projected world: 0 for those that are not kept."""
        strides, stride = [0] * len(self.radix), 1
        for position in reversed(self.kept):
            strides[position] = stride
            stride *= self.radix[position]
        return tuple(strides)

    def embed(self, states: NDArray[np.int64]) -> NDArray[np.int64]:
        """The states of the whole world that projected ones stand for."""
        whole = np.full(states.shape, self._rest(), dtype=np.int64)
        inner = self.inner
        for position in self.kept:
            whole += states // inner[position] % self.radix[position] * self.strides[position]
        return whole

    def project(self, states: NDArray[np.int64]) -> NDArray[np.int64]:
        """The projected states of states of the whole world."""
        found = np.zeros(states.shape, dtype=np.int64)
        inner = self.inner
        for position in self.kept:
            found += states // self.strides[position] % self.radix[position] * inner[position]
        return found

    def digit(self, position: int) -> int:
        """Where a variable stays."""
        return self.base // self.strides[position] % self.radix[position]

    def _rest(self) -> int:
        kept = set(self.kept)
        return sum(self.digit(v) * self.strides[v] for v in range(len(self.radix)) if v not in kept)


class ProjectedWorld:
    """See `World`: the kept variables of a world, the others staying where they are."""

    listed: Transitions | None = None

    def __init__(self, world: OomdpWorld, factored: Factored, projection: Projection) -> None:
        self.name = world.name
        self.projection = projection
        self.variables: tuple[Variable, ...] = tuple(world.variables[position] for position in projection.kept)
        self.actions = world.actions
        self._world, self.factored = world, factored
        self._kept_actions = frozenset(action.index for action in factored.actions)
        self._strides = tuple(projection.inner[position] for position in projection.kept)
        self.size = int(np.prod([projection.radix[position] for position in projection.kept], dtype=np.int64))
        self.initial = int(projection.project(np.array([projection.base]))[0])

    @property
    def least_beside(self) -> float:
        """The least cost of a step in which nothing happens here: that of an action left out, or 1, to let it pass."""
        whole = self._world.factored
        assert whole is not None
        moving = {action.index for action in self.factored.actions if action.changes}
        return min([1.0, *(action.cost for action in whole.actions if action.index not in moving)])

    def valid(self, states: NDArray[np.int64] | None = None) -> NDArray[np.bool_]:
        """See `World.valid`."""
        return self._world.valid(self._embedded(states))

    def encode(self, state: State, *, base: int | None = None) -> int:
        """See `World.encode`."""
        index = encode_state(state, self.variables, self._strides, self.initial if base is None else base)
        if not self.valid(np.array([index]))[0]:
            raise StateError("the state breaks a constraint of the domain")
        return index

    def decode(self, index: int) -> dict[str, dict[str, str]]:
        """See `World.decode`."""
        return decode_state(index, self.variables, self._strides)

    def labels(self, atoms: Sequence[Atom], states: NDArray[np.int64] | None = None) -> NDArray[np.bool_]:
        """See `World.labels`."""
        return self._world.labels(atoms, self._embedded(states))

    def outcomes(self, action: int, states: NDArray[np.int64] | None = None) -> Outcomes:
        """See `World.outcomes`; what only moves other variables is not possible."""
        found = self._world.outcomes(action, self._embedded(states))
        entered = self.projection.project(found.successor)
        if action in self._kept_actions:
            return Outcomes(found.enabled, found.probability, entered)
        return Outcomes(np.zeros_like(found.enabled), np.zeros_like(found.probability), entered)

    def cost(self, action: int, states: NDArray[np.int64] | None = None) -> NDArray[np.float64]:
        """See `World.cost`."""
        return self._world.cost(action, np.zeros(self.size if states is None else len(states), dtype=np.int64))

    def _embedded(self, states: NDArray[np.int64] | None) -> NDArray[np.int64]:
        return self.projection.embed(np.arange(self.size, dtype=np.int64) if states is None else states)


def restricted(world: Factored, acting: list[FactoredAction], projection: Projection) -> Factored:
    """The actions `acting` of a world on the kept variables; each changes no other."""
    radix = tuple(world.radix[v] for v in projection.kept)
    strides = tuple(projection.inner[v] for v in projection.kept)
    return Factored(
        radix,
        strides,
        _placed(world.valid, projection),
        tuple(
            replace(
                action,
                ranges=_placed(action.ranges, projection),
                scope=tuple(projection.kept.index(v) for v in action.scope),
                shift=_renumbered(action, world, projection),
                changes=frozenset(projection.kept.index(v) for v in action.changes),
            )
            for action in acting
        ),
    )


def _placed(ranges: Iterable[Range], projection: Projection) -> tuple[Range, ...]:
    """Ranges with the variables that are not kept where they stay; without those that read no other."""
    return tuple(
        Range(tuple(_fixed(table, projection) for table in one.tables), one.low, one.high)
        for one in ranges
        if not one.reads.isdisjoint(projection.kept)
    )


def _fixed(table: Table, projection: Projection) -> Table:
    array = table.array
    for axis in reversed(range(len(table.scope))):
        if table.scope[axis] not in projection.kept:
            array = array.take(projection.digit(table.scope[axis]), axis=axis)
    return Table(tuple(projection.kept.index(v) for v in table.scope if v in projection.kept), np.asarray(array))


def _renumbered(action: FactoredAction, world: Factored, projection: Projection) -> NDArray[np.int64]:
    """The shifts of an action in the projected numbering. Its scope holds every variable that it changes, but for those
    with one value only.
    """
    shape = [world.radix[v] for v in action.scope]
    before = np.unravel_index(np.arange(action.shift.shape[1]), shape) if shape else ()
    digits = dict(zip(action.scope, before, strict=True))
    old: NDArray[np.int64] = np.zeros(action.shift.shape[1], dtype=np.int64)
    for v in action.changes:
        old = old + digits.get(v, 0) * world.strides[v]
    shift = np.zeros_like(action.shift)
    for v in action.changes:
        after = (old + action.shift) // world.strides[v] % world.radix[v]
        shift += (after - digits.get(v, 0)) * projection.inner[v]
    return np.where(action.probability > 0, shift, 0)
