"""Index arithmetic against plain Python."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from models.planning.ragged import distinct, offsets, owners, spans

COUNTS = st.lists(st.integers(0, 4), max_size=12)


@given(COUNTS, st.data())
def test_spans_are_the_positions_of_the_rows(counts: list[int], data: st.DataObject) -> None:
    first = offsets(np.array(counts, dtype=np.int64))
    rows = data.draw(st.lists(st.integers(0, len(counts) - 1), max_size=12)) if counts else []
    expected = [p for r in rows for p in range(sum(counts[:r]), sum(counts[: r + 1]))]
    assert spans(first, np.array(rows, dtype=np.int32)).tolist() == expected


@given(COUNTS)
def test_owners_repeat_each_row_by_its_length(counts: list[int]) -> None:
    first = offsets(np.array(counts, dtype=np.int64))
    assert owners(first).tolist() == [row for row, count in enumerate(counts) for _ in range(count)]


@given(st.lists(st.integers(0, 9), max_size=30))
def test_distinct_keeps_each_value_once(values: list[int]) -> None:
    kept = distinct(np.array(values, dtype=np.int32), np.empty(10, dtype=np.int32)).tolist()
    assert sorted(kept) == sorted(set(values))
