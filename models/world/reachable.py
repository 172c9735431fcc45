"""The part of a world that can be reached from a state: worlds too large to be listed may have few states that matter.

States are explored breadth-first, all of a level at once, and numbered in the order of their indices in the whole
world, so that the numbering does not depend on the search.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from models.logic.formula import Atom
from models.world.errors import StateError
from models.world.transitions import Transitions
from models.world.world import Outcomes, State, World


class ReachableWorld:
    """See `World`: that of `whole`, of which `states` ([n], ascending) are the only states."""

    def __init__(self, whole: World, states: NDArray[np.int64], initial: int, listed: Transitions) -> None:
        """`initial` is a state of the whole world; `listed` are the transitions between positions in `states`."""
        self.whole = whole
        self.states = states
        self.name, self.variables, self.actions = whole.name, whole.variables, whole.actions
        self.size = len(states)
        self.initial = int(np.searchsorted(states, initial))
        self.listed: Transitions | None = listed

    def valid(self, states: NDArray[np.int64] | None = None) -> NDArray[np.bool_]:
        """See `World.valid`."""
        return np.ones(self.size if states is None else len(states), dtype=np.bool_)

    def encode(self, state: State, *, base: int | None = None) -> int:
        """See `World.encode`; raises StateError for a state that cannot be reached as well."""
        index = self.whole.encode(state, base=int(self.states[self.initial if base is None else base]))
        place = int(np.searchsorted(self.states, index))
        if place == self.size or self.states[place] != index:
            raise StateError("the state cannot be reached")
        return place

    def decode(self, index: int) -> dict[str, dict[str, str]]:
        """See `World.decode`."""
        return self.whole.decode(int(self.states[index]))

    def labels(self, atoms: Sequence[Atom], states: NDArray[np.int64] | None = None) -> NDArray[np.bool_]:
        """See `World.labels`."""
        return self.whole.labels(atoms, self._in_whole(states))

    def outcomes(self, action: int, states: NDArray[np.int64] | None = None) -> Outcomes:
        """See `World.outcomes`."""
        found = self.whole.outcomes(action, self._in_whole(states))
        return Outcomes(found.enabled, found.probability, np.searchsorted(self.states, found.successor))

    def cost(self, action: int, states: NDArray[np.int64] | None = None) -> NDArray[np.float64]:
        """See `World.cost`."""
        return self.whole.cost(action, self._in_whole(states))

    def _in_whole(self, states: NDArray[np.int64] | None) -> NDArray[np.int64]:
        return self.states if states is None else self.states[states]


def reachable_part(
    world: World,
    start: int,
    *,
    most_states: int,
    most_outcomes: int,
    tell: Callable[[int], None] | None = None,
) -> ReachableWorld | None:
    """What can be reached from the valid state `start`; None where that is more than `most_states` or `most_outcomes`.

    `tell` hears after each level how many states were found; what it raises ends the search.
    """
    level = np.array([start], dtype=np.int64)
    seen, moves, outcomes = _Seen(), list[_Moves](), 0
    seen.add(level)
    while len(level):
        here = [_moves(world, action, level) for action in range(len(world.actions))]
        here = [one for one in here if len(one.source)]
        moves += here
        outcomes += sum(len(one.successor) for one in here)
        level = seen.add(np.unique(np.concatenate([one.successor for one in here]))) if here else level[:0]
        if seen.count > most_states or outcomes > most_outcomes:
            return None
        if tell is not None:
            tell(seen.count)
    states = seen.all()
    return ReachableWorld(world, states, start, _listed(states, moves))


@dataclass(frozen=True, slots=True, eq=False)
class _Moves:
    """What one action does in some states in which it is enabled."""

    action: int
    source: NDArray[np.int64]  # [c]
    cost: NDArray[np.float64]  # [c]
    outcomes: NDArray[np.int64]  # [c]  how many
    successor: NDArray[np.int64]  # [e]
    probability: NDArray[np.float64]  # [e]


def _moves(world: World, action: int, states: NDArray[np.int64]) -> _Moves:
    found = world.outcomes(action, states)
    enabled = np.flatnonzero(found.enabled)
    chance = found.probability.T[enabled]  # [c, k]
    happens = chance > 0
    return _Moves(
        action,
        states[enabled],
        world.cost(action, states[enabled]),
        happens.sum(axis=1),
        found.successor.T[enabled][happens],
        chance[happens],
    )


def _listed(states: NDArray[np.int64], moves: Sequence[_Moves]) -> Transitions:
    """Transitions between positions in `states`, by state and then by action."""
    none = np.zeros(0, dtype=np.int64)
    source = np.searchsorted(states, np.concatenate([none, *(one.source for one in moves)]))
    action = np.concatenate([none, *(np.full(len(one.source), one.action) for one in moves)])
    count = np.concatenate([none, *(one.outcomes for one in moves)])
    successor = np.searchsorted(states, np.concatenate([none, *(one.successor for one in moves)]))
    order = np.lexsort((action, source))
    first = np.concatenate([[0], np.cumsum(count)])
    kept = np.concatenate([[0], np.cumsum(count[order])])
    place = np.repeat(first[:-1][order] - kept[:-1], count[order]) + np.arange(kept[-1])
    return Transitions(
        first_choice=np.concatenate([[0], np.cumsum(np.bincount(source, minlength=len(states)))]).astype(np.int32),
        action=action[order].astype(np.int32),
        cost=np.concatenate([np.zeros(0), *(one.cost for one in moves)])[order],
        first_outcome=kept.astype(np.int32),
        successor=successor[place].astype(np.int32),
        probability=np.concatenate([np.zeros(0), *(one.probability for one in moves)])[place],
    )


class _Seen:
    """A growing set of numbers: sorted runs, each more than twice as long as the next, so that adding stays cheap."""

    def __init__(self) -> None:
        self.count = 0
        self._runs: list[NDArray[np.int64]] = []

    def add(self, numbers: NDArray[np.int64]) -> NDArray[np.int64]:
        """Add numbers (ascending, each once); returns those that are new."""
        for run in self._runs:
            place = np.minimum(np.searchsorted(run, numbers), len(run) - 1)
            numbers = numbers[run[place] != numbers]
        self.count += len(numbers)
        if len(numbers):
            self._runs.append(numbers)
        while len(self._runs) > 1 and len(self._runs[-2]) <= 2 * len(self._runs[-1]):
            self._runs[-2:] = [np.sort(np.concatenate(self._runs[-2:]), kind="stable")]
        return numbers

    def all(self) -> NDArray[np.int64]:
        """All of them, ascending."""
        return np.sort(np.concatenate(self._runs), kind="stable")
