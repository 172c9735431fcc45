"""The Markov chain that a policy makes of a world, as far as its runs may come."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from models.planning.options import Progress, no_progress
from models.planning.policy import NOTHING, Policy
from models.world import World

TABLE = 1 << 26
"""Product states up to which a table tells which are known."""

MOST_STATES = 5_000_000
"""Product states beyond which a chain is not explored."""


@dataclass(frozen=True, slots=True, eq=False)
class Chain:
    """Product states, the initial one first, and the outcomes of what the policy does in them, sorted by source."""

    state: NDArray[np.int64]  # [n]  of the world
    after: NDArray[np.int32]  # [n]  memory after reading the state
    action: NDArray[np.int64]  # [n]  index into the policy's actions, NOTHING or WAIT
    cost: NDArray[np.float64]  # [n]  of the action; to wait costs 1
    first: NDArray[np.int64]  # [n + 1]  outcomes of each product state
    target: NDArray[np.int64]  # [e]
    probability: NDArray[np.float64]  # [e]
    whole: bool  # nothing is missing

    @property
    def source(self) -> NDArray[np.int64]:
        """[e] where each outcome comes from."""
        return np.repeat(np.arange(len(self.state)), np.diff(self.first))


def explore(world: World, policy: Policy, *, most: int = MOST_STATES, progress: Progress = no_progress) -> Chain:
    """Follow `policy` in `world` from the policy's initial state and memory, through at most `most` product states.

    States are told apart by their places: what has no place in the policy does not change while it is followed.
    """
    state = np.array([policy.initial_state], dtype=np.int64)
    after = policy.after(state, np.array([policy.initial_memory], dtype=np.int32))
    known = _Known(policy.places * policy.memories)
    known.number(policy.place(state) * policy.memories + after)
    states, afters, actions, costs, edges = [], [], [], [], []
    while len(state) and known.count <= most:
        action = policy.acting(state, after)
        states.append(state)
        afters.append(after)
        actions.append(action)
        source, target, probability, cost = _move(world, state, action)
        costs.append(cost)
        memory = policy.after(target, after[source])
        first = known.count - len(state)
        number, fresh = known.number(policy.place(target) * policy.memories + memory)
        edges.append((source + first, number, probability))
        state, after = target[fresh], memory[fresh]
        progress("evaluate", len(states), 0.0, np.inf, len(state))
    source, target, probability = (np.concatenate(parts) for parts in zip(*edges, strict=True))
    seen = sum(map(len, states))
    inside = target < seen
    return Chain(
        np.concatenate(states),
        np.concatenate(afters),
        np.concatenate(actions),
        np.concatenate(costs),
        np.concatenate([[0], np.cumsum(np.bincount(source[inside], minlength=seen))]),
        target[inside],
        probability[inside],
        not len(state),
    )


class _Known:
    """Numbers for keys, in the order in which they come up: a table where it is small enough, else sorted keys."""

    def __init__(self, keys: int) -> None:
        self.count = 0
        self._table = np.full(keys, -1, dtype=np.int32) if keys <= TABLE else None
        self._keys, self._numbers = np.zeros(0, dtype=np.int64), np.zeros(0, dtype=np.int64)

    def number(self, keys: NDArray[np.int64]) -> tuple[NDArray[np.int64], NDArray[np.intp]]:
        """The number of each key, and where the keys are that came up for the first time, ascending by key."""
        fresh, where = np.unique(keys, return_index=True)
        new = self._look_up(fresh) < 0
        fresh, where = fresh[new], where[new]
        numbers = np.arange(self.count, self.count + len(fresh))
        self.count += len(fresh)
        if self._table is not None:
            self._table[fresh] = numbers
        else:
            merged = np.concatenate([self._keys, fresh])
            order = np.argsort(merged, kind="stable")
            self._keys, self._numbers = merged[order], np.concatenate([self._numbers, numbers])[order]
        return self._look_up(keys), where

    def _look_up(self, keys: NDArray[np.int64]) -> NDArray[np.int64]:
        if self._table is not None:
            return self._table[keys].astype(np.int64)
        if not len(self._keys):
            return np.full(len(keys), -1, dtype=np.int64)
        place = np.minimum(np.searchsorted(self._keys, keys), len(self._keys) - 1)
        return np.where(self._keys[place] == keys, self._numbers[place], -1)


def _move(
    world: World, state: NDArray[np.int64], action: NDArray[np.int64]
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.float64], NDArray[np.float64]]:
    """Place of the source, state entered and probability of every outcome, sorted by source, and the cost of what is
    done in each state; to wait is to stay.
    """
    cost = (action != NOTHING).astype(np.float64)
    waiting = np.flatnonzero((action < 0) & (action != NOTHING))
    found = [(waiting, state[waiting], np.ones(len(waiting)))]
    for one in np.unique(action[action >= 0]).tolist():
        places = np.flatnonzero(action == one)
        outcomes = world.outcomes(one, states=state[places])
        if not outcomes.enabled.all():
            raise AssertionError(f"the policy takes {world.actions[one]} where it is not possible")
        cost[places] = world.cost(one, state[places])
        place, kind = np.nonzero(outcomes.probability.T)
        found.append((places[place], outcomes.successor[kind, place], outcomes.probability[kind, place]))
    source, target, probability = (np.concatenate(parts) for parts in zip(*found, strict=True))
    order = np.argsort(source, kind="stable")
    return source[order], target[order], probability[order], cost
