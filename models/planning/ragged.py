"""Index arithmetic on rows of unequal length, stored back to back (the index part of CSR)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Index = NDArray[np.int32]


def unsigned(indices: Index) -> NDArray[np.uint32]:
    """The same memory, for compiled loops, which then need not look for negative indices."""
    return indices.view(np.uint32)


def offsets(counts: NDArray[np.integer]) -> Index:
    """[n + 1] where each of `n` rows of the given lengths begins; the last entry is the end."""
    first = np.zeros(len(counts) + 1, dtype=np.int32)
    np.cumsum(counts, out=first[1:])
    return first


def spans(first: Index, rows: Index) -> Index:
    """The positions `first[r] .. first[r + 1] - 1` of every r in `rows`, back to back."""
    start = first[rows]
    count = first[rows + 1] - start
    if not len(rows):
        return start
    end = np.cumsum(count, dtype=np.int32)
    positions: Index = np.repeat(start - end + count, count) + np.arange(end[-1], dtype=np.int32)
    return positions


def owners(first: Index) -> Index:
    """[first[-1]] the row that each position belongs to."""
    return np.repeat(np.arange(len(first) - 1, dtype=np.int32), np.diff(first))


def distinct(values: Index, scratch: Index) -> Index:
    """`values` without repetitions, order kept by last occurrence; `scratch` is as long as the values are
    large.
    """
    order = np.arange(len(values), dtype=np.int32)
    scratch[values] = order
    kept: Index = values[scratch[values] == order]
    return kept
