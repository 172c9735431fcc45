"""The least confidence at which a reading is given."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.language.threshold import middle_of_best

PROBABILITIES = st.lists(st.just(0.0) | st.floats(0.001, 1), min_size=1, max_size=12)


@pytest.mark.parametrize(
    ("wanted", "unwanted", "low", "high"),
    [
        ([0.9, 0.8], [0.1, 0.2], 0.2, 0.8),  # told apart
        ([0.9, 0.8, 0.3, 0.35], [0.1, 0.2, 0.4], 0.2, 0.3),  # one of three let through, or two of four lost
        ([0.9], [0.0, 0.0], 0.0, 0.9),
    ],
)
def test_between(wanted: list[float], unwanted: list[float], low: float, high: float) -> None:
    assert low < middle_of_best(wanted, unwanted) < high


@given(PROBABILITIES, PROBABILITIES)
def test_no_threshold_is_better(wanted: list[float], unwanted: list[float]) -> None:
    def quality(t: float) -> float:
        return sum(v >= t for v in wanted) / len(wanted) + sum(v < t for v in unwanted) / len(unwanted)

    best = middle_of_best(wanted, unwanted)
    assert 0 < best <= 1
    for t in [0.0005 + step / 1000 for step in range(1000)]:
        assert quality(t) <= quality(best) + 1e-9
