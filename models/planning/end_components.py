"""Maximal end components: where a policy may stay for ever.

The classical decomposition (de Alfaro 1997, algorithm 3.1; Baier and Katoen, "Principles of Model Checking",
10.6.3): take strongly connected components, drop the choices that may leave theirs, repeat until none does.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse import csgraph

from models.planning.product import Product
from models.planning.ragged import owners, spans


def end_components(product: Product, inside: NDArray[np.bool_]) -> tuple[NDArray[np.int32], NDArray[np.bool_]]:
    """The maximal end components of the nodes in `inside` ([n + 2]).

    Returns the component of each node ([n], -1 outside all of them) and which choices never leave one ([C]).
    """
    nodes = product.nodes
    owner = owners(product.first_choice)
    choices = np.flatnonzero(inside[owner]).astype(np.int32)
    choices = choices[_all_outcomes(product, choices, inside)]
    label = np.full(nodes + 2, -1, dtype=np.int32)
    while len(choices):
        position = spans(product.first_outcome, choices)
        source = np.repeat(owner[choices], np.diff(product.first_outcome)[choices])
        target = product.successor[position]
        edges = sparse.csr_array((np.ones(len(source), dtype=np.int8), (source, target)), shape=(nodes, nodes))
        label[:nodes] = csgraph.connected_components(edges, directed=True, connection="strong")[1]
        leaves = np.zeros(len(product.action), dtype=np.bool_)
        crossing = label[source] != label[target]
        leaves[np.repeat(choices, np.diff(product.first_outcome)[choices])[crossing]] = True
        kept = choices[~leaves[choices]]
        if len(kept) == len(choices):
            break
        choices = kept
    stays = np.zeros(len(product.action), dtype=np.bool_)
    stays[choices] = True
    component = np.full(nodes, -1, dtype=np.int32)
    members = np.unique(owner[choices])
    component[members] = label[members]
    return component, stays


def _all_outcomes(product: Product, choices: NDArray[np.int32], inside: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """For each of `choices`, whether every outcome is in `inside`."""
    if not len(choices):
        return np.zeros(0, dtype=np.bool_)
    counts = np.diff(product.first_outcome)[choices]
    start = np.cumsum(counts) - counts
    fine = inside[product.successor[spans(product.first_outcome, choices)]]
    return np.logical_and.reduceat(fine, start)
