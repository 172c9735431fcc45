"""Reliability and its error, against sums done by hand and a direct computation."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.language.experiments.calibration import BINS, calibration_error, reliability


def test_by_hand() -> None:
    # bins of a half: 0.2 wrong and 0.4 right; 0.9 right, 0.7 right and 1.0 wrong
    table = reliability([0.2, 0.4, 0.9, 0.7, 1.0], [False, True, True, True, False], bins=2)
    assert [(entry.low, entry.high, entry.count) for entry in table] == [(0, 0.5, 2), (0.5, 1, 3)]
    assert [entry.confidence for entry in table] == pytest.approx([0.3, 2.6 / 3])
    assert [entry.accuracy for entry in table] == pytest.approx([0.5, 2 / 3])
    assert calibration_error(table) == pytest.approx((2 * 0.2 + 3 * 0.2) / 5)


def test_edges_belong_to_the_bin_below() -> None:
    table = reliability([0.0, 0.5, 0.5000001, 1.0], [True] * 4, bins=2)
    assert [entry.count for entry in table] == [2, 2]


def test_no_answers_have_no_error() -> None:
    table = reliability([], [])
    assert len(table) == BINS
    assert calibration_error(table) == 0


@given(st.lists(st.tuples(st.floats(0, 1), st.booleans()), min_size=1, max_size=60))
def test_the_error_by_definition(pairs: list[tuple[float, bool]]) -> None:
    confidences, right = [c for c, _ in pairs], [r for _, r in pairs]
    table = reliability(confidences, right)
    assert sum(entry.count for entry in table) == len(pairs)
    error = 0.0
    for low, high in ((n / BINS, (n + 1) / BINS) for n in range(BINS)):
        group = [(c, r) for c, r in pairs if low < c <= high or (low == 0 and c == 0)]
        error += abs(sum(c - r for c, r in group)) / len(pairs)
    assert calibration_error(table) == pytest.approx(error)
    assert 0 <= calibration_error(table) <= 1
