"""Right or not: queries by phrases, formulas by Spot, shapes by operators."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from models.language.dataset import fill
from models.language.experiments.comparison import same_meaning, says, shape
from models.logic import Formula, equivalent, parse
from models.queries import ContextualQuery, parse_query

SHIP = fill(
    "manipulation",
    "ship",
    "Put the {object} in the {container}, then put the {container} in the {location}",
    {"object": "teddy bear", "container": "box", "location": "bedroom"},
)


@pytest.mark.parametrize(
    ("left", "right", "same"),
    [
        ("F in(ball, box)", "F in(ball, box)", True),
        ("F (a & F (a & b))", "F (a & b)", True),  # the ship template orders nothing
        ("F (a & F b)", "F (b & F a)", False),
        ("F (in(ball, box) & F in(ball, bag))", "F (in(ball, bag) & F in(ball, box))", False),
        ("F at(robot, bank)", "F at(robot, park)", False),
        ("F a & F b", "F b & F a", True),
    ],
)
def test_same_meaning(left: str, right: str, *, same: bool) -> None:
    assert same_meaning(parse(left), parse(right)) is same


def test_formulas_beyond_the_limits_of_spot_are_not_the_same() -> None:
    many = parse(" & ".join(f"F a{n}" for n in range(20)))
    assert not same_meaning(many, parse("F a0"))
    assert same_meaning(many, many)


def _formulas() -> st.SearchStrategy[str]:
    leaf = st.sampled_from(["f(a)", "f(b)", "g(a, b)"])
    return st.recursive(
        leaf,
        lambda inner: st.one_of(
            inner.map(lambda f: f"F ({f})"), st.tuples(inner, inner).map(lambda pair: f"({pair[0]}) & ({pair[1]})")
        ),
        max_leaves=4,
    )


@settings(deadline=None, max_examples=60)
@given(_formulas(), _formulas())
def test_numbering_the_atoms_changes_no_verdict(left: str, right: str) -> None:
    one, other = parse(left), parse(right)
    assert same_meaning(one, other) == equivalent(one, other)


def test_shape_is_the_operators_alone() -> None:
    def of(text: str) -> object:
        return shape(parse(text))

    formula: Formula = parse("F (in(ball, box) & F at(box, attic))")
    assert shape(formula) == of("F (a & F b)") == of("F (a & F a)")
    assert shape(formula) != of("F (a & b)")
    assert of("F a") != of("G a")
    assert of("F true") != of("F false")


@pytest.mark.parametrize(
    ("query", "right"),
    [
        ("ship(teddy bear, box, bedroom)", True),
        ("ship(bear, box, bedroom)", False),
        ("ship(box, teddy bear, bedroom)", False),
        ("ship(teddy bear, box)", False),
        ("carry(teddy bear, box, bedroom)", False),
        ("ship(teddy bear, bxo, bedroom)", False),
    ],
)
def test_says_of_a_text_without_mistakes_is_equality(query: str, *, right: bool) -> None:
    assert says(parse_query(query), SHIP) is right
    assert right is (parse_query(query) == SHIP.query)


def test_nothing_says_nothing() -> None:
    assert not says(None, SHIP)


def test_an_argument_may_be_misspelt_as_the_text_has_it() -> None:
    example = replace(SHIP, text="Put the teddy bear in the bxo, then put the box in the bedroom")
    assert says(ContextualQuery("ship", ("teddy bear", "bxo", "bedroom")), example)
    assert says(SHIP.query, example)
    assert not says(ContextualQuery("ship", ("teddy bear", "obx", "bedroom")), example)
    assert not says(ContextualQuery("ship", ("bxo", "teddy bear", "bedroom")), example)
