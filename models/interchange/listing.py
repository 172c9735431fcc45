"""The states of a world one by one, with the choices in each and their outcomes, as arrays."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from models.interchange.errors import ExportTooLargeError
from models.world import World
from models.world.limits import MAX_STATES

MAX_EXPORT_STATES = 1_000_000
"""States of a model that is exported state by state."""
MAX_SCANNED_STATES = 2**24
"""States of a world, forbidden ones included, that are gone through to find all those that are valid."""
_BATCH = 2**14  # states whose outcomes are computed at a time


@dataclass(frozen=True, slots=True, eq=False)
class Listing:
    """Rows (states), each with one choice or more, each with one outcome or more; choices sorted by row, then action.

    A state in which no action is possible has the choice `len(world.actions)`, which stays there and costs 1.
    """

    states: NDArray[np.int64]  # [n]  the world's number of each row's state
    initial: int  # the row of the initial state
    first_choice: NDArray[np.int64]  # [n + 1]
    action: NDArray[np.int64]  # [C]
    cost: NDArray[np.float64]  # [C]
    first_outcome: NDArray[np.int64]  # [C + 1]
    successor: NDArray[np.int64]  # [E]  rows
    probability: NDArray[np.float64]  # [E]


@dataclass(frozen=True, slots=True, eq=False)
class _Batch:
    """The choices of some states, as in Listing; successors are the world's numbers."""

    choices: NDArray[np.int64]  # [n]  how many
    action: NDArray[np.int64]
    cost: NDArray[np.float64]
    outcomes: NDArray[np.int64]  # [C]  how many
    successor: NDArray[np.int64]
    probability: NDArray[np.float64]


def list_valid(world: World) -> Listing:
    """All valid states in the world's order. Raises ExportTooLargeError."""
    if world.size > MAX_SCANNED_STATES:
        raise ExportTooLargeError(f"the world has {world.size} states; export those that are reachable only")
    states = np.flatnonzero(world.valid()).astype(np.int64)
    _check(len(states))
    batches = [_batch(world, states[i : i + _BATCH]) for i in range(0, len(states), _BATCH)]
    return _listing(world, states, batches)


def list_reachable(world: World) -> Listing:
    """The states that some run from the initial one visits, in breadth-first order. Raises ExportTooLargeError."""
    if world.size > MAX_STATES:
        raise ExportTooLargeError(f"{world.name} is too large to be listed: {world.size} states, at most {MAX_STATES}")
    frontier = np.array([world.initial], dtype=np.int64)
    seen, found, batches = frontier, [], []
    while len(frontier):
        found.append(frontier)
        new = [_batch(world, frontier[i : i + _BATCH]) for i in range(0, len(frontier), _BATCH)]
        batches += new
        entered = np.unique(np.concatenate([batch.successor for batch in new]))
        frontier = entered[~np.isin(entered, seen, assume_unique=True)]
        seen = np.union1d(seen, frontier)
        _check(len(seen))
    return _listing(world, np.concatenate(found), batches)


def offsets(counts: NDArray[np.int64]) -> NDArray[np.int64]:
    """Where each group begins and, last, where all end, from the sizes of the groups."""
    return np.concatenate([np.zeros(1, dtype=np.int64), np.cumsum(counts, dtype=np.int64)])


def spans(first: NDArray[np.int64], groups: NDArray[np.int64]) -> NDArray[np.int64]:
    """The positions of the members of some groups, group after group; `first` as from `offsets`."""
    counts = first[groups + 1] - first[groups]
    begins = offsets(counts)
    return np.repeat(first[groups] - begins[:-1], counts) + np.arange(begins[-1], dtype=np.int64)


def _check(count: int) -> None:
    if count > MAX_EXPORT_STATES:
        raise ExportTooLargeError(f"more than {MAX_EXPORT_STATES} states would have to be listed")


def _listing(world: World, states: NDArray[np.int64], batches: Sequence[_Batch]) -> Listing:
    order = np.argsort(states)
    targets = np.concatenate([batch.successor for batch in batches])
    return Listing(
        states=states,
        initial=int(np.flatnonzero(states == world.initial)[0]),
        first_choice=offsets(np.concatenate([batch.choices for batch in batches])),
        action=np.concatenate([batch.action for batch in batches]),
        cost=np.concatenate([batch.cost for batch in batches]),
        first_outcome=offsets(np.concatenate([batch.outcomes for batch in batches])),
        successor=order[np.searchsorted(states, targets, sorter=order)].astype(np.int64),
        probability=np.concatenate([batch.probability for batch in batches]),
    )


def _batch(world: World, states: NDArray[np.int64]) -> _Batch:
    stay = len(world.actions)
    owners, actions, costs, counts, successors, chances = [], [], [], [], [], []
    stuck = np.ones(len(states), dtype=np.bool_)
    for action in range(stay):
        answer = world.outcomes(action, states)
        enabled = np.flatnonzero(answer.enabled)
        stuck[enabled] = False
        chance = answer.probability.T[enabled]
        happens = chance > 0
        owners.append(enabled)
        actions.append(np.full(len(enabled), action, dtype=np.int64))
        costs.append(world.cost(action, states[enabled]))
        counts.append(happens.sum(axis=1, dtype=np.int64))
        successors.append(answer.successor.T[enabled][happens])
        chances.append(chance[happens])
    alone = np.flatnonzero(stuck)
    owners.append(alone)
    actions.append(np.full(len(alone), stay, dtype=np.int64))
    costs.append(np.ones(len(alone)))
    counts.append(np.ones(len(alone), dtype=np.int64))
    successors.append(states[alone])
    chances.append(np.ones(len(alone)))
    owner, count = np.concatenate(owners), np.concatenate(counts)
    order = np.argsort(owner, kind="stable")
    position = spans(offsets(count), order)
    return _Batch(
        choices=np.bincount(owner, minlength=len(states)).astype(np.int64),
        action=np.concatenate(actions)[order],
        cost=np.concatenate(costs)[order],
        outcomes=count[order],
        successor=np.concatenate(successors)[position].astype(np.int64),
        probability=np.concatenate(chances)[position],
    )
