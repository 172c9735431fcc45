"""The Markov chain that a policy makes of a world, as far as its runs may come."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from models.planning.policy import NOTHING, Policy
from models.world import World

MOST_STATES = 5_000_000
"""Product states beyond which a chain is not explored."""


@dataclass(frozen=True, slots=True, eq=False)
class Chain:
    """Product states, the initial one first, and the outcomes of what the policy does in them, sorted by source."""

    state: NDArray[np.int64]  # [n]  of the world
    after: NDArray[np.int32]  # [n]  memory after reading the state
    action: NDArray[np.int64]  # [n]  index into the policy's actions, NOTHING or WAIT
    first: NDArray[np.int64]  # [n + 1]  outcomes of each product state
    target: NDArray[np.int64]  # [e]
    probability: NDArray[np.float64]  # [e]
    whole: bool  # nothing is missing

    @property
    def source(self) -> NDArray[np.int64]:
        """[e] where each outcome comes from."""
        return np.repeat(np.arange(len(self.state)), np.diff(self.first))


def explore(world: World, policy: Policy, *, most: int = MOST_STATES) -> Chain:
    """Follow `policy` in `world` from the policy's initial state and memory, through at most `most` product states.

    States are told apart by their places: what has no place in the policy does not change while it is followed.
    """
    state = np.array([policy.initial_state], dtype=np.int64)
    after = policy.after(state, np.array([policy.initial_memory], dtype=np.int32))
    known = policy.place(state) * policy.memories + after  # keys in ascending order, and the number of each
    number = np.zeros(1, dtype=np.int64)
    states, afters, actions, edges = [], [], [], []
    count = 1
    while len(state) and count <= most:
        action = policy.acting(state, after)
        states.append(state)
        afters.append(after)
        actions.append(action)
        source, target, probability = _move(world, state, action)
        memory = policy.after(target, after[source])
        keys = policy.place(target) * policy.memories + memory
        fresh, where = np.unique(keys, return_index=True)
        new = ~np.isin(fresh, known, assume_unique=True)
        fresh, where = fresh[new], where[new]
        merged = np.concatenate([known, fresh])
        numbers = np.concatenate([number, np.arange(count, count + len(fresh))])
        order = np.argsort(merged, kind="stable")
        known, number = merged[order], numbers[order]
        edges.append((source + count - len(state), number[np.searchsorted(known, keys)], probability))
        count += len(fresh)
        state, after = target[where], memory[where]
    source, target, probability = (np.concatenate(parts) for parts in zip(*edges, strict=True))
    seen = sum(map(len, states))
    inside = target < seen
    first = np.concatenate([[0], np.cumsum(np.bincount(source[inside], minlength=seen))])
    return Chain(
        np.concatenate(states),
        np.concatenate(afters),
        np.concatenate(actions),
        first,
        target[inside],
        probability[inside],
        not len(state),
    )


def _move(
    world: World, state: NDArray[np.int64], action: NDArray[np.int64]
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.float64]]:
    """Place of the source, state entered and probability of every outcome, sorted by source; to wait is to stay."""
    waiting = np.flatnonzero((action < 0) & (action != NOTHING))
    found = [(waiting, state[waiting], np.ones(len(waiting)))]
    for one in np.unique(action[action >= 0]).tolist():
        places = np.flatnonzero(action == one)
        outcomes = world.outcomes(one, states=state[places])
        if not outcomes.enabled.all():
            raise AssertionError(f"the policy takes {world.actions[one]} where it is not possible")
        place, kind = np.nonzero(outcomes.probability.T)
        found.append((places[place], outcomes.successor[kind, place], outcomes.probability[kind, place]))
    source, target, probability = (np.concatenate(parts) for parts in zip(*found, strict=True))
    order = np.argsort(source, kind="stable")
    return source[order], target[order], probability[order]
