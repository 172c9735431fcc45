"""The most likely run of a policy."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from models.planning.compiled import CompiledWorld
from models.planning.product import Product

MAX_LENGTH = 10_000
"""Most steps of a trajectory."""


@dataclass(frozen=True, slots=True)
class TrajectoryStep:
    """A state, the memory before its label is read, and the action done there (None where the run ends or the
    world enables none)."""

    state: int
    memory: int
    action: str | None


@dataclass(frozen=True, slots=True)
class Trajectory:
    """Steps from the initial state. `complete`: the last one is where the outcome is decided."""

    steps: tuple[TrajectoryStep, ...]
    complete: bool


def most_likely_run(
    world: CompiledWorld,
    product: Product,
    chosen: NDArray[np.int32],
    names: tuple[str, ...],
    *,
    state: int,
    memory: int,
) -> Trajectory:
    """At every step the most probable successor that the run has not been at yet; the lowest index on ties.

    A slip that leaves everything as it was is thus passed over. The run ends where `chosen` ([n], by node) has no
    choice, when only visited nodes follow, or after MAX_LENGTH steps. `names` are the world's actions.
    """
    steps: list[TrajectoryStep] = []
    visited: set[int] = set()
    while True:
        node = product.node_of(memory, state)
        after = int(product.next_memory[memory, state])
        if node >= product.nodes or chosen[node] < 0:
            return Trajectory((*steps, TrajectoryStep(state, memory, None)), complete=True)
        visited.add(node)
        action = int(product.action[chosen[node]])
        steps.append(TrajectoryStep(state, memory, names[action] if action >= 0 else None))
        following = [
            (-chance, entered)
            for chance, entered in _outcomes(world, state, action)
            if product.node_of(after, entered) not in visited
        ]
        if not following or len(steps) == MAX_LENGTH:
            return Trajectory(tuple(steps), complete=False)
        state, memory = min(following)[1], after


def _outcomes(world: CompiledWorld, state: int, action: int) -> list[tuple[float, int]]:
    """Probability and successor of each outcome."""
    first = int(world.first_choice[state])
    choice = first + int(np.flatnonzero(world.action[first : world.first_choice[state + 1]] == action)[0])
    outcomes = slice(int(world.first_outcome[choice]), int(world.first_outcome[choice + 1]))
    return list(zip(world.probability[outcomes].tolist(), world.successor[outcomes].tolist(), strict=True))
