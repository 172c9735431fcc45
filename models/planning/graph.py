"""Searches in the product: backwards from targets, and the removal of nodes with all that depends on them.

Only frontiers are touched, so a pass costs time in proportion to the outcomes.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse import csgraph

from models.planning.options import Progress, no_progress
from models.planning.product import Product
from models.planning.ragged import distinct, offsets, owners, spans

Mask = NDArray[np.bool_]

DEEP = 2_000
"""Levels after which a search is left to a compiled one: on a long thin chain a level costs more than its nodes."""


@dataclass(frozen=True, slots=True, eq=False)
class Predecessors:
    """For each node and column, the choices with an outcome in it; for each choice, its node."""

    first: NDArray[np.int32]  # [n + 3]
    choice: NDArray[np.int32]  # [E]
    owner: NDArray[np.int32]  # [C]


@dataclass(frozen=True, slots=True, eq=False)
class Reached:
    """A backward search: how far each node and column is from the targets."""

    distance: NDArray[np.int32]  # [n + 2]  fewest steps that may lead to a target; -1 if none do
    choice: NDArray[np.int32]  # [n + 2]  a choice that may bring a node one step closer; -1 at targets and unreached

    @property
    def mask(self) -> Mask:
        """[n + 2] which nodes may reach a target."""
        return self.distance >= 0


def predecessors(product: Product) -> Predecessors:
    """The outcomes of the product, sorted by successor."""
    shape = (len(product.action), product.nodes + 2)
    ones = np.ones(len(product.successor), dtype=np.int8)
    columns = sparse.csr_array((ones, product.successor, product.first_outcome), shape=shape).tocsc()
    owner = owners(product.first_choice)
    return Predecessors(columns.indptr.astype(np.int32), columns.indices.astype(np.int32), owner)


def reach(graph: Predecessors, targets: NDArray[np.int32], *, allowed: Mask | None = None) -> Reached:
    """Search backwards from `targets` (nodes or columns) through the allowed choices (default: all)."""
    size = len(graph.first) - 1
    distance = np.full(size, -1, dtype=np.int32)
    via = np.full(size, -1, dtype=np.int32)
    scratch = np.empty(size, dtype=np.int32)
    distance[targets] = 0
    frontier, depth = targets, 0
    while len(frontier):
        depth += 1
        if depth > DEEP:
            return _reach_deep(graph, targets, allowed)
        choices = graph.choice[spans(graph.first, frontier)]
        if allowed is not None:
            choices = choices[allowed[choices]]
        nodes = graph.owner[choices]
        fresh = distance[nodes] < 0
        nodes, choices = nodes[fresh], choices[fresh]
        distance[nodes] = depth
        via[nodes] = choices
        frontier = distinct(nodes, scratch)
    return Reached(distance, via)


def _reach_deep(graph: Predecessors, targets: NDArray[np.int32], allowed: Mask | None) -> Reached:
    """As `reach`, over all outcomes at once."""
    size = len(graph.first) - 1
    successor, choice = owners(graph.first), graph.choice
    if allowed is not None:
        kept = allowed[choice]
        successor, choice = successor[kept], choice[kept]
    owner = graph.owner[choice]
    first = offsets(np.bincount(successor, minlength=size))
    edges = sparse.csr_array((np.ones(len(owner)), owner, first), shape=(size, size))
    found = csgraph.dijkstra(edges, indices=targets, unweighted=True, min_only=True)
    distance = np.where(np.isfinite(found), found, -1.0).astype(np.int32)
    closer = (distance[successor] >= 0) & (distance[owner] == distance[successor] + 1)
    via = np.full(size, -1, dtype=np.int32)
    via[owner[closer]] = choice[closer]
    return Reached(distance, via)


class Pruning:
    """The nodes still inside and the choices still allowed, while nodes are taken out.

    A choice is allowed as long as none of its outcomes was taken out; a node stays inside as long as it has an
    allowed choice.
    """

    def __init__(self, graph: Predecessors, inside: Mask, allowed: Mask) -> None:
        size = len(graph.first) - 1
        self.inside = inside  # [n + 2]
        self.allowed = allowed  # [C]
        self._graph = graph
        self._remaining = np.bincount(graph.owner[allowed], minlength=size).astype(np.int32)
        self._scratch_choice = np.empty(len(allowed), dtype=np.int32)
        self._scratch_node = np.empty(size, dtype=np.int32)

    def remove(self, nodes: NDArray[np.int32], progress: Progress = no_progress) -> NDArray[np.int32]:
        """Take `nodes` out and, in turn, the nodes left without a choice. Returns the choices forbidden thereby."""
        forbidden = [np.zeros(0, dtype=np.int32)]
        self.inside[nodes] = False
        while len(nodes):
            choices = self._graph.choice[spans(self._graph.first, nodes)]
            choices = distinct(choices[self.allowed[choices]], self._scratch_choice)
            forbidden.append(choices)
            nodes = self._forbid(choices)
            progress("graph", len(forbidden), 0.0, np.inf, len(nodes))
        return np.concatenate(forbidden)

    def forbid(self, choices: NDArray[np.int32], progress: Progress = no_progress) -> None:
        """Forbid choices that are allowed, and take out, in turn, the nodes left without one."""
        self.remove(self._forbid(choices), progress)

    def _forbid(self, choices: NDArray[np.int32]) -> NDArray[np.int32]:
        """The nodes inside that are left without a choice; they are taken out."""
        self.allowed[choices] = False
        touched = self._graph.owner[choices]
        np.subtract.at(self._remaining, touched, 1)
        empty = touched[(self._remaining[touched] == 0) & self.inside[touched]]
        nodes = distinct(empty, self._scratch_node)
        self.inside[nodes] = False
        return nodes
