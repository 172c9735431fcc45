"""A run that satisfies a formula for ever: a way into a bottom component of the policy's chain, and a circle there.

The circle holds a transition with the mark that the component's pair asks for, so that to go round for ever satisfies
the formula. Paths are the most probable ones.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse import csgraph

from models.logic import Automaton
from models.planning.chain import Chain
from models.planning.policy import NOTHING, Policy


@dataclass(frozen=True, slots=True, eq=False)
class Bottoms:
    """The bottom strongly connected components of a chain, in which its runs end up and see all of it for ever."""

    label: NDArray[np.int32]  # [n]  the component of each product state, -1 for those that runs leave
    wanted: NDArray[np.uint32]  # [components]  the mark that satisfies a pair; 0 where none is asked for
    accepted: NDArray[np.bool_]  # [components]  some pair is satisfied
    marks: NDArray[np.uint32]  # [e]  of each outcome


def bottoms(chain: Chain, policy: Policy, automaton: Automaton) -> Bottoms:
    """Find the bottom components, and which are accepted (Baier and Katoen, "Principles of Model Checking", 10.1.2)."""
    count, source = len(chain.state), chain.source
    graph: Any = sparse.csr_array((np.ones(len(source)), chain.target, chain.first), shape=(count, count))
    number, label = csgraph.connected_components(graph, directed=True, connection="strong")
    bottom = np.ones(number, dtype=np.bool_)
    bottom[label[source[label[source] != label[chain.target]]]] = False
    bottom[label[chain.action == NOTHING]] = False
    carried = automaton.marks[chain.after[source], policy.reading(chain.state[chain.target])]
    seen = np.zeros(number, dtype=np.uint32)
    np.bitwise_or.at(seen, label[source], carried)
    wanted, accepted = np.zeros(number, dtype=np.uint32), np.zeros(number, dtype=np.bool_)
    for pair in automaton.acceptance:
        good = (
            bottom
            & ~accepted
            & (seen & np.uint32(pair.finite) == 0)
            & (seen & np.uint32(pair.infinite) == pair.infinite)
        )
        wanted[good], accepted[good] = pair.infinite, True
    return Bottoms(np.where(bottom[label], label, -1).astype(np.int32), wanted, accepted, carried)


def circle(chain: Chain, found: Bottoms, start: int, cost: NDArray[np.float64]) -> tuple[list[int], int] | None:
    """From `start` (not in the list) into an accepted bottom component and once around, by the cheapest outcomes.

    Returns the nodes after `start` and the place, counted from `start` as 0, that the last of them repeats.
    """
    count, source = len(chain.state), chain.source
    inside = found.label[source]
    meets = (
        (inside >= 0)
        & found.accepted[inside]
        & ((found.wanted[inside] == 0) | (found.marks & found.wanted[inside] > 0))
    )
    edges = np.flatnonzero(meets)
    if not len(edges):
        return None
    graph: Any = sparse.csr_array((cost, chain.target, chain.first), shape=(count, count))
    distance, before = csgraph.dijkstra(graph, indices=[start], return_predecessors=True)
    total = distance[0, source[edges]] + cost[edges]
    edge = int(edges[total.argmin()])
    if not np.isfinite(total.min()):
        return None
    there = _path(before[0], start, int(source[edge]))
    entered = int(chain.target[edge])
    _, back = csgraph.dijkstra(graph, indices=[entered], return_predecessors=True)
    return [*there[1:], entered, *_path(back[0], entered, int(source[edge]))[1:]], len(there) - 1


def _path(before: NDArray[np.int32], start: int, end: int) -> list[int]:
    nodes = [end]
    while nodes[-1] != start:
        nodes.append(int(before[nodes[-1]]))
    return nodes[::-1]
