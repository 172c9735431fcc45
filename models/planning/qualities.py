"""Which nodes of the product have maximal probability 0, and which have 1.

No numbers are involved, so there is no tolerance: Forejt, Kwiatkowska, Norman and Parker, "Automated
verification techniques for probabilistic systems" (SFM 2011), algorithms Prob0A and Prob1E; de Alfaro,
"Formal verification of probabilistic systems" (1997), for the almost-sure set by repeated removal. A round of
removal only looks again at the nodes whose way to acceptance it cut.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from models.planning.graph import Mask, Predecessors, Pruning, Reached, reach
from models.planning.options import Progress, no_progress
from models.planning.product import Product
from models.planning.ragged import distinct, spans


@dataclass(frozen=True, slots=True, eq=False)
class Qualities:
    """What is certain without numbers, by node and column."""

    possible: Mask  # [n + 2]  maximal probability is above 0
    certain: Mask  # [n + 2]  maximal probability is 1
    keeps_certain: Mask  # [C]  every outcome of the choice is certain


def analyse(product: Product, graph: Predecessors, *, progress: Progress = no_progress) -> Qualities:
    """Find the nodes of maximal probability 0 and 1 of reaching acceptance."""
    reached = reach(graph, np.array([product.accepted], dtype=np.int32))
    possible = reached.mask
    pruning = Pruning(graph, possible.copy(), np.ones(len(product.action), dtype=np.bool_))
    forest = _Forest(product, graph, reached, pruning)
    removed = np.flatnonzero(~possible).astype(np.int32)
    while len(removed):
        removed = forest.cut(pruning.remove(removed, progress), progress)
    return Qualities(possible, pruning.inside, pruning.allowed)


class _Forest:
    """One way to acceptance for each node inside: an allowed choice, and the outcome of it that is next."""

    def __init__(self, product: Product, graph: Predecessors, reached: Reached, pruning: Pruning) -> None:
        self._product, self._graph, self._pruning = product, graph, pruning
        self._choice = reached.choice.copy()
        self._next = np.full(product.nodes + 2, -1, dtype=np.int32)
        nodes = np.flatnonzero(reached.choice >= 0).astype(np.int32)
        node, _, entered = self._outcomes(nodes, reached.choice[nodes])
        closer = reached.distance[entered] == reached.distance[node] - 1
        self._next[node[closer]] = entered[closer]
        self._detached = np.zeros(product.nodes + 2, dtype=np.bool_)
        self._scratch = np.empty(product.nodes + 2, dtype=np.int32)

    def cut(self, choices: NDArray[np.int32], progress: Progress) -> NDArray[np.int32]:
        """Find another way for the nodes whose way led through `choices`, now forbidden; returns those without."""
        node = self._graph.owner[choices]
        cut = node[(self._choice[node] == choices) & self._pruning.inside[node]]
        nodes = self._detach(cut, progress)
        self._attach(nodes, progress)
        left = nodes[self._detached[nodes]]
        self._detached[left] = False
        return left

    def _detach(self, frontier: NDArray[np.int32], progress: Progress) -> NDArray[np.int32]:
        """The nodes `frontier` and all whose way leads through them."""
        found = [np.zeros(0, dtype=np.int32)]
        while len(frontier):
            self._detached[frontier] = True
            found.append(frontier)
            node, choice, entered = self._before(frontier)
            through = (self._choice[node] == choice) & (self._next[node] == entered)
            through &= self._pruning.inside[node] & ~self._detached[node]
            frontier = distinct(node[through], self._scratch)
            progress("graph", len(found), 0.0, np.inf, len(frontier))
        return np.concatenate(found)

    def _attach(self, nodes: NDArray[np.int32], progress: Progress) -> None:
        """Give the detached `nodes` a way into the others, as far as there is one."""
        choices = spans(self._product.first_choice, nodes)
        choices = choices[self._pruning.allowed[choices]]
        node, choice, entered = self._outcomes(self._graph.owner[choices], choices)
        fresh = ~self._detached[entered]
        level = 0
        while fresh.any():
            level += 1
            node = node[fresh]
            self._choice[node], self._next[node] = choice[fresh], entered[fresh]
            frontier = distinct(node, self._scratch)
            self._detached[frontier] = False
            node, choice, entered = self._before(frontier)
            fresh = self._detached[node] & self._pruning.allowed[choice]
            progress("graph", level, 0.0, np.inf, len(frontier))

    def _outcomes(
        self, nodes: NDArray[np.int32], choices: NDArray[np.int32]
    ) -> tuple[NDArray[np.int32], NDArray[np.int32], NDArray[np.int32]]:
        """Node, choice and what is entered, for every outcome of `choices`, which belong to `nodes`."""
        first = self._product.first_outcome
        count = first[choices + 1] - first[choices]
        entered = self._product.successor[spans(first, choices)]
        return np.repeat(nodes, count), np.repeat(choices, count), entered

    def _before(self, nodes: NDArray[np.int32]) -> tuple[NDArray[np.int32], NDArray[np.int32], NDArray[np.int32]]:
        """The same for every outcome that enters one of `nodes`."""
        choice = self._graph.choice[spans(self._graph.first, nodes)]
        entered = np.repeat(nodes, self._graph.first[nodes + 1] - self._graph.first[nodes])
        return self._graph.owner[choice], choice, entered
