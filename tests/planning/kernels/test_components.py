"""Strongly connected components against SciPy's, whatever the budget of a call."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from scipy import sparse
from scipy.sparse import csgraph

from models.planning.kernels import components

# By node, its choices; by choice, whether it is allowed and where it may lead.
GRAPHS = st.integers(1, 12).flatmap(
    lambda size: st.lists(
        st.lists(
            st.tuples(st.booleans(), st.lists(st.integers(0, size - 1), min_size=1, max_size=3)), min_size=0, max_size=3
        ),
        min_size=size,
        max_size=size,
    )
)


@given(GRAPHS, st.integers(1, 50))
def test_components_are_those_of_scipy(graph: list[list[tuple[bool, list[int]]]], budget: int) -> None:
    size = len(graph)
    choices = [choice for node in graph for choice in node]
    first_choice = np.cumsum([0, *map(len, graph)]).astype(np.int32)
    first_outcome = np.cumsum([0, *(len(targets) for _, targets in choices)]).astype(np.int32)
    successor = np.array([t for _, targets in choices for t in targets], dtype=np.int32)
    allowed = np.array([permitted for permitted, _ in choices], dtype=np.bool_)
    label, index = np.empty(size, dtype=np.int32), np.zeros(size, dtype=np.int32)
    scratch = [np.empty(size, dtype=np.int32) for _ in range(4)]
    ends = np.zeros(4, dtype=np.int64)
    nodes = np.arange(size, dtype=np.int32)
    while not (ends[0] == size and ends[1] == 0):
        components.strong(nodes, first_choice, first_outcome, successor, allowed, label, index, *scratch, ends, budget)
    edges = [(n, t) for n, node in enumerate(graph) for permitted, targets in node if permitted for t in targets]
    rows, columns = zip(*edges, strict=True) if edges else ((), ())
    matrix = sparse.coo_array((np.ones(len(edges)), (rows, columns)), shape=(size, size)).tocsr()
    _, expected = csgraph.connected_components(matrix, directed=True, connection="strong")
    assert (label[:, None] == label[None, :]).tolist() == (expected[:, None] == expected[None, :]).tolist()
    assert (label[label] == label).all()
