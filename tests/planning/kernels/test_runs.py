"""Cheapest paths against SciPy's."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from scipy import sparse
from scipy.sparse import csgraph

from models.planning.kernels import runs

# By node, its outcomes: where they lead (no two to the same) and what they cost.
GRAPHS = st.integers(1, 40).flatmap(
    lambda size: st.lists(
        st.dictionaries(st.integers(0, size - 1), st.sampled_from([0.25, 0.5, 1.0, 3.0]), max_size=4),
        min_size=size,
        max_size=size,
    )
)


@given(GRAPHS, st.data())
def test_paths_are_as_cheap_as_those_of_scipy(graph: list[dict[int, float]], data: st.DataObject) -> None:
    size = len(graph)
    ends = np.array(data.draw(st.lists(st.booleans(), min_size=size, max_size=size)), dtype=np.bool_)
    first = np.cumsum([0, *map(len, graph)])
    target = np.array([node for row in graph for node in row], dtype=np.int64)
    cost = np.array([one for row in graph for one in row.values()], dtype=np.float64)
    matrix = sparse.csr_array((cost, target, first), shape=(size, size))
    distance = csgraph.dijkstra(matrix, indices=0)
    path, end = runs.cheapest_path(first, target, cost, 0, ends)
    least = distance[ends].min(initial=np.inf)
    if not np.isfinite(least):
        assert end == -1
        return
    assert end == np.flatnonzero(ends & (distance == least))[0]
    node = 0
    for outcome in path[::-1].tolist():
        assert first[node] <= outcome < first[node + 1]
        node = int(target[outcome])
    assert node == end
    assert cost[path].sum() == least
