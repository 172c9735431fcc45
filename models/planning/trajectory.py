"""The most probable run of a policy that satisfies the formula.

A shortest path (Dijkstra, "A note on two problems in connexion with graphs", 1959) by -log p over the Markov chain
of the policy: the product with only the choices taken.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse import csgraph

from models.planning.compiled import CompiledWorld
from models.planning.product import Product
from models.planning.ragged import distinct, offsets, spans

MAX_LENGTH = 10_000
"""Most steps of a trajectory, not counting the one at which it ends satisfied."""

STEP_COST = 1e-9
"""What a step costs beside -log p: more than the rounding of the sums, so that no step is free and the shorter of
equally probable runs is the cheaper one."""


@dataclass(frozen=True, slots=True)
class TrajectoryStep:
    """A state, the memory before its label is read, and the action done there (None where the run ends or the
    world enables none)."""

    state: int
    memory: int
    action: str | None


@dataclass(frozen=True, slots=True)
class Trajectory:
    """The most probable run, from the initial state and memory, in which the policy satisfies the formula.

    Of all runs that end satisfied it is the single most probable one; that alone may be improbable where many
    runs share the probability. Of equally probable runs it is a shortest (a run counts as equal within a
    relative 1e-9 for each step that it is longer). It never visits a state twice with the same memory.

    `complete`: the last step is where the formula is satisfied. Otherwise the run was longer than MAX_LENGTH
    steps and only those are here; or, after a plan that was cut short by `max_sweeps`, the policy has no run
    that satisfies the formula, and there is only the initial step. `probability` is the product of the
    probabilities of the outcomes from each step here to the next: 1 for a single step.
    """

    steps: tuple[TrajectoryStep, ...]
    complete: bool
    probability: float


def most_probable_run(
    world: CompiledWorld,
    product: Product,
    chosen: NDArray[np.int32],
    names: tuple[str, ...],
    *,
    state: int,
    memory: int,
) -> Trajectory:
    """The trajectory of the policy `chosen` ([n], choice by node; -1 where the formula cannot be satisfied).

    `names` are the world's actions; `memory` is the one before the label of `state` is read. Deterministic.
    """
    start = product.node_of(memory, state)
    path = [start] if start >= product.nodes or chosen[start] < 0 else _cheapest_path(product, chosen, start)
    shown = path if len(path) <= MAX_LENGTH + 1 else path[:MAX_LENGTH]
    steps: list[TrajectoryStep] = []
    probability = 1.0
    for node, following in pairwise(shown):
        choice = int(chosen[node])
        steps.append(TrajectoryStep(state, memory, _name(product, choice, names)))
        outcome, chance = _likeliest_outcome(product, choice, following)
        probability *= chance
        memory = int(product.next_memory[memory, state])
        # A node has the choices and outcomes of its state, in the same order.
        of_state = int(world.first_choice[state]) + choice - int(product.first_choice[node])
        state = int(world.successor[int(world.first_outcome[of_state]) + outcome])
    last = shown[-1]
    decided = last >= product.nodes
    steps.append(TrajectoryStep(state, memory, None if decided else _name(product, int(chosen[last]), names)))
    return Trajectory(tuple(steps), complete=last == product.accepted, probability=probability)


def _name(product: Product, choice: int, names: tuple[str, ...]) -> str | None:
    """The action of a choice, None where no action is enabled or nothing is chosen."""
    action = int(product.action[choice]) if choice >= 0 else -1
    return names[action] if action >= 0 else None


def _likeliest_outcome(product: Product, choice: int, following: int) -> tuple[int, float]:
    """The outcome of `choice` that leads to the node or column `following`, the first of the likeliest; and its
    probability.

    Several states share the column of acceptance: entering each is a run of its own.
    """
    outcomes = slice(int(product.first_outcome[choice]), int(product.first_outcome[choice + 1]))
    chance = np.where(product.successor[outcomes] == following, product.probability[outcomes], 0.0)
    outcome = int(chance.argmax())
    return outcome, float(chance[outcome])


def _cheapest_path(product: Product, chosen: NDArray[np.int32], start: int) -> list[int]:
    """From the node `start` to the column of acceptance, both included; only `start` if there is no path."""
    nodes = _reachable(product, chosen, start)
    number = np.full(product.nodes + 2, -1, dtype=np.int32)
    number[nodes] = np.arange(len(nodes), dtype=np.int32)
    taken = chosen[nodes]
    outcome = spans(product.first_outcome, taken)
    row = np.repeat(np.arange(len(nodes), dtype=np.int32), np.diff(product.first_outcome)[taken])
    entered = product.successor[outcome]
    cost = STEP_COST - np.log(product.probability[outcome])
    target = number[entered]
    inner = target >= 0
    first = offsets(np.bincount(row[inner], minlength=len(nodes)))
    chain = sparse.csr_array((cost[inner], target[inner], first), shape=(len(nodes), len(nodes)))
    distance, before = csgraph.dijkstra(chain, indices=[int(number[start])], return_predecessors=True)
    accepting = np.flatnonzero(entered == product.accepted)
    total = distance[0, row[accepting]] + cost[accepting]
    if not len(total) or not np.isfinite(total.min()):
        return [start]
    place = int(row[accepting[total.argmin()]])
    path = [product.accepted]
    while place >= 0:
        path.append(int(nodes[place]))
        place = int(before[0, place])
    return path[::-1]


def _reachable(product: Product, chosen: NDArray[np.int32], start: int) -> NDArray[np.int32]:
    """The nodes that the policy may be in, from `start` on, and in which it can still satisfy the formula.

    A frontier deeper than MAX_LENGTH means a thin chain, of which it is cheaper to take every node.
    """
    unseen = np.append(chosen >= 0, [False, False])
    scratch = np.empty(product.nodes, dtype=np.int32)
    frontier = np.array([start], dtype=np.int32)
    unseen[frontier] = False
    found = [frontier]
    for _ in range(MAX_LENGTH):
        entered = product.successor[spans(product.first_outcome, chosen[frontier])]
        frontier = distinct(entered[unseen[entered]], scratch)
        if not len(frontier):
            return np.concatenate(found)
        unseen[frontier] = False
        found.append(frontier)
    return np.flatnonzero(chosen >= 0).astype(np.int32)
