"""Exact graph analysis of the product: which nodes have maximal probability 0, and which have 1.

No numbers are involved, so there is no tolerance: Forejt, Kwiatkowska, Norman and Parker, "Automated
verification techniques for probabilistic systems" (SFM 2011), algorithms Prob0A and Prob1E; de Alfaro,
"Formal verification of probabilistic systems" (1997), for the almost-sure set by repeated removal. Only
frontiers are touched, so a pass costs time in proportion to the outcomes.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from models.planning.product import Product
from models.planning.ragged import distinct, owners, spans

Mask = NDArray[np.bool_]


@dataclass(frozen=True, slots=True, eq=False)
class Predecessors:
    """For each node and column, the choices with an outcome in it; for each choice, its node."""

    first: NDArray[np.int32]  # [n + 3]
    choice: NDArray[np.int32]  # [E]
    owner: NDArray[np.int32]  # [C]


@dataclass(frozen=True, slots=True, eq=False)
class Qualities:
    """What is certain without numbers, by node and column."""

    possible: Mask  # [n + 2]  maximal probability is above 0
    certain: Mask  # [n + 2]  maximal probability is 1
    keeps_certain: Mask  # [C]  every outcome of the choice is certain


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


def analyse(product: Product, graph: Predecessors) -> Qualities:
    """Find the nodes of maximal probability 0 and 1 of reaching acceptance."""
    target = np.array([product.accepted], dtype=np.int32)
    possible = reach(graph, target).mask
    certain = possible.copy()
    allowed = np.ones(len(product.action), dtype=np.bool_)
    remaining = np.append(np.diff(product.first_choice), [0, 0]).astype(np.int32)
    removed = np.flatnonzero(~possible).astype(np.int32)
    while _remove(graph, removed, certain, allowed, remaining):
        reached = reach(graph, target, allowed=allowed).mask
        removed = np.flatnonzero(certain & ~reached).astype(np.int32)
        certain &= reached
    return Qualities(possible, certain, allowed)


def _remove(
    graph: Predecessors, nodes: NDArray[np.int32], inside: Mask, allowed: Mask, remaining: NDArray[np.int32]
) -> bool:
    """Forbid every choice that may enter `nodes`, and take out, in turn, the nodes left without a choice.

    Updates the last three in place; says whether a choice of a node that was still inside was forbidden.
    """
    changed = False
    scratch_choice = np.empty(len(allowed), dtype=np.int32)
    scratch_node = np.empty(len(inside), dtype=np.int32)
    while len(nodes):
        choices = graph.choice[spans(graph.first, nodes)]
        choices = distinct(choices[allowed[choices]], scratch_choice)
        allowed[choices] = False
        touched = graph.owner[choices]
        touched = touched[inside[touched]]
        changed = changed or bool(len(touched))
        np.subtract.at(remaining, touched, 1)
        empty = touched[remaining[touched] == 0]
        nodes = distinct(empty, scratch_node)
        inside[nodes] = False
    return changed
