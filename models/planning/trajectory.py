"""The most probable run of a policy that satisfies the formula.

A shortest path (Dijkstra, "A note on two problems in connexion with graphs", 1959) by -log p over the Markov chain
of the policy: the product with only the choices taken.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse import csgraph

from models.planning.chosen import Chosen
from models.planning.compiled import CompiledWorld
from models.planning.product import Product
from models.planning.ragged import offsets, spans

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

    `complete`: the run comes to where the formula is satisfied, or will be if the policy goes on for ever. In the latter
    case it goes on by the likeliest outcomes until it comes again to where it was: the last step repeats step `loop`.
    Otherwise the run was longer than MAX_LENGTH
    steps and only those are here; or, after a plan that was cut short by `max_sweeps`, the policy has no run
    that satisfies the formula, and there is only the initial step. `probability` is the product of the
    probabilities of the outcomes from each step to the next, until the formula is satisfied or only has to be kept up:
    1 for a single step.
    """

    steps: tuple[TrajectoryStep, ...]
    complete: bool
    probability: float
    loop: int | None = None


def most_probable_run(
    chosen: Chosen, world: CompiledWorld, names: tuple[str, ...], *, state: int, memory: int
) -> Trajectory:
    """The trajectory of a policy. `names` are the world's actions; `memory` is the one before the label of `state` is
    read. Deterministic.
    """
    walk = _Walk(chosen, world, names, state, memory)
    start = chosen.whole.node_of(memory, state)
    path = [start]
    if start < chosen.whole.nodes and chosen.choice[start] >= 0 and not chosen.inside[start]:
        path = _cheapest_path(chosen, start)
    for node in path[1:] if len(path) <= MAX_LENGTH + 1 else path[1:MAX_LENGTH]:
        walk.go(node)
    decided = walk.node == chosen.whole.accepted or bool(chosen.inside[walk.node])
    loop = walk.circle() if chosen.inside[walk.node] else None
    return Trajectory((*walk.steps, walk.last()), complete=decided, probability=walk.probability, loop=loop)


class _Walk:
    """Where a run is in the product and in the world, and what it has done."""

    def __init__(self, chosen: Chosen, world: CompiledWorld, names: tuple[str, ...], state: int, memory: int) -> None:
        self._chosen, self._product, self._world, self._names = chosen, chosen.whole, world, names
        self._state, self._memory = state, memory
        self.node = self._product.node_of(memory, state)
        self.steps: list[TrajectoryStep] = []
        self.probability = 1.0

    def last(self) -> TrajectoryStep:
        """The step at which the run is."""
        choice = int(self._chosen.choice[self.node]) if self.node < self._product.nodes else -1
        return TrajectoryStep(self._state, self._memory, _name(self._product, choice, self._names))

    def go(self, node: int) -> None:
        """Do the policy's action, which leads to `node` by the likeliest of its outcomes that do."""
        choice = int(self._chosen.choice[self.node])
        outcome, chance = _likeliest_outcome(self._product, choice, node)
        self.probability *= chance
        self._enter(choice, outcome)

    def circle(self) -> int:
        """Go on by the likeliest outcomes until a node comes again; returns the step at which it was."""
        seen: dict[int, int] = {}
        while self.node not in seen and len(seen) < MAX_LENGTH:
            seen[self.node] = len(self.steps)
            choice = int(self._chosen.choice[self.node])
            outcomes = slice(int(self._product.first_outcome[choice]), int(self._product.first_outcome[choice + 1]))
            self._enter(choice, int(self._product.probability[outcomes].argmax()))
        return seen.get(self.node, len(self.steps))

    def _enter(self, choice: int, outcome: int) -> None:
        product, world = self._product, self._world
        self.steps.append(self.last())
        # A node has the choices and outcomes of its state, in the same order.
        of_state = int(world.first_choice[self._state]) + choice - int(product.first_choice[self.node])
        self._memory = int(product.next_memory[self._memory, self._state])
        self._state = int(world.successor[int(world.first_outcome[of_state]) + outcome])
        self.node = int(product.successor[int(product.first_outcome[choice]) + outcome])


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


def _cheapest_path(chosen: Chosen, start: int) -> list[int]:
    """From the node `start` to the column of acceptance or where the formula holds if the policy goes on, both
    included; only `start` if there is no path.
    """
    product = chosen.whole
    nodes = chosen.reachable(start)
    nodes = nodes[~chosen.inside[nodes]]
    number = np.full(product.nodes + 2, -1, dtype=np.int32)
    number[nodes] = np.arange(len(nodes), dtype=np.int32)
    taken = chosen.choice[nodes]
    outcome = spans(product.first_outcome, taken)
    row = np.repeat(np.arange(len(nodes), dtype=np.int32), np.diff(product.first_outcome)[taken])
    entered = product.successor[outcome]
    cost = STEP_COST - np.log(product.probability[outcome])
    target = number[entered]
    inner = target >= 0
    first = offsets(np.bincount(row[inner], minlength=len(nodes)))
    chain = sparse.csr_array((cost[inner], target[inner], first), shape=(len(nodes), len(nodes)))
    distance, before = csgraph.dijkstra(chain, indices=[int(number[start])], return_predecessors=True)
    ending = np.flatnonzero((entered == product.accepted) | chosen.inside[entered])
    total = distance[0, row[ending]] + cost[ending]
    if not len(total) or not np.isfinite(total.min()):
        return [start]
    best = int(total.argmin())
    place = int(row[ending[best]])
    path = [int(entered[ending[best]])]
    while place >= 0:
        path.append(int(nodes[place]))
        place = int(before[0, place])
    return path[::-1]
