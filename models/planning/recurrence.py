"""Where a policy can satisfy the formula by going on for ever, and what it does there.

A run that stays undecided for ever is accepted when it satisfies one of the automaton's pairs. With probability one
it ends up in an end component and takes all of its choices again and again, so what counts are the *accepting end
components*: for a pair, those without its `finite` mark that hold its `infinite` one (de Alfaro, "Formal verification
of probabilistic systems", 1997; Baier and Katoen, "Principles of Model Checking", 10.6.4). The maximal probability of
the formula is that of reaching one, or the column of acceptance.

Inside, a policy meets the mark for ever, as often as can be: `models.planning.rounds`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from models.logic import Pair
from models.planning.choices import Choices, Vector, gather
from models.planning.end_components import end_components
from models.planning.graph import Mask, Predecessors, reach
from models.planning.options import Options, Progress, no_progress
from models.planning.product import Product
from models.planning.rounds import shortest_rounds


@dataclass(frozen=True, slots=True, eq=False)
class Recurrence:
    """The accepting end components and the policy inside them.

    `least` and `most` bound the expected steps of a round, the time from one meeting of the mark to the next, under
    the policy; `least` holds for every policy. A component whose pair asks for no mark has rounds of one step.
    """

    inside: Mask  # [n + 2]
    chosen: NDArray[np.int32]  # [n]  choice of each node inside; -1 elsewhere
    component: NDArray[np.int32]  # [n]  -1 where a node is in none, or on its way from one to another
    least: Vector  # [components]
    most: Vector  # [components]


def accepting_components(
    product: Product,
    graph: Predecessors,
    acceptance: Sequence[Pair],
    *,
    options: Options,
    progress: Progress = no_progress,
) -> Recurrence:
    """Find the accepting end components of every pair, and the policy in them."""
    found = _Finder(product, graph, options, progress)
    for pair in acceptance:
        found.add(pair)
    return found.result()


class _Finder:
    def __init__(self, product: Product, graph: Predecessors, options: Options, progress: Progress) -> None:
        self._product, self._graph, self._options, self._progress = product, graph, options, progress
        self._inside = np.zeros(product.nodes + 2, dtype=np.bool_)
        self._chosen = np.full(product.nodes, -1, dtype=np.int32)
        self._component = np.full(product.nodes, -1, dtype=np.int32)
        self._rounds: list[tuple[float, float]] = []

    def result(self) -> Recurrence:
        rounds = np.array(self._rounds).reshape(-1, 2)
        return Recurrence(self._inside, self._chosen, self._component, rounds[:, 0], rounds[:, 1])

    def add(self, pair: Pair) -> None:
        """The components of one pair. Nodes of earlier ones keep what they have, and a new component that holds
        some leads there: it is strongly connected, so they are reached for sure.
        """
        product, graph = self._product, self._graph
        live = np.arange(product.nodes + 2) < product.nodes
        without = (product.marks & np.uint32(pair.finite)) != 0
        component, stays = end_components(product, graph, live, without=without, progress=self._progress)
        member = component >= 0
        if not member.any():
            return
        count = int(component.max()) + 1
        if pair.infinite:
            meets = (product.marks & np.uint32(pair.infinite)) != 0
            good = np.zeros(count, dtype=np.bool_)
            good[component[graph.owner[stays & meets]]] = True
            member &= good[component]
        taken = np.zeros(count, dtype=np.bool_)
        taken[component[member & self._inside[:-2]]] = True
        fresh = member & ~self._inside[:-2]
        joining = fresh & taken[component]
        self._join(joining, stays)
        self._settle(fresh & ~joining, component, stays, pair)
        self._inside[:-2] |= fresh

    def _join(self, nodes: Mask, stays: Mask) -> None:
        """The way of `nodes` to the components there are."""
        if nodes.any():
            targets = np.flatnonzero(self._inside).astype(np.int32)
            way = reach(self._graph, targets, allowed=stays & nodes[self._graph.owner])
            self._chosen[nodes] = way.choice[:-2][nodes]

    def _settle(self, nodes: Mask, component: NDArray[np.int32], stays: Mask, pair: Pair) -> None:
        """The policy of new components, which do not touch the others."""
        if not nodes.any():
            return
        places = np.flatnonzero(nodes).astype(np.int32)
        number = np.unique(component[places], return_inverse=True)[1].astype(np.int32)
        choices = np.flatnonzero(stays & nodes[self._graph.owner]).astype(np.int32)
        self._component[places] = len(self._rounds) + number
        if not pair.infinite:
            first = np.unique(self._graph.owner[choices], return_index=True)[1]
            self._chosen[places] = choices[first]
            self._rounds += [(1.0, 1.0)] * (int(number.max()) + 1)
            return
        problem, rows = self._problem(places, stays, self._product.meets[pair.infinite])
        rounds, policy = shortest_rounds(problem, number, options=self._options, progress=self._progress)
        chosen = rows[policy]
        stuck = ~np.isfinite(rounds[number, 1])
        if stuck.any():
            chosen[stuck] = self._towards(places, choices, self._product.meets[pair.infinite])[stuck]
        self._chosen[places] = chosen
        self._rounds += [(float(least), float(most)) for least, most in rounds]

    def _problem(self, places: NDArray[np.int32], stays: Mask, meets: Vector) -> tuple[Choices, NDArray[np.int32]]:
        """Maximise the meetings at `places` over the choices `stays`."""
        nothing = np.zeros(self._product.nodes + 2)
        unknown = np.full(len(nothing), -1, dtype=np.int32)
        unknown[places] = np.arange(len(places), dtype=np.int32)
        return gather(self._product, stays, unknown=unknown, known=nothing, cost=meets)

    def _towards(self, places: NDArray[np.int32], choices: NDArray[np.int32], meets: Vector) -> NDArray[np.int32]:
        """Choices that meet the mark where it can be met and lead there elsewhere: for ever, if not the fastest."""
        hits = choices[meets[choices] > 0][::-1]
        allowed = np.zeros(len(self._product.action), dtype=np.bool_)
        allowed[choices] = True
        owner = self._graph.owner[hits]
        way = reach(self._graph, np.unique(owner).astype(np.int32), allowed=allowed).choice
        way[owner] = hits  # the first of them, as they come last to first
        return way[places]
