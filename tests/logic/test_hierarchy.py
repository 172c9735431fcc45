"""Classes of formulas, against Manna and Pnueli's own examples and against what the classes mean."""

from __future__ import annotations

import pytest
from hypothesis import given

from models.logic import PropertyClass, Unary, classify, is_cosafe, is_satisfiable, is_valid, parse
from models.logic.formula import Op
from tests.logic.strategies import formulas, plain_atoms


@pytest.mark.parametrize(
    ("formula", "found"),
    [
        ("F a & G !a", "never"),
        ("F a | G !a", "always"),
        ("a & X b", "bounded"),
        ("F a", "guarantee"),
        ("!b U a", "guarantee"),
        ("F (a & F b)", "guarantee"),
        ("G a", "safety"),
        ("a W b", "safety"),
        ("F a & G b", "obligation"),
        ("G F a", "recurrence"),
        ("G (a -> F b)", "recurrence"),
        ("F a & G F b", "recurrence"),
        ("F G a", "persistence"),
        ("G F a | F G b", "reactivity"),
        ("G F a & F G b", "reactivity"),
        ("F F a & (G a | true)", "guarantee"),
        ("G F (a & X G a)", "persistence"),
    ],
)
def test_classes(formula: str, found: str) -> None:
    assert classify(parse(formula)) == found
    assert classify(parse(formula)).plain


DUALS = {
    "never": "always",
    "always": "never",
    "guarantee": "safety",
    "safety": "guarantee",
    "recurrence": "persistence",
    "persistence": "recurrence",
}


@given(formulas(plain_atoms, max_leaves=6))
def test_the_negation_has_the_dual_class(formula) -> None:
    found = classify(formula)
    assert classify(Unary(Op.NOT, formula)) == DUALS.get(found, found)
    assert is_cosafe(formula) is (found in {"never", "always", "bounded", "guarantee"})
    assert (found == "never") is not is_satisfiable(formula)
    assert (found == "always") is is_valid(formula)


def test_every_class_has_words_of_its_own() -> None:
    assert len({kind.plain for kind in PropertyClass}) == len(PropertyClass)
