"""Maximal end components: where a policy may stay for ever.

The classical decomposition (de Alfaro 1997, algorithm 3.1; Baier and Katoen, "Principles of Model Checking",
10.6.3): take strongly connected components, drop the choices that may leave theirs and the nodes left without
one, repeat until none does.
"""

from __future__ import annotations

from itertools import count

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse import csgraph

from models.planning.graph import Mask, Predecessors, Pruning
from models.planning.options import Progress, no_progress
from models.planning.product import Product
from models.planning.ragged import spans


def end_components(
    product: Product,
    graph: Predecessors,
    inside: Mask,
    *,
    without: Mask | None = None,
    progress: Progress = no_progress,
) -> tuple[NDArray[np.int32], Mask]:
    """The maximal end components of the nodes in `inside` ([n + 2]) and, but for those in `without` ([C]), their
    choices.

    Returns the component of each node ([n], -1 outside all of them) and which choices never leave one ([C]).
    """
    nodes, owner = product.nodes, graph.owner
    pruning = Pruning(graph, inside.copy(), inside[owner])
    pruning.remove(np.flatnonzero(~inside).astype(np.int32), progress)
    if without is not None:
        pruning.forbid(np.flatnonzero(without & pruning.allowed).astype(np.int32), progress)
    label = np.full(nodes, -1, dtype=np.int32)
    for number in count(1):
        choices = np.flatnonzero(pruning.allowed).astype(np.int32)
        target = product.successor[spans(product.first_outcome, choices)]
        choice = np.repeat(choices, np.diff(product.first_outcome)[choices])
        source = owner[choice]
        edges = sparse.csr_array((np.ones(len(source), dtype=np.int8), (source, target)), shape=(nodes, nodes))
        label = csgraph.connected_components(edges, directed=True, connection="strong")[1]
        progress("graph", number, 0.0, np.inf, len(choices))
        leaving = np.unique(choice[label[source] != label[target]])
        if not len(leaving):
            break
        pruning.forbid(leaving, progress)
    component = np.full(nodes, -1, dtype=np.int32)
    members = np.unique(owner[pruning.allowed])
    component[members] = label[members]
    return component, pruning.allowed
