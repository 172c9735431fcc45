"""Simplification: same meaning, no larger, and the cases that warnings are about."""

from __future__ import annotations

import pytest
import spot
from hypothesis import given, settings

from models.logic import Formula, parse, simplify, to_text
from tests.logic.strategies import formulas, plain_atoms


@pytest.mark.parametrize(
    ("text", "simpler"),
    [
        ("F (in(x, y) & F (in(x, y) & at(y, z)))", "F (in(x, y) & at(y, z))"),
        ("F (a & F b)", "F (a & F b)"),
        ("(!b U a) & F (a & b)", "(!b U a) & F (a & b)"),
        ("F F a", "F a"),
        ("a & (a | b)", "a"),
        ("F a | G !a", "true"),
        ("F a & G !a", "false"),
        ("F (a & F (b & F (b & c)))", "F (a & F (b & c))"),
    ],
)
def test_known_cases(text: str, simpler: str) -> None:
    assert to_text(simplify(parse(text))) == simpler


@given(formulas(plain_atoms, max_leaves=7))
@settings(max_examples=60, deadline=None)
def test_the_meaning_stays_and_the_size_does_not_grow(formula: Formula) -> None:
    simpler = simplify(formula)
    assert spot.are_equivalent(to_text(simpler), to_text(formula))
    assert simpler.size <= formula.size
    assert simplify(formula) == simpler


@pytest.mark.parametrize("text", ["G F a & G F b", "!b U (a & !b)", "(a -> b) & c", "!(a & b)", "X a & X b"])
def test_another_spelling_is_not_simpler(text: str) -> None:
    assert simplify(parse(text)) == parse(text)


def test_large_formulas_stay_as_they_are() -> None:
    formula = parse(" | ".join(f"X {'a' if i % 2 else 'b'}" for i in range(200)))
    assert simplify(formula) == formula
