"""The Markov chain that a policy makes of a world, as far as its runs may come."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NoReturn

import numpy as np
from numpy.typing import NDArray

from models.planning.kernels import runs
from models.planning.options import Progress, no_progress
from models.planning.policy import NOTHING, WAIT, Policy
from models.planning.ragged import unsigned
from models.world import Transitions, World

TABLE = 1 << 26
"""Product states up to which a table tells which are known."""

MOST_STATES = 5_000_000
"""Product states beyond which a chain is not explored."""

BUDGET = 1_000_000
"""Outcomes followed between two reports of progress."""

IMPOSSIBLE = -3
"""The choice of an action that is not enabled."""


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
    if world.listed is not None and policy.places == world.size and policy.places * policy.memories <= TABLE:
        return _explore_listed(world, world.listed, policy, most, progress)
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


def _explore_listed(world: World, listed: Transitions, policy: Policy, most: int, progress: Progress) -> Chain:
    """As `explore`, where the transitions are listed and the policy tells all states apart."""
    read = (
        policy.successors,
        policy.letter.astype(np.int32),
        policy.row.astype(np.int32),
        policy.action.astype(np.int32),
    )
    first_choice, start, successor = map(unsigned, (listed.first_choice, listed.first_outcome, listed.successor))
    arrays = (first_choice, listed.action, start, successor, listed.probability)
    known = np.full((policy.memories, policy.places), -1, dtype=np.int32)
    state, memory, choice = (np.empty(known.size, dtype=np.int32) for _ in range(3))  # what is not written takes none
    first = np.empty(known.size + 1, dtype=np.int64)
    state[0] = policy.initial_state
    memory[0] = policy.after(np.array([policy.initial_state]), np.array([policy.initial_memory], dtype=np.int32))[0]
    known[memory[0], state[0]] = 0
    ends, longest = np.array([0, 1, 0]), int(np.diff(listed.first_outcome).max(initial=1))
    targets, chances = [np.empty(0, dtype=np.int32)], [np.empty(0)]
    while ends[0] < ends[1] <= most:
        target, chance = np.empty(BUDGET + longest, dtype=np.int32), np.empty(BUDGET + longest)
        count = runs.follow(read, arrays, known, state, memory, choice, first, target, chance, ends, most, BUDGET)
        targets.append(target[:count])
        chances.append(chance[:count])
        progress("evaluate", len(targets) - 1, 0.0, np.inf, int(ends[1]))
    seen = int(ends[0])
    state, memory, choice, first = state[:seen], memory[:seen], choice[:seen], first[: seen + 1]
    first[seen] = ends[2]
    if (choice == IMPOSSIBLE).any():
        place = int(np.argmax(choice == IMPOSSIBLE))
        _refuse(world, int(policy.acting(state[place], memory[place])))
    target, probability = np.concatenate(targets), np.concatenate(chances)
    inside = target < seen
    if not inside.all():
        first, target, probability = np.append(0, np.cumsum(inside))[first], target[inside], probability[inside]
    acts = choice >= 0
    action = np.where(choice == -1, NOTHING, WAIT).astype(np.int64)
    action[acts] = listed.action[choice[acts]]
    cost = (action != NOTHING).astype(np.float64)
    cost[acts] = listed.cost[choice[acts]]
    whole = bool(ends[0] == ends[1])
    return Chain(state.astype(np.int64), memory, action, cost, first, target.astype(np.int64), probability, whole)


def _refuse(world: World, action: int) -> NoReturn:
    raise AssertionError(f"the policy takes {world.actions[action]} where it is not possible")


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
            _refuse(world, one)
        cost[places] = world.cost(one, state[places])
        place, kind = np.nonzero(outcomes.probability.T)
        found.append((places[place], outcomes.successor[kind, place], outcomes.probability[kind, place]))
    source, target, probability = (np.concatenate(parts) for parts in zip(*found, strict=True))
    order = np.argsort(source, kind="stable")
    return source[order], target[order], probability[order], cost
