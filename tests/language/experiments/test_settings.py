"""Which epochs are measured."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.language import copynet
from models.language.experiments.settings import Settings


def _epochs(last: int, points: int) -> tuple[int, ...]:
    return Settings(copynet=copynet.Settings(epochs=last), points=points).epochs


@pytest.mark.parametrize(
    ("last", "points", "epochs"),
    [(1, 10, (1,)), (2, 10, (1, 2)), (3, 2, (1, 3)), (100, 3, (1, 10, 100)), (5, 5, (1, 2, 3, 4, 5))],
)
def test_known(last: int, points: int, epochs: tuple[int, ...]) -> None:
    assert _epochs(last, points) == epochs


@given(st.integers(1, 300), st.integers(1, 20))
def test_the_first_and_the_last_and_rising(last: int, points: int) -> None:
    epochs = _epochs(last, points)
    assert (epochs[0], epochs[-1]) == (1, last)
    assert list(epochs) == sorted(set(epochs))
    assert len(epochs) <= max(2, points)


def test_quick_keeps_what_it_does_not_shrink() -> None:
    settings = replace(Settings(), seeds=(3, 4))
    quick = settings.quick()
    assert quick.seeds == (3,)
    assert quick.copynet == replace(settings.copynet, epochs=2)
    assert quick.epochs == (1, 2)
