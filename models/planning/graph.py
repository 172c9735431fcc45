"""Searches in the product: backwards from targets, and the removal of nodes with all that depends on them.

Searches go by queues and look at every outcome a few times at most, so they cost time in proportion to the outcomes.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from models.planning.kernels import searches
from models.planning.options import Progress, no_progress
from models.planning.product import Product
from models.planning.ragged import owners, unsigned

Mask = NDArray[np.bool_]

BUDGET = 1_000_000
"""Outcomes that a search looks at between two reports of progress: some milliseconds."""


@dataclass(frozen=True, slots=True, eq=False)
class Predecessors:
    """For each node and column, the choices with an outcome in it; for each choice, its node."""

    product: Product
    first: NDArray[np.int32]  # [n + 3]
    choice: NDArray[np.int32]  # [E]
    owner: NDArray[np.int32]  # [C]

    @property
    def arrays(self) -> tuple[NDArray[np.uint32], NDArray[np.uint32], NDArray[np.uint32]]:
        """First places, choices and owners, as compiled loops read them."""
        return unsigned(self.first), unsigned(self.choice), unsigned(self.owner)


@dataclass(frozen=True, slots=True, eq=False)
class Reached:
    """A backward search: how far each node and column is from the targets."""

    distance: NDArray[np.int32]  # [n + 2]  fewest steps that may lead to a target; -1 if none do
    choice: NDArray[np.int32]  # [n + 2]  a choice that may bring a node one step closer; -1 at targets and unreached
    entered: NDArray[np.int32]  # [n + 2]  what that choice may enter, one step closer; -1 likewise
    order: NDArray[np.int32]  # [reached]  the nearest first, ascending within a distance

    @property
    def mask(self) -> Mask:
        """[n + 2] which nodes may reach a target."""
        return self.distance >= 0


def predecessors(product: Product) -> Predecessors:
    """The outcomes of the product, sorted by successor."""
    first, choice = searches.turned_round(*product.moves[1:], product.nodes + 2)
    return Predecessors(product, first, choice, owners(product.first_choice))


def reach(
    graph: Predecessors,
    targets: NDArray[np.int32],
    *,
    allowed: Mask | None = None,
    progress: Progress = no_progress,
) -> Reached:
    """Search backwards from `targets` (nodes or columns) through the allowed choices (default: all).

    Where a level has many nodes, the next one is looked for from the nodes that are left (Beamer, Asanović and
    Patterson, "Direction-optimizing breadth-first search", SC 2012).
    """
    size = len(graph.first) - 1
    distance, choice, entered = (np.full(size, -1, dtype=np.int32) for _ in range(3))
    distance[targets] = 0
    queue, ends = np.empty(size, dtype=np.int32), np.array([0, len(targets)])
    queue[: len(targets)] = targets
    usable = np.empty(0, dtype=np.bool_) if allowed is None else allowed

    found = (queue, ends, distance, choice, entered)

    def some() -> int:
        level = distance[queue[ends[0]]] == distance[queue[ends[1] - 1]]  # a whole one and no more is in the queue
        if level and (ends[1] - ends[0]) * searches.CROWDED > size - ends[1]:
            return int(searches.look_for(*graph.product.moves, usable, *found))
        return int(searches.search(*graph.arrays, usable, *found, BUDGET))

    in_stretches(some, ends, progress)
    return Reached(distance, choice, entered, searches.by_distance(distance, queue[: ends[1]]))


def in_stretches(some: Callable[[], int], ends: NDArray[np.int64], progress: Progress) -> None:
    """Call `some`, which returns how many outcomes it looked at, until its queue, `ends[0]` to `ends[1]`, is empty."""
    number = 0
    while ends[0] < ends[1]:
        number += 1
        progress("graph", number, 0.0, np.inf, some())


class Pruning:
    """The nodes still inside and the choices still allowed, while nodes are taken out.

    A choice is allowed as long as none of its outcomes was taken out; a node stays inside as long as it has an
    allowed choice.
    """

    def __init__(self, graph: Predecessors, inside: Mask, allowed: Mask, remaining: NDArray[np.int32]) -> None:
        """`remaining` [n + 2] are how many choices of a node are allowed."""
        self.inside = inside  # [n + 2]
        self.allowed = allowed  # [C]
        self._graph, self._remaining = graph, remaining
        self._queue = np.empty(len(inside), dtype=np.int32)
        self._forbidden = np.empty(len(allowed), dtype=np.int32)
        self._ends = np.array([0, 0, np.count_nonzero(allowed), 0])  # see `searches.prune`

    def remove(self, nodes: NDArray[np.int32], progress: Progress = no_progress) -> NDArray[np.int32]:
        """Take `nodes` out and, in turn, the nodes left without a choice. Returns the choices forbidden thereby."""
        self.inside[nodes] = False
        end = self._ends[1]
        self._queue[end : end + len(nodes)] = nodes
        self._ends[1] += len(nodes)
        return self._prune(progress)

    def forbid(self, choices: NDArray[np.int32], progress: Progress = no_progress) -> None:
        """Forbid choices that are allowed, and take out, in turn, the nodes left without one."""
        owner = self._graph.arrays[2]
        searches.forbid(choices, owner, self.inside, self.allowed, self._remaining, self._queue, self._ends)
        self._prune(progress)

    def _prune(self, progress: Progress) -> NDArray[np.int32]:
        graph, ends, before = self._graph, self._ends, self._ends[3]

        def some() -> int:
            return int(
                searches.prune(
                    *graph.arrays,
                    self.inside,
                    self.allowed,
                    self._remaining,
                    self._queue,
                    ends,
                    self._forbidden,
                    BUDGET,
                )
            )

        in_stretches(some, ends, progress)
        return self._forbidden[before : ends[3]]
