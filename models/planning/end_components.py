"""Maximal end components: where a policy may stay for ever.

The classical decomposition (de Alfaro 1997, algorithm 3.1; Baier and Katoen, "Principles of Model Checking",
10.6.3): take strongly connected components, drop the choices that may leave theirs and the nodes left without
one, repeat until none does. Only components that lost a choice are decomposed again.
"""

from __future__ import annotations

from itertools import count

import numpy as np
from numpy.typing import NDArray

from models.planning.graph import BUDGET, Mask, Predecessors, Pruning
from models.planning.kernels import components, searches
from models.planning.options import Progress, no_progress
from models.planning.product import Product


def end_components(
    product: Product,
    graph: Predecessors,
    inside: Mask,
    *,
    without: Mask | None = None,
    progress: Progress = no_progress,
) -> tuple[NDArray[np.int32], Mask]:
    """The maximal end components of the nodes in `inside` ([n + 2], no columns) and, but for those in `without` ([C]),
    their choices.

    Returns the component of each node ([n], -1 outside all of them) and which choices never leave one ([C]).
    """
    allowed = np.ones(len(product.action), dtype=np.bool_) if without is None else ~without
    remaining = np.zeros(product.nodes + 2, dtype=np.int32)
    searches.confine(*product.moves, inside, allowed, remaining)
    pruning = Pruning(graph, inside.copy(), allowed, remaining)
    pruning.remove(np.flatnonzero(inside & (remaining == 0)).astype(np.int32), progress)
    decomposition = _Decomposition(product, allowed, progress)
    nodes = np.flatnonzero(pruning.inside).astype(np.int32)
    while len(nodes):
        leaving, broken = decomposition.refine(nodes)
        if not len(leaving):
            break
        pruning.forbid(leaving, progress)
        nodes = nodes[broken & pruning.inside[nodes]]
    return components.numbered(decomposition.label, pruning.inside), allowed


class _Decomposition:
    """Strongly connected components of the allowed choices."""

    def __init__(self, product: Product, allowed: Mask, progress: Progress) -> None:
        self._arrays = (*product.moves, allowed)
        self._progress = progress
        self.label = np.empty(product.nodes, dtype=np.int32)  # a node of the component
        self._index = np.empty(product.nodes, dtype=np.int32)
        self._scratch = [np.empty(product.nodes, dtype=np.int32) for _ in range(4)]
        self._broken = np.zeros(product.nodes, dtype=np.bool_)

    def refine(self, nodes: NDArray[np.int32]) -> tuple[NDArray[np.int32], Mask]:
        """Label `nodes`, which allowed choices do not leave, anew. Returns the choices that may leave the component
        that their node is in now, and of which `nodes` the component has such.
        """
        self._index[nodes] = 0
        ends = np.zeros(4, dtype=np.int64)
        for number in count(1):
            looked = components.strong(nodes, *self._arrays, self.label, self._index, *self._scratch, ends, BUDGET)  # type: ignore[call-arg]
            self._progress("graph", number, 0.0, np.inf, int(looked))
            if ends[0] == len(nodes) and ends[1] == 0:
                break
        leaving = components.leaving(nodes, *self._arrays, self.label, self._broken)
        own = self.label[nodes]
        broken = self._broken[own]
        self._broken[own] = False
        return leaving, broken
