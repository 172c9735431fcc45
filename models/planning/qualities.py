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

from models.planning.graph import BUDGET, Mask, Predecessors, Pruning, Reached, in_stretches, reach
from models.planning.kernels import searches
from models.planning.options import Progress, no_progress
from models.planning.product import Product


@dataclass(frozen=True, slots=True, eq=False)
class Qualities:
    """What is certain without numbers, by node and column."""

    possible: Mask  # [n + 2]  maximal probability is above 0
    certain: Mask  # [n + 2]  maximal probability is 1
    keeps_certain: Mask  # [C]  every outcome of the choice is certain
    order: NDArray[np.int32]  # [possible]  nodes and columns by the fewest steps that may lead to acceptance


def analyse(product: Product, graph: Predecessors, *, progress: Progress = no_progress) -> Qualities:
    """Find the nodes of maximal probability 0 and 1 of reaching acceptance."""
    reached = reach(graph, np.array([product.accepted], dtype=np.int32), progress=progress)
    possible = reached.mask
    remaining = np.zeros(product.nodes + 2, dtype=np.int32)
    remaining[:-2] = np.diff(product.first_choice)
    pruning = Pruning(graph, possible.copy(), np.ones(len(product.action), dtype=np.bool_), remaining)
    forest = _Forest(product, graph, reached, pruning)
    removed = np.flatnonzero(~possible).astype(np.int32)
    while len(removed):
        removed = forest.cut(pruning.remove(removed, progress), progress)
    return Qualities(possible, pruning.inside, pruning.allowed, reached.order)


class _Forest:
    """One way to acceptance for each node inside: an allowed choice, and what it enters next."""

    def __init__(self, product: Product, graph: Predecessors, reached: Reached, pruning: Pruning) -> None:
        self._product, self._graph, self._pruning = product, graph, pruning
        self._way = (reached.choice, reached.entered)
        self._detached = np.zeros(product.nodes + 2, dtype=np.bool_)
        self._queue = np.empty(product.nodes + 2, dtype=np.int32)
        self._joined = np.empty(product.nodes + 2, dtype=np.int32)

    def cut(self, choices: NDArray[np.int32], progress: Progress) -> NDArray[np.int32]:
        """Find another way for the nodes whose way led through `choices`, now forbidden; returns those without."""
        nodes = self._detach(choices, progress)
        self._attach(nodes, progress)
        left = nodes[self._detached[nodes]]
        self._detached[left] = False
        return left

    def _detach(self, choices: NDArray[np.int32], progress: Progress) -> NDArray[np.int32]:
        """The nodes whose way begins with one of `choices`, and all whose way leads through them."""
        graph, inside, detached, queue = self._graph, self._pruning.inside, self._detached, self._queue
        ends = np.array([0, searches.cut(choices, graph.arrays[2], self._way[0], inside, detached, queue)])

        def some() -> int:
            return int(searches.detach(*graph.arrays, *self._way, inside, detached, queue, ends, BUDGET))

        in_stretches(some, ends, progress)
        return queue[: ends[1]]

    def _attach(self, nodes: NDArray[np.int32], progress: Progress) -> None:
        """Give the detached `nodes` a way into the others, as far as there is one."""
        product, graph, allowed, detached = self._product, self._graph, self._pruning.allowed, self._detached
        ends = np.array([0, searches.rejoin(nodes, *product.moves, allowed, *self._way, detached, self._joined)])

        def some() -> int:
            return int(searches.spread(*graph.arrays, allowed, *self._way, detached, self._joined, ends, BUDGET))

        in_stretches(some, ends, progress)
