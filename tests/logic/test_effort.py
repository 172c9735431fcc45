"""The guess at the work that a translation takes."""

from __future__ import annotations

import pytest

from models.logic import parse
from models.logic.effort import obligations


@pytest.mark.parametrize(
    ("text", "guess"),
    [
        ("a & b | !c", 0),
        ("F a", 2),
        ("X X X a", 4),
        ("F a & F b & F c", 8),
        ("F a | F b | F c", 6),
        ("F (a & F (b & F c))", 4),
        ("!(F a | F b)", 4),
        ("!(F a & F b)", 4),
        ("F a -> F b", 4),
        ("a U b", 3),
        ("a R b", 3),
    ],
)
def test_by_hand(text: str, guess: int) -> None:
    assert obligations(parse(text)) == guess


def test_conjunctions_of_goals_multiply_without_growing_out_of_bounds() -> None:
    assert obligations(parse(" & ".join(f"F p{i}" for i in range(10)))) == 1024
    assert obligations(parse(" & ".join(f"F p{i}" for i in range(2_000)))) == 1 << 40


def test_sequences_add() -> None:
    assert obligations(parse("F (a & " * 60 + "b" + ")" * 60)) == 61
