from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.language.human.spelling import Spelled, in_one_spelling, read

FORMULAS = st.recursive(
    st.sampled_from(["$1", "the red room", "go to the $2 room"]).map(Spelled),
    lambda inner: st.builds(
        Spelled,
        st.sampled_from(["and", "or", "until", "finally", "not"]),
        st.lists(inner, min_size=1, max_size=3).map(tuple),
    ),
    max_leaves=8,
)


@given(FORMULAS)
def test_what_is_spelled_is_read_back(formula: Spelled) -> None:
    assert read(str(formula)) == formula


@given(FORMULAS)
def test_sorted_operands_stay_what_they_are(formula: Spelled) -> None:
    again = formula.sorted(frozenset({"and", "or"}))
    assert sorted(part.head for part in again.walk()) == sorted(part.head for part in formula.walk())
    assert again.sorted(frozenset({"and", "or"})) == again


def test_the_parts_of_a_formula() -> None:
    formula = read("and ( finally ( the red room ) , always ( the first floor ) )")
    assert formula is not None
    assert [part.head for part in formula.walk()] == ["and", "finally", "the red room", "always", "the first floor"]
    swapped = read("or ( b , not ( a ) , a )")
    assert swapped is not None
    assert str(swapped.sorted(frozenset({"or"}))) == "or ( a , b , not ( a ) )"


@pytest.mark.parametrize("text", ["finally ( a ) )", "finally ( a", "and ( a , )  b", "a )", ", a"])
def test_what_is_amiss_is_no_formula(text: str) -> None:
    assert read(text) is None


@pytest.mark.parametrize(
    ("formula", "expected"),
    [
        ("finally go to the red room", "finally ( go to the red room )"),
        ("finally ( go to the red room )", "finally ( go to the red room )"),
        ("and ( finally ( red ) , globally ( not ( blue ) ) )", "and ( finally ( red ) , globally ( not ( blue ) ) )"),
    ],
)
def test_formulas_have_one_spelling(formula: str, expected: str) -> None:
    assert in_one_spelling(formula) == expected
