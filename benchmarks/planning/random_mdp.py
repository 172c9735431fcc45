"""Random sparse MDPs, and such an MDP as a world."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from models.world import World
from models.world.explicit import ExplicitWorld
from models.world.transitions import Transitions

SPLITS = {2: (5, 5), 3: (4, 3, 3), 4: (3, 3, 2, 2)}
"""How ten transitions are shared by so many choices."""
GOALS, SINKS = 0.02, 0.01
"""Shares of the states."""
LEAK = 0.01
"""Weight of the last transition of a choice, which leads to a sink, where that of others is 0.1 to 1.1: so no state but
the goals is sure to come to one."""


@dataclass(frozen=True, slots=True, eq=False)
class RandomMdp:
    """Choices sorted by state, outcomes by choice and then by successor, none of which is twice in a choice.

    The initial state is 0. Sinks have one choice, which stays.
    """

    first_choice: NDArray[np.int64]  # [S + 1]
    action: NDArray[np.int64]  # [C]  0, 1, ... in each state
    first_outcome: NDArray[np.int64]  # [C + 1]
    successor: NDArray[np.int64]  # [E]
    probability: NDArray[np.float64]  # [E]
    goal: NDArray[np.int64]  # ascending


def random_mdp(states: int, seed: int = 0) -> RandomMdp:
    """Two to four choices and ten transitions, fewer where two meet, in each state but the sinks."""
    draw = np.random.default_rng(seed)
    special = 1 + draw.permutation(states - 1)[: int(states * (GOALS + SINKS))]
    goal, sink = np.split(special, [int(states * GOALS)])
    choices = draw.integers(2, 5, states)
    choices[sink] = 1
    first_choice = _first(choices)
    action = np.arange(first_choice[-1]) - np.repeat(first_choice[:-1], choices)
    sizes = np.zeros((5, 4), dtype=np.int64)
    for count, split in SPLITS.items():
        sizes[count, :count] = split
    sizes[1, 0] = 1
    outcomes = sizes[np.repeat(choices, choices), action]
    choice = np.repeat(np.arange(len(outcomes)), outcomes)
    target = draw.integers(0, states, len(choice))
    weight = 0.1 + draw.random(len(choice))
    last = np.cumsum(outcomes) - 1
    target[last] = draw.choice(sink, len(last))
    weight[last] = LEAK
    target[last[first_choice[sink]]] = sink
    keys, where = np.unique(choice * states + target, return_inverse=True)
    merged = np.bincount(where, weights=weight)
    owner = keys // states
    return RandomMdp(
        first_choice=first_choice,
        action=action,
        first_outcome=_first(np.bincount(owner, minlength=len(outcomes))),
        successor=keys % states,
        probability=merged / np.bincount(owner, weights=merged)[owner],
        goal=np.sort(goal),
    )


def listed_world(mdp: RandomMdp) -> World:
    """The MDP as our planner takes it: one variable, the proposition `goal`."""
    transitions = Transitions(
        first_choice=mdp.first_choice.astype(np.int32),
        action=mdp.action.astype(np.int32),
        cost=np.ones(len(mdp.action)),
        first_outcome=mdp.first_outcome.astype(np.int32),
        successor=mdp.successor.astype(np.int32),
        probability=mdp.probability,
    )
    return ExplicitWorld(
        "random", initial=0, actions=("a", "b", "c", "d"), labels={"goal": mdp.goal}, transitions=transitions
    )


def _first(counts: NDArray[Any]) -> NDArray[np.int64]:
    return np.concatenate([np.zeros(1, dtype=np.int64), np.cumsum(counts, dtype=np.int64)])
